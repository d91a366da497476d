// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/params.hpp"

#include "microswarm/core/fields/overloaded.hpp"

namespace microswarm::navigation {
namespace {

constexpr double range_of_others = 50;  // [µm]; see required_detection_range

}  // namespace

NavigatorParams in_effect(const NavigatorParams& params) {
  return std::visit(
      Overloaded{[](const OneOf<HierarchicalParams, RadarParams> auto& p) -> NavigatorParams {
                   return p.in_effect();
                 },
                 [](const OneOf<PlanExecutorParams, AggregationParams, StraightParams,
                                PotentialFieldParams, VelocityObstacleParams, PathNavigatorParams,
                                SafeIntervalParams> auto& p) -> NavigatorParams { return p; }},
      params);
}

double required_clearance(const NavigatorParams& params) {
  return std::visit(
      Overloaded{[](const HierarchicalParams& p) { return p.clearance; },
                 [](const OneOf<PlanExecutorParams, AggregationParams, RadarParams, StraightParams,
                                PotentialFieldParams, VelocityObstacleParams, PathNavigatorParams,
                                SafeIntervalParams> auto&) { return 0.0; }},
      params);
}

double required_detection_range(const NavigatorParams& params) {
  return std::visit(
      Overloaded{
          [](const RadarParams& p) { return p.detection_range; },
          [](const OneOf<HierarchicalParams, PlanExecutorParams, AggregationParams, StraightParams,
                         PotentialFieldParams, VelocityObstacleParams, PathNavigatorParams,
                         SafeIntervalParams> auto&) { return range_of_others; }},
      params);
}

FollowerParams* find_follower(NavigatorParams& params) {
  return std::visit(
      Overloaded{[](OneOf<HierarchicalParams, PathNavigatorParams> auto& p) { return &p.follower; },
                 [](OneOf<PlanExecutorParams, AggregationParams, RadarParams, StraightParams,
                          PotentialFieldParams, VelocityObstacleParams, SafeIntervalParams> auto&)
                     -> FollowerParams* { return nullptr; }},
      params);
}

const FollowerParams* find_follower(const NavigatorParams& params) {
  return find_follower(const_cast<NavigatorParams&>(params));
}

}  // namespace microswarm::navigation

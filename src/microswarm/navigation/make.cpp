// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/make.hpp"

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/navigation/baselines/potential_field.hpp"
#include "microswarm/navigation/baselines/straight.hpp"
#include "microswarm/navigation/baselines/velocity_obstacle.hpp"
#include "microswarm/navigation/following/path_navigator.hpp"
#include "microswarm/navigation/gathering/aggregation_navigator.hpp"
#include "microswarm/navigation/global_input/plan_executor.hpp"
#include "microswarm/navigation/hierarchical/hierarchical.hpp"
#include "microswarm/navigation/radar/radar.hpp"
#include "microswarm/navigation/safe_interval/safe_interval.hpp"

namespace microswarm::navigation {
namespace {

/// Calls visit.operator()<N>(p) with the navigator N that takes these parameters.
template <class... Navigators>
struct NavigatorKinds {
  template <class Result, class Visit>
  static Result visit(const NavigatorParams& params, Visit&& visit) {
    return std::visit(Overloaded{[&](const typename Navigators::Params& p) -> Result {
                        return visit.template operator()<Navigators>(p);
                      }...},
                      params);
  }
};

/// One for each kind of parameters; it does not compile without one of them.
using AllNavigators =
    NavigatorKinds<HierarchicalNavigator, PlanExecutor, AggregationNavigator, RadarNavigator,
                   StraightNavigator, PotentialFieldNavigator, VelocityObstacleNavigator,
                   PathNavigator, SafeIntervalNavigator>;

}  // namespace

std::string_view unsupported_reason(const NavigatorParams& params, const Task& task) {
  return AllNavigators::visit<std::string_view>(
      params, [&]<class N>(const auto&) { return N::unsupported_reason(task); });
}

Issues validate(const NavigatorParams& params, const Task& task, const Map& map,
                const IsGiven& is_given) {
  return std::visit(
      Overloaded{
          [&](const HierarchicalParams& p) { return validate(p, is_given); },
          [&](const RadarParams& p) { return validate(p, task.swarm, map, is_given); },
          [](const OneOf<AggregationParams, SafeIntervalParams> auto& p) { return validate(p); },
          [](const OneOf<PlanExecutorParams, StraightParams, PotentialFieldParams,
                         VelocityObstacleParams, PathNavigatorParams> auto&) { return Issues(); }},
      params);
}

std::unique_ptr<Navigator> make_navigator(const NavigatorParams& params, const Task& task,
                                          Rng rng) {
  return AllNavigators::visit<std::unique_ptr<Navigator>>(
      params, [&]<class N>(const auto& p) { return std::make_unique<N>(p, task, rng); });
}

}  // namespace microswarm::navigation

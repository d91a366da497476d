// SPDX-License-Identifier: Apache-2.0
// What is asked of a navigator's parameters, whatever its kind.
#include "microswarm/navigation/params.hpp"

#include <gtest/gtest.h>

namespace microswarm::navigation {
namespace {

const std::vector<NavigatorParams> one_of_each{
    HierarchicalParams{}, PlanExecutorParams{},   AggregationParams{},      RadarParams{},
    StraightParams{},     PotentialFieldParams{}, VelocityObstacleParams{}, PathNavigatorParams{},
    SafeIntervalParams{}};

TEST(NavigatorParams, ClearanceRangeAndFollowerAreTheNavigators) {
  ASSERT_EQ(one_of_each.size(), std::variant_size_v<NavigatorParams>);
  for (NavigatorParams params : one_of_each) {
    const auto* drrt = std::get_if<HierarchicalParams>(&params);
    const auto* radar = std::get_if<RadarParams>(&params);
    EXPECT_EQ(required_clearance(params), drrt ? drrt->clearance : 0) << params.index();
    EXPECT_EQ(required_detection_range(params), radar ? radar->detection_range : 50)
        << params.index();
    const bool follows = drrt || std::holds_alternative<PathNavigatorParams>(params);
    EXPECT_EQ(find_follower(params) != nullptr, follows) << params.index();
  }
}

TEST(NavigatorParams, WhatIsPublishedSwitchesOurAdditionsOff) {
  const auto drrt =
      std::get<HierarchicalParams>(in_effect(HierarchicalParams{.as_published = true}));
  EXPECT_EQ(drrt.horizon, 0);
  const auto radar = std::get<RadarParams>(in_effect(RadarParams{.as_published = true}));
  EXPECT_FALSE(radar.safety_filter.active);
  for (const NavigatorParams& params : one_of_each)
    EXPECT_EQ(in_effect(params).index(), params.index());
}

}  // namespace
}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/map_scale.hpp"

#include "microswarm/navigation/gathering/policies/published_scale.hpp"

namespace microswarm::experiment {

void fit_gathering(Scenario& scenario, double width, double goal_width, int max_steps) {
  constexpr double speed = 80;  // [µm/s]
  auto& params = std::get<navigation::AggregationParams>(scenario.navigator);
  params.scale = width / navigation::published_channel_width;
  scenario.robots->max_speed = speed;
  scenario.tick = params.step * params.scale / speed;
  scenario.time_limit = max_steps * scenario.tick;
  constexpr double narrow = 0.7;  // of the typical width, for a goal in a narrower place
  scenario.goal_tolerance = goal_width < narrow * width ? goal_width : width;
}

void fit_swarm(Scenario& scenario, double width) {
  const double radius = 0.2 * width;
  const double speed = 7 * radius;  // [µm/s], a passage in two thirds of a second
  scenario.swarm = RibbonParams{.radius = radius, .max_speed = speed};
  navigation::HierarchicalParams params;
  params.clearance = 1.15 * radius;
  params.extra_clearance = 0.2 * radius;
  params.speed = 0.9 * speed;
  params.lookahead = 2.5 * radius;
  params.horizon = 2;
  params.route_cell = 0.75 * radius;
  params.target.base_distance = 17 * radius;
  params.target.detection_diameter = 13 * radius;
  params.planner.step = 3.3 * radius;
  params.planner.speed = 0.55 * speed;
  params.planner.time_step = 0.05;
  params.planner.search_radius = 6.5 * radius;
  params.planner.detection_diameter = 10 * radius;
  params.planner.goal_tolerance = 1.25 * radius;
  scenario.navigator = params;
  scenario.goal_tolerance = 2.5 * radius;
}

}  // namespace microswarm::experiment

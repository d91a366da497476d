// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/fit_clearance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "microswarm/experiment/scenario/passages.hpp"
#include "microswarm/navigation/steering/aim.hpp"

namespace microswarm::experiment {
namespace {

/// Relative uncertainty of the largest clearance with a path.
constexpr double fitted_share = 0.02;

bool has_path(const Scenario& scenario, const World& world, double clearance) {
  const Snapshot walls(world.map);
  const auto target =
      navigation::reachable_goal(walls, *scenario.goal, scenario.goal_tolerance, clearance);
  const Vec2 start = scenario.start->position;
  return target &&
         leads_to(*world.map, start, *target, std::min(clearance, world.map->clearance(start)));
}

}  // namespace

Notes fit_clearance(Scenario& scenario, const World& world, const IsGiven& is_given) {
  auto* const params = std::get_if<navigation::HierarchicalParams>(&scenario.navigator);
  if (!params || params->as_published || !scenario.start || !scenario.goal || scenario.robots)
    return {};
  const bool given = is_given && is_given("navigator.clearance_um");
  const double wanted = params->clearance;
  if (given || wanted != navigation::HierarchicalParams{}.clearance) return {};
  double low = swarm_limits(scenario.swarm).radius;
  if (!world.at(0).is_free(scenario.start->position, low)) return {};
  if (low >= wanted || has_path(scenario, world, wanted) || !has_path(scenario, world, low))
    return {};
  double high = wanted;
  while (high - low > fitted_share * low) {
    const double middle = 0.5 * (low + high);
    (has_path(scenario, world, middle) ? low : high) = middle;
  }
  params->clearance = low;
  return {
      fmt::format("navigator.clearance_um is {:.4g}: passages to the goal are too narrow for "
                  "its default, {:.4g}",
                  params->clearance, wanted)};
}

}  // namespace microswarm::experiment

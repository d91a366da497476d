// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/config/former_keys.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/formats/map_parts.hpp"
#include "microswarm/formats/map_spec.hpp"

namespace microswarm {

/// Robots that shall gather in a map under one input.
struct GatherQuery {
  Vec2 goal;
  int robots = 256;                       ///< at random starts, unless `starts` are given
  std::vector<Vec2> starts{};             ///< of each robot [µm]
  std::optional<double> channel_width{};  ///< scales all lengths [µm]; none: measured
  int max_steps = 100'000;
  std::vector<std::string> settings{};  ///< KEY=VALUE of the scenario, as from --set
  std::uint64_t seed = 1;
};

/// The experiment that simulates it.
struct GatherExperiment {
  Experiment experiment;
  double measured_width = 0;  ///< typical width of the map's channels [µm]
  Notes notes{};              ///< one for each outdated key in the settings
};

/// Prepares the simulation with the lengths and the speed of fit_gathering, then applies the
/// settings. `spec` is where the map's parts come from, as the scenario says it, and `name` stands
/// for it in messages. Throws InputError with a line for each issue.
GatherExperiment open_gathering(MapParts map, MapSpec spec, const GatherQuery& query,
                                const std::string& name);

/// Assumptions of [gather] that the map and the goal of an aggregating navigator do not meet, one
/// line each; none for other navigators.
std::vector<std::string> unmet_assumptions(const Scenario& scenario, const Map& map);

}  // namespace microswarm

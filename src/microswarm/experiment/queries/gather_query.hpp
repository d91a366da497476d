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

namespace microswarm::experiment {

/// Query for gathering robots in a map under one input.
struct GatherQuery {
  Vec2 goal{};
  int robots = 256;                       ///< number, at random starts unless `starts` is given
  std::vector<Vec2> starts{};             ///< start of each robot [µm]
  std::optional<double> channel_width{};  ///< scales all lengths [µm]; default: measured
  int max_steps = 100'000;
  Settings settings{};  ///< of the scenario
  std::uint64_t seed = 1;
};

/// The experiment that answers a GatherQuery.
struct GatherExperiment {
  Experiment experiment{};
  double measured_width = 0;  ///< typical width of the map's channels [µm]
  Notes notes{};              ///< one for each former key in the settings
};

/// Prepares the simulation with the lengths and the speed of fit_gathering, then applies the
/// settings. `spec` is the source of the map's parts for the scenario, `name` its name in messages.
/// Throws InputError with a line for each issue.
GatherExperiment open_gathering(formats::MapParts map, formats::MapSpec spec,
                                const GatherQuery& query, const std::string& name);

/// Assumptions of [gather] that the map and the goal of an aggregating navigator do not meet, one
/// line each; none for other navigators.
std::vector<std::string> unmet_assumptions(const Scenario& scenario, const Map& map);

}  // namespace microswarm::experiment

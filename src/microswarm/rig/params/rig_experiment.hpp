// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::rig {

/// A scenario and its rig, read and validated.
struct RigExperiment {
  experiment::Experiment experiment;
  Rig rig;

  const experiment::Scenario& scenario() const { return experiment.scenario(); }
};

/// Reads both files. Throws InputError with one line per issue.
RigExperiment open_rig_experiment(const std::filesystem::path& scenario, const Settings& settings,
                                  const std::filesystem::path& rig, const Settings& rig_settings,
                                  std::optional<std::uint64_t> seed = std::nullopt);

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/params/rig_experiment.hpp"

namespace microswarm::rig {

RigExperiment open_rig_experiment(const std::filesystem::path& scenario, const Settings& settings,
                                  const std::filesystem::path& rig, const Settings& rig_settings,
                                  std::optional<std::uint64_t> seed) {
  RigExperiment on{experiment::open_experiment(scenario, settings, seed),
                   read_rig(rig, rig_settings)};
  on.experiment.keys.require_none(validate(on.rig, on.scenario()));
  on.experiment.keys.add_notes(on.rig.keys.notes());
  return on;
}

}  // namespace microswarm::rig

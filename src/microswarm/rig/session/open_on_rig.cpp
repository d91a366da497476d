// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/session/open_on_rig.hpp"

#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"

namespace microswarm::rig {

MapCheck check_simulated_map(const RigExperiment& on) {
  RigSimulator simulator(on.scenario(), on.experiment.world, on.rig);
  const PictureRegistration registration(*on.experiment.world.map, simulator.camera());
  return check_map(registration.fit(simulator.render(simulator.capture()), true),
                   on.rig.params.safety.max_map_shift_px);
}

void require_simulated_map(const RigExperiment& on) {
  const MicroscopeParams& microscope = simulated_camera(on.rig).microscope;
  const bool is_displaced =
      microscope.shift_px != Vec2{} || microscope.turn != 0 || microscope.scale_error != 0;
  if (!is_displaced || microscope.moved_after > 0) return;
  if (const MapCheck check = check_simulated_map(on); !check.good)
    throw on.rig.keys.error("camera.microscope", check.text);
}

std::unique_ptr<experiment::Session> open_on_rig(const RigExperiment& on, std::uint32_t trial) {
  require_field(on.rig);
  require_simulated_map(on);
  experiment::SessionParts parts{.trial = trial, .rig = rig_name(on.rig)};
  parts.plant = std::make_shared<SimulatedRig>(on.scenario(), on.experiment.world, on.rig, trial);
  return std::make_unique<experiment::Session>(on.experiment, std::move(parts));
}

std::unique_ptr<experiment::Session> open_on_rig(const std::filesystem::path& file,
                                                 const RigSessionOptions& options) {
  if (experiment::is_record(file) && !(options.rig.empty() && options.rig_settings.empty()))
    throw InputError(file.string(), "a record accepts no options");
  if (options.rig.empty() && !options.rig_settings.empty())
    throw InputError("values of a rig are set, but there is no rig");
  if (options.rig.empty()) return experiment::open_session(file, options.settings);
  return open_on_rig(
      open_rig_experiment(file, options.settings, options.rig, options.rig_settings));
}

}  // namespace microswarm::rig

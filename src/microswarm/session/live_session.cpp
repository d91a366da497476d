// SPDX-License-Identifier: Apache-2.0
#include "microswarm/session/live_session.hpp"

#include "microswarm/rig/runtime/command_log.hpp"

namespace microswarm {

namespace {

/// A swarm cannot follow if nothing goes to the coils or a video plays.
RigExperiment without_following(RigExperiment on, bool dry) {
  if (dry || std::holds_alternative<VideoCamera>(on.rig.params.camera))
    on.rig.params.safety.min_follow_share = 0;
  return on;
}

}  // namespace

/// A live rig that owns its devices.
class LiveSession::LivePlant : public Plant {
 public:
  LivePlant(RigExperiment on, bool dry, const std::filesystem::path& folder)
      : on_(without_following(std::move(on), dry)),
        devices_(open_devices(on_, dry)),
        log_(folder, on_.rig.system, dry),
        rig_(on_.scenario(), on_.experiment.world.map, on_.rig, std::move(devices_.camera),
             devices_.scale, devices_.driver(), [this](const CoilMoment& m) { log_.add(m); }) {}

  Observation observe() override { return rig_.observe(); }
  void apply(const Command& command, double dt) override { rig_.apply(command, dt); }
  std::string_view fault() const override { return rig_.fault(); }

  LiveRig& rig() { return rig_; }
  CommandLog& log() { return log_; }

 private:
  RigExperiment on_;
  Devices devices_;
  CommandLog log_;
  LiveRig rig_;
};

LiveSession::LiveSession(const RigExperiment& on, const std::string& name,
                         std::unique_ptr<Plant> owned, LivePlant* plant)
    : Session(on.experiment, 0, std::move(owned), nullptr, name), plant_(plant) {}

std::unique_ptr<LiveSession> LiveSession::open(const RigExperiment& on, bool dry,
                                               const std::filesystem::path& folder) {
  auto plant = std::make_unique<LivePlant>(on, dry, folder);
  LivePlant* const live = plant.get();
  return std::unique_ptr<LiveSession>(
      new LiveSession(on, name_of(on.rig) + (dry ? ", dry run" : ""), std::move(plant), live));
}

void LiveSession::stop(const std::string& why) { plant_->rig().stop(why); }

std::string LiveSession::close() {
  stop("the run has ended");
  return plant_->log().finish(plant_->rig().zero_at(), zero_is_confirmed());
}

bool LiveSession::zero_is_confirmed() const { return plant_->rig().zero_is_confirmed(); }

int LiveSession::resumed() const { return plant_->rig().resumed(); }

RigTiming LiveSession::timing() const { return plant_->rig().timing(); }

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/devices.hpp"

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"

namespace microswarm::rig {
namespace {

/// A video played at its own rate.
class PacedVideo : public vision::FrameSource {
 public:
  explicit PacedVideo(std::unique_ptr<vision::FrameSource> video)
      : video_(std::move(video)), began_(steady_seconds()) {}
  bool next(vision::VideoFrame& frame) override {
    if (!video_->next(frame)) return false;
    if (!first_) first_ = frame.t;
    const double left = began_ + (frame.t - *first_) - steady_seconds();
    if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
    return true;
  }
  std::string why_ended() const override { return video_->why_ended(); }
  std::optional<int> count() const override { return video_->count(); }
  std::optional<double> rate() const override { return video_->rate(); }
  std::optional<double> um_per_px() const override { return video_->um_per_px(); }
  std::vector<std::string> notes() const override { return video_->notes(); }

 private:
  std::unique_ptr<vision::FrameSource> video_;
  double began_;
  std::optional<double> first_;  ///< time of the first picture [s]
};

std::unique_ptr<vision::FrameSource> open_video(const VideoCamera& video, const Rig& rig) {
  if (video.file.empty()) throw rig.keys.error("camera.file", "which video is missing");
  return std::make_unique<PacedVideo>(vision::open_frames(rig.folder / video.file, video.rate));
}

}  // namespace

std::unique_ptr<actuation::CoilDriver> open_coils(const Rig& rig) {
  const actuation::CoilSite site{rig.folder, rig.folder / rig.params.coils, rig.system.size()};
  return std::visit([&](const auto& driver) { return driver.open(site); }, rig.params.driver);
}

std::unique_ptr<vision::FrameSource> open_rig_camera(const Rig& rig) {
  return std::visit(
      Overloaded{[](const SimulatedCamera&) { return std::unique_ptr<vision::FrameSource>(); },
                 [](const OneOf<vision::CameraParams, vision::GenicamParams> auto& c) {
                   return vision::open_camera(c);
                 },
                 [&](const VideoCamera& video) { return open_video(video, rig); }},
      rig.params.camera);
}

Devices open_devices(const RigExperiment& on, bool dry, bool idle) {
  const RigParams& rig = on.rig.params;
  Devices devices;
  devices.coils = dry ? simulated_coils(on.rig) : open_coils(on.rig);
  if (const auto* simulated = std::get_if<SimulatedCamera>(&rig.camera)) {
    devices.simulator = std::make_unique<RealtimeRigSimulator>(
        on.scenario(), on.experiment.world, on.rig, std::move(devices.coils), dry && idle);
    devices.camera = devices.simulator->camera(simulated->rate);
    devices.scale = devices.simulator->view().scale;
    return devices;
  }
  if (!rig.scale)
    throw on.rig.keys.error("scale",
                            "`scale` is missing: it says where the camera sees the world, see "
                            "`microswarm rig scale`");
  devices.camera = open_rig_camera(on.rig);
  devices.camera_rate = devices.camera->rate();
  devices.scale = *rig.scale;
  return devices;
}

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#include "rig_devices.hpp"

#include <fmt/core.h>

#include <chrono>
#include <thread>

#include "cli.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"
#include "microswarm/vision/camera/newest_frame.hpp"

namespace microswarm::cli {
namespace {

constexpr double simulated_rate = 60;  // [Hz] of a simulated camera

std::unique_ptr<CoilDriver> open_coils(const RigParams& rig, bool dry) {
  if (const auto* serial = std::get_if<SerialCoilParams>(&rig.driver); serial && !dry)
    return std::make_unique<SerialCoilDriver>(*serial);
  return simulated_coils(rig);
}

/// A video at its own pace.
class PacedVideo : public FrameSource {
 public:
  explicit PacedVideo(std::unique_ptr<FrameSource> video)
      : video_(std::move(video)), began_(steady_seconds()) {}
  bool next(VideoFrame& frame) override {
    if (!video_->next(frame)) return false;
    const double left = began_ + frame.t - steady_seconds();
    if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
    return true;
  }
  std::optional<int> count() const override { return video_->count(); }
  std::optional<double> rate() const override { return video_->rate(); }

 private:
  std::unique_ptr<FrameSource> video_;
  double began_;
};

}  // namespace

std::unique_ptr<FrameSource> open_camera_of(const Rig& rig) {
  if (const auto* camera = std::get_if<CameraParams>(&rig.params.camera))
    return open_camera(*camera);
  const auto& video = std::get<VideoCamera>(rig.params.camera);
  if (video.file.empty()) throw rig.where.error("camera.file", "which video is missing");
  return std::make_unique<PacedVideo>(open_frames(rig.folder / video.file, video.rate));
}

void note_field(const Rig& rig, const Scenario& scenario) {
  const std::string unusual = unusual_field(rig, scenario);
  if (!unusual.empty()) note("note: {}: {}\n", name_of(rig), unusual);
}

RigScene load_rig_scene(const std::filesystem::path& scenario,
                        const std::vector<std::string>& settings, const std::filesystem::path& rig,
                        const std::vector<std::string>& rig_settings) {
  Places places;
  Scene scene =
      load_scene(read_scenario(scenario, settings, places), scenario.parent_path(), places);
  World world = build_world(scene);
  check(scene.scenario, world, places);
  RigScene on{std::move(scene), std::move(world), read_rig(rig, {rig_settings, "--set-rig"})};
  check(on.rig, on.scene.scenario, places);
  note_field(on.rig, on.scene.scenario);
  return on;
}

Devices open_devices(const RigScene& on, bool dry) {
  const RigParams& rig = on.rig.params;
  Devices devices;
  devices.coils = open_coils(rig, dry);
  if (std::holds_alternative<SimulatedCamera>(rig.camera)) {
    devices.bench =
        std::make_unique<LiveBench>(on.scene.scenario, on.world, on.rig, std::move(devices.coils));
    devices.camera = devices.bench->camera(simulated_rate);
    devices.scale = devices.bench->view().scale;
    return devices;
  }
  if (!rig.scale)
    throw on.rig.where.error("scale",
                             "`scale` is missing: it says where the camera sees the world, see "
                             "`microswarm rig scale`");
  devices.camera = open_camera_of(on.rig);
  devices.scale = *rig.scale;
  return devices;
}

std::string quantiles(const Durations& times) {
  if (times.count() == 0) return "–";
  return fmt::format("{:.2f} / {:.2f} / {:.2f} ms", 1e3 * times.quantile(0.5),
                     1e3 * times.quantile(0.95), 1e3 * times.quantile(0.99));
}

}  // namespace microswarm::cli

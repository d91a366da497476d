// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/live_rig.hpp"

#include <fmt/core.h>

#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/rig/simulation/rig_simulator.hpp"

namespace microswarm::rig {
namespace {

constexpr double exposure_settles = 1;  // [s]
constexpr double first_frame = 5;       // [s] timeout of the first frame

const RigParams& checked(const Rig& rig, const experiment::Scenario& scenario) {
  KeyLocations().require_none(validate(rig, scenario));
  return rig.params;
}

CoilLoopLimits loop_limits(const Rig& rig, double tick) {
  const SafetyParams& safety = rig.params.safety;
  return {rig.params.drive_rate, deadman(rig, tick), safety.max_trips,
          safety.trip_window,    safety.max_pause,   urgent_priority(rig)};
}

void check_picture(const Rig& rig, const experiment::Scenario& scenario,
                   const vision::CameraScale& scale, const formats::Image& picture) {
  for (const Vec2 position : robot_positions(scenario)) {
    const Vec2 at = scale.to_picture(position);
    if (at.x < -0.5 || at.y < -0.5 || at.x > picture.width - 0.5 || at.y > picture.height - 0.5)
      throw rig.keys.error(
          "scale", fmt::format("the place ({:.6g}, {:.6g}) µm of the scenario is at pixel ({:.6g}, "
                               "{:.6g}), outside the picture of {} × {}",
                               position.x, position.y, at.x, at.y, picture.width, picture.height));
  }
}

}  // namespace

LiveRig::LiveRig(const experiment::Scenario& scenario, std::shared_ptr<const Map> map,
                 const Rig& rig, std::unique_ptr<vision::FrameSource> camera,
                 const vision::CameraScale& scale, actuation::CoilDriver& driver,
                 LiveRigListeners listeners)
    : priority_(rig),
      rig_(rig),
      has_virtual_(rig.params.virtual_obstacles &&
                   camera_kind(rig.params) != CameraKind::simulated),
      world_{std::move(map), has_virtual_ ? scenario.obstacles : std::vector<Obstacle>{}},
      scale_(scale),
      schedule_(scenario.tick, camera->rate()),
      camera_(std::move(camera), "camera", camera_watch(rig.params), listeners.pictures),
      controller_(rig.system, checked(rig, scenario).field, driver,
                  scenario.start ? scenario.start->heading : 0),
      sight_(rig.params.safety, rig.params.delay),
      listeners_(std::move(listeners)),
      start_(steady_seconds()),
      meter_(rig.system, scenario.tick),
      coils_(controller_, loop_limits(rig, scenario.tick), [this](const CoilMoment& moment) {
        meter_.add_output(moment);
        if (listeners_.coils) listeners_.coils(moment);
      }) {
  check_workspace(rig, scenario, *world_.map);
  if (!camera_.wait(frame_, first_frame))
    throw HardwareError(fmt::format("camera: no picture within {} s", first_frame));
  // The exposure of a camera settles; later pictures are compared with the one after that.
  if (device_camera(rig.params))
    for (const double until = steady_seconds() + exposure_settles; steady_seconds() < until;)
      camera_.wait(frame_, until - steady_seconds());
  const formats::Image& picture = frame_.frame.picture;
  check_picture(rig, scenario, scale, picture);
  const std::vector<Vec2> starts = scenario.robots ? scenario.robots->starts : std::vector<Vec2>{};
  experiment::Scenario shown = scenario;
  if (has_virtual_) shown.obstacles.clear();
  perception_ = make_perception(rig.params.perception, shown, *world_.map, starts,
                                {scale, picture.width, picture.height});
  registration_ = std::make_shared<PictureRegistration>(
      *world_.map, CameraView{scale, picture.width, picture.height});
  vision::take_channel(picture, vision::VideoChannel::grey, grey_);
  first_fit_ = registration_->fit(grey_, true);
  const double detail = detail_of(grey_);
  start_ = steady_seconds();
  read_frame();
  if (!first_fit_.unsure.empty())
    registration_->keep_still(grey_, moving_rings(*detections_, scale_));
  else
    sight_.watch().take({first_fit_, detail}, seen_);
  const double limit = rig.params.safety.max_map_shift_px;
  looks_ = std::make_unique<MapLooks>(registration_, limit > 0 ? limit : infinity);
}

Observation LiveRig::observe() {
  begun_ = since_start();
  if (fault_.why.empty()) take_frame();
  const double now = since_start();
  look_for_faults(now);
  if (listeners_.detections && seen_ > reported_) {
    reported_ = seen_;
    listeners_.detections(*detections_, seen_);
  }
  return to_observation(*detections_, std::make_shared<const Snapshot>(world_then()), now, seen_);
}

/// World at the newest picture: virtual obstacles, then the bodies that the picture shows.
Snapshot LiveRig::world_then() const {
  std::vector<Body> moving = detections_->moving;
  const auto virtual_ones = static_cast<std::uint32_t>(world_.obstacles.size());
  for (Body& body : moving) body.obstacle += virtual_ones;
  for (std::uint32_t i = 0; i < virtual_ones; ++i)
    append_bodies(world_.obstacles[i], i, seen_, moving);
  return Snapshot(world_.map, seen_, std::move(moving));
}

bool LiveRig::set_obstacles(const std::vector<Obstacle>& obstacles) {
  if (has_virtual_) world_.obstacles = obstacles;
  return has_virtual_;
}

void LiveRig::take_frame() {
  schedule_.start(since_start());
  try {
    const bool is_new =
        camera_.wait(frame_, schedule_.latest() - since_start(), start_ + schedule_.earliest());
    begun_ = since_start();
    schedule_.begin(is_new ? std::optional(frame_.taken - start_) : std::nullopt);
    if (is_new) read_frame();
  } catch (const HardwareError& e) {
    fail(e.what(), FaultKind::camera);
  }
}

void LiveRig::read_frame() {
  seen_ = frame_.taken - start_;
  const double began = steady_seconds();
  vision::take_channel(frame_.frame.picture, vision::VideoChannel::grey, grey_);
  detections_ = &perception_->process(grey_, seen_);
  const double took = steady_seconds() - began;
  sight_.take(grey_, *detections_, {scale_, grey_.width, grey_.height}, seen_,
              perception_->follow_distance());
  const bool is_one_body = detections_->robots.empty();
  meter_.add_picture(took, is_one_body ? !detections_->swarm : detections_->unseen,
                     sight_.direction());
}

/// Has the map looked at once a second, and again at once when it is in doubt.
void LiveRig::look_at_map() {
  constexpr double period = 1;  // [s]
  if (const auto look = looks_->take()) {
    sight_.watch().take(look->first, look->second);
    if (sight_.watch().is_in_doubt()) look_due_ = seen_;
  }
  if (seen_ >= look_due_ && looks_->offer(grey_, seen_)) look_due_ = seen_ + period;
}

void LiveRig::look_for_faults(double now) {
  const SafetyParams& safety = rig_.params.safety;
  if (const Fault failure = coils_.fault(); failure.kind != FaultKind::none)
    return fail(failure.why, failure.kind);
  const vision::CameraStatus camera = camera_.status();
  if (camera.state == vision::CameraState::frozen || camera.state == vision::CameraState::black)
    return fail(fmt::format("the camera's pictures are {}", enum_name(camera.state)),
                FaultKind::camera);
  if (camera.state == vision::CameraState::ended) {
    const std::string why = camera.why.empty() ? camera.why : ": " + camera.why;
    return fail("the camera has no more pictures" + why, FaultKind::camera);
  }
  look_at_map();
  if (const Fault seen = sight_.fault(now); !seen.why.empty()) return fail(seen.why, seen.kind);
  if (missed_in_a_row_ >= safety.missed_deadlines)
    return fail(fmt::format("{} ticks in a row ended too late", missed_in_a_row_),
                FaultKind::computer);
  meter_.add_frame_age(now - seen_);
}

void LiveRig::apply(const Command& command, double dt) {
  const double now = since_start();
  const bool missed = !schedule_.end(now, dt);
  meter_.add_tick(now - begun_, missed);
  missed_in_a_row_ = missed ? missed_in_a_row_ + 1 : 0;
  perception_->commanded(command, now);
  const Vec2 position =
      detections_->swarm ? detections_->swarm->pose.position : world_.map->bounds().centre();
  coils_.command(command, place_among_coils(rig_.system, *world_.map, position), frame_.taken);
  coils_.wait(schedule_.earliest() - since_start());
}

void LiveRig::fail(const std::string& why, FaultKind kind) {
  coils_.stop(why, kind);
  if (fault_.why.empty()) fault_ = {why, kind};
}

RigTiming LiveRig::timing() const {
  RigTiming timing = meter_.timing();
  const vision::CameraStatus camera = camera_.status();
  timing.dropped_frames = camera.dropped;
  timing.frame_gaps = camera.gaps;
  return timing;
}

}  // namespace microswarm::rig

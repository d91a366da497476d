// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/live_rig.hpp"

#include <fmt/core.h>

#include <cassert>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/rig/simulation/rig_simulator.hpp"

namespace microswarm::rig {
namespace {

constexpr double first_frame = 5;                   // [s] timeout of the first frame
constexpr double stretches_of_follow_distance = 6;  // over which a direction is estimated

const RigParams& checked(const Rig& rig, const experiment::Scenario& scenario) {
  KeyLocations().require_none(validate(rig, scenario));
  if (rig.params.safety.deadman < 2 * scenario.tick)
    throw rig.keys.error(
        "safety.deadman_s",
        fmt::format("safety.deadman_s is {:.6g}, a tick of the scenario {:.6g} s: it must be at "
                    "least twice that",
                    rig.params.safety.deadman, scenario.tick));
  return rig.params;
}

CoilLoopLimits loop_limits(const RigParams& rig) {
  const SafetyParams& safety = rig.safety;
  return {rig.drive_rate, safety.deadman, safety.max_trips, safety.trip_window, safety.max_pause};
}

std::string why_not_found(const Detections& seen) {
  if (!seen.not_found) return {};
  std::string radii;
  for (const double radius : seen.parts)
    radii += fmt::format("{}{:.3g}", radii.empty() ? "" : " and ", radius);
  switch (*seen.not_found) {
    case NotFound::none:
      return {};
    case NotFound::several:
      return " (there are several)";
    case NotFound::far:
      return " (what is seen is too far from where it was)";
    case NotFound::size:
      return " (what is seen is of another size)";
    case NotFound::split:
      return fmt::format(" (it split into parts of {} µm radius)", radii);
    case NotFound::merged:
      return fmt::format(" (it merged with another: they had {} µm radius)", radii);
    case NotFound::robots:
      return fmt::format(" ({} of {} robots are not seen)", seen.unseen, seen.robots.size());
  }
  assert(false);
  return {};
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
    : rig_(rig),
      has_virtual_(rig.params.virtual_obstacles &&
                   camera_kind(rig.params) != CameraKind::simulated),
      world_{std::move(map), has_virtual_ ? scenario.obstacles : std::vector<Obstacle>{}},
      scale_(scale),
      schedule_(scenario.tick, camera->rate()),
      camera_(std::move(camera), "camera", camera_watch(rig.params), listeners.pictures),
      controller_(rig.system, checked(rig, scenario).field, driver,
                  scenario.start ? scenario.start->heading : 0),
      following_(rig.params.safety.min_follow_share),
      listeners_(std::move(listeners)),
      start_(steady_seconds()),
      meter_(rig.system, scenario.tick),
      coils_(controller_, loop_limits(rig.params), [this](const CoilMoment& moment) {
        meter_.add_output(moment);
        if (listeners_.coils) listeners_.coils(moment);
      }) {
  check_workspace(rig, scenario, *world_.map);
  if (!camera_.wait(frame_, first_frame))
    throw HardwareError(fmt::format("camera: no picture within {} s", first_frame));
  const formats::Image& picture = frame_.frame.picture;
  check_picture(rig, scenario, scale, picture);
  const std::vector<Vec2> starts = scenario.robots ? scenario.robots->starts : std::vector<Vec2>{};
  experiment::Scenario shown = scenario;
  if (has_virtual_) shown.obstacles.clear();
  perception_ = make_perception(rig.params.perception, shown, *world_.map, starts,
                                {scale, picture.width, picture.height});
  start_ = steady_seconds();
  read_frame();
}

Observation LiveRig::observe() {
  begun_ = since_start();
  if (fault_.empty()) take_frame();
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
    fail(e.what());
  }
}

void LiveRig::read_frame() {
  seen_ = frame_.taken - start_;
  const double began = steady_seconds();
  vision::take_channel(frame_.frame.picture, vision::VideoChannel::grey, grey_);
  detections_ = &perception_->process(grey_, seen_);
  const double took = steady_seconds() - began;
  if (detections_->swarm) found_ = seen_;
  const double distance =
      rig_.params.safety.follow_distance.value_or(perception_->follow_distance());
  angle_.take(detections_->commanded_distance, detections_->followed_distance,
              detections_->across_distance, distance / stretches_of_follow_distance);
  if (!following_.take(detections_->commanded_distance, detections_->followed_distance, distance)) {
    lost_following_ = fault_.empty();
    fail(
        fmt::format("the swarm does not follow: of {:.3g} µm that were commanded it went {:.3g} µm",
                    following_.commanded(), following_.followed()));
  }
  meter_.add_picture(took, detections_->unseen, angle_.direction());
}

void LiveRig::look_for_faults(double now) {
  const SafetyParams& safety = rig_.params.safety;
  if (const std::string why = coils_.failure(); !why.empty()) return fail(why);
  const vision::CameraStatus camera = camera_.status();
  if (camera.state == vision::CameraState::frozen || camera.state == vision::CameraState::black)
    return fail(fmt::format("the camera's pictures are {}", enum_name(camera.state)));
  if (camera.state == vision::CameraState::ended) {
    const std::string why = camera.why.empty() ? camera.why : ": " + camera.why;
    return fail("the camera has no more pictures" + why);
  }
  const double age = now - seen_;
  if (age > safety.max_frame_age)
    return fail(
        fmt::format("the newest picture is {:.2f} s old, allowed {} s", age, safety.max_frame_age));
  if (now - found_ > safety.lost_swarm)
    return fail(fmt::format("the swarm was not found for {:.2f} s{}, allowed {} s", now - found_,
                            why_not_found(*detections_), safety.lost_swarm));
  if (missed_in_a_row_ >= safety.missed_deadlines)
    return fail(fmt::format("{} ticks in a row ended too late", missed_in_a_row_));
  meter_.add_frame_age(age);
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

void LiveRig::fail(const std::string& why) {
  stop(why);
  if (fault_.empty()) fault_ = why;
}

RigTiming LiveRig::timing() const {
  RigTiming timing = meter_.timing();
  timing.dropped_frames = camera_.status().dropped;
  return timing;
}

}  // namespace microswarm::rig

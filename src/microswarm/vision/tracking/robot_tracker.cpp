// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/robot_tracker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm::vision {

RobotTracker::RobotTracker(const TrackerParams& p, double diameter, double frame_time)
    : noise_{.measurement = p.measurement.value_or(diameter / 50),
             .jitter = p.jitter.value_or(diameter / 10),
             .speed_change = p.speed_change.value_or(diameter / 100 / frame_time),
             .start_speed = p.start_speed.value_or(
                 std::max(diameter / 20, p.search_range.value_or(0) / 2) / frame_time)},
      gate_(p.gate),
      search_range_(search_range(p, diameter)),
      is_range_given_(p.search_range.has_value()),
      touch_(p.touch.value_or(1.2 * diameter)),
      frame_time_(frame_time),
      memory_(p.memory),
      lasting_(p.min_lifetime) {
  assert(diameter > 0 && frame_time > 0);
}

const std::vector<SeenRobot>& RobotTracker::step(int frame, std::span<const Vec2> seen,
                                                 std::optional<double> elapsed) {
  predict(elapsed.value_or(frame_time_));
  find_candidates(seen);
  match(frame, seen);
  give_birth(frame, seen);
  bury();
  return sightings_;
}

void RobotTracker::predict(double elapsed) {
  RobotNoise noise = noise_;
  if (std::abs(elapsed - frame_time_) > 1e-9 * frame_time_) {  // else rounding of even times
    noise.jitter *= std::sqrt(elapsed / frame_time_);
    noise.speed_change *= std::sqrt(elapsed / frame_time_);
  } else {
    elapsed = frame_time_;
  }
  for (Robot& robot : robots_) robot.filter.predict(elapsed, noise);
}

void RobotTracker::finish() {
  for (Robot& robot : robots_) robot.missed = memory_ + 1;
  bury();
}

/// Collects pairs within reach, with the negative log-likelihood as cost: an uncertain robot has a
/// weaker claim to a position than one predicted there. A position within a given range is a
/// candidate however unlikely it is, and better than none.
void RobotTracker::find_candidates(std::span<const Vec2> seen) {
  by_height_.resize(seen.size());
  std::iota(by_height_.begin(), by_height_.end(), 0);
  std::sort(by_height_.begin(), by_height_.end(),
            [&](int a, int b) { return seen[a].y != seen[b].y ? seen[a].y < seen[b].y : a < b; });
  double least = 0;
  for (const Robot& robot : robots_) {
    const double variance = robot.filter.seen_variance(noise_);
    least = least > 0 ? std::min(least, variance) : variance;
  }
  edges_.clear();
  unseen_cost_ = gate_ * gate_;
  for (int row = 0; row < std::ssize(robots_); ++row) {
    const RobotFilter& filter = robots_[row].filter;
    const double variance = filter.seen_variance(noise_);
    const double reach =
        is_range_given_ ? search_range_ : std::min(search_range_, gate_ * std::sqrt(variance));
    const double doubt = 2 * maths::log(variance / least);
    if (is_range_given_ && variance > 0)
      unseen_cost_ = std::max(unseen_cost_, reach * reach / variance + doubt);
    auto at = std::lower_bound(by_height_.begin(), by_height_.end(), filter.place().y - reach,
                               [&](int i, double y) { return seen[i].y < y; });
    for (; at != by_height_.end() && seen[*at].y <= filter.place().y + reach; ++at) {
      const double squared = squared_norm(seen[*at] - filter.place());
      if (squared <= reach * reach) edges_.push_back({row, *at, squared / variance + doubt});
    }
  }
}

void RobotTracker::match(int frame, std::span<const Vec2> seen) {
  const auto& column_at = assignment_.solve(static_cast<int>(robots_.size()),
                                            static_cast<int>(seen.size()), edges_, unseen_cost_);
  sightings_.assign(seen.size(), {});
  robot_at_.assign(seen.size(), std::nullopt);
  for (int row = 0; row < std::ssize(robots_); ++row) {
    Robot& robot = robots_[row];
    if (!column_at[row]) {
      ++robot.missed;
      continue;
    }
    robot_at_[*column_at[row]] = row;
    robot.filter.correct(seen[*column_at[row]], noise_);
  }
  for (Robot& robot : robots_)
    if (robot.missed > 0) miss(robot, frame, seen);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!robot_at_[i]) continue;
    Robot& robot = robots_[*robot_at_[i]];
    meet(robot, frame, seen[i], seen);
    sightings_[i] = {robot.id, robot.filter.place(), robot.filter.velocity()};
  }
}

/// A robot that vanished next to another and stays away has merged with it.
void RobotTracker::miss(Robot& robot, int frame, std::span<const Vec2> seen) {
  if (robot.missed == 1) {
    robot.vanished.reset();
    robot.appeared.reset();
    if (robot.run >= lasting_)
      robot.vanished = touched(robot.filter.place(), robot.id, frame, seen);
    robot.run = 0;
  }
  if (robot.vanished && robot.missed == std::min(lasting_, memory_ + 1)) {
    events_.push_back({robot.vanished->frame, TrackChange::merge, robot.id, robot.vanished->other});
    robot.merged = true;
  }
}

/// A robot that returns from a merge has split off if it stays.
void RobotTracker::meet(Robot& robot, int frame, Vec2 position, std::span<const Vec2> seen) {
  if (robot.merged) robot.appeared = touched(position, robot.id, frame, seen);
  robot.merged = false;
  robot.missed = 0;
  robot.last_frame = frame;
  ++robot.run;
  note_split(robot);
}

void RobotTracker::note_split(Robot& robot) {
  if (!robot.appeared || robot.run < lasting_) return;
  events_.push_back({robot.appeared->frame, TrackChange::split, robot.id, robot.appeared->other});
  robot.appeared.reset();
}

/// The nearest other robot seen in this frame within touching distance of `position` that has been
/// seen for long enough.
std::optional<RobotTracker::Touch> RobotTracker::touched(Vec2 position, int of, int frame,
                                                         std::span<const Vec2> seen) const {
  std::optional<Touch> nearest;
  double least = touch_ * touch_;
  auto at = std::lower_bound(by_height_.begin(), by_height_.end(), position.y - touch_,
                             [&](int i, double y) { return seen[i].y < y; });
  for (; at != by_height_.end() && seen[*at].y <= position.y + touch_; ++at) {
    const double squared = squared_norm(seen[*at] - position);
    if (!robot_at_[*at] || squared > least) continue;
    const Robot& other = robots_[*robot_at_[*at]];
    if (other.id == of || other.run < lasting_) continue;
    least = squared;
    nearest = Touch{frame, other.id};
  }
  return nearest;
}

void RobotTracker::give_birth(int frame, std::span<const Vec2> seen) {
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (robot_at_[i]) continue;
    const int id = next_id_++;
    events_.push_back({frame, TrackChange::birth, id, {}});
    robots_.push_back({.id = id, .last_frame = frame, .filter = RobotFilter(seen[i], noise_)});
    if (frame_) robots_.back().appeared = touched(seen[i], id, frame, seen);
    note_split(robots_.back());
    sightings_[i] = {id, seen[i], {}};
  }
  frame_ = frame;
}

void RobotTracker::bury() {
  for (const Robot& robot : robots_)
    if (robot.missed > memory_)
      events_.push_back({robot.last_frame, TrackChange::death, robot.id, {}});
  std::erase_if(robots_, [&](const Robot& robot) { return robot.missed > memory_; });
}

}  // namespace microswarm::vision

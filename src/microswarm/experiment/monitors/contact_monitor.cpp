// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/monitors/contact_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::experiment {

namespace {

constexpr int max_samples = 20'000;  // of one obstacle on one trajectory

double find_top_speed(std::span<const PoseStamped> poses) {
  double speed = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    speed = std::max(speed, distance(poses[i - 1].pose.position, poses[i].pose.position) /
                                (poses[i].t - poses[i - 1].t));
  return speed;
}

/// Maximum growth rate of the radius [µm/s].
double find_top_growth(std::span<const PoseStamped> poses) {
  double growth = 0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (poses[i].radius != poses[i - 1].radius)
      growth = std::max(
          growth, std::abs(poses[i].radius - poses[i - 1].radius) / (poses[i].t - poses[i - 1].t));
  return growth;
}

/// Minimum of a distance between two moments if it changes by at most `reach`.
double min_between(double at_first, double at_last, double reach) {
  const double sum = at_first + at_last;
  return sum < infinity ? (sum - reach) / 2 : std::min(at_first, at_last) - reach;
}

double speed_at(std::span<const PoseStamped> poses, double t) {
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (poses[i].t >= t)
      return distance(poses[i - 1].pose.position, poses[i].pose.position) /
             (poses[i].t - poses[i - 1].t);
  return 0;
}

}  // namespace

struct ContactMonitor::Course {
  double t0;
  std::span<const PoseStamped> poses;
  double top_speed;
  double top_growth;
};

ContactMonitor::ContactMonitor(const World& world) : world_(&world) { take_obstacles(); }

void ContactMonitor::take_obstacles() {
  top_speeds_.clear();
  for (const Obstacle& obstacle : world_->obstacles) top_speeds_.push_back(top_speed(obstacle));
  touching_.resize(world_->obstacles.size(), false);
}

std::vector<RunEvent> ContactMonitor::follow(double t0, std::span<const PoseStamped> trajectory) {
  std::vector<RunEvent> events;
  if (trajectory.empty()) return events;
  const Course course{t0, trajectory, find_top_speed(trajectory), find_top_growth(trajectory)};
  if (const auto touch = wall_touch(course)) events.push_back(*touch);
  for (std::uint32_t i = 0; i < world_->obstacles.size(); ++i) {
    const std::optional<Sample> touch = first_touch(course, i);
    if (touch && !touching_[i])
      events.push_back({.t = t0 + touch->t,
                        .kind = EventKind::contact_obstacle,
                        .position = moment_on(trajectory, touch->t).pose.position,
                        .clearance = touch->clearance,
                        .speed = speed_at(trajectory, touch->t),
                        .body = i});
    touching_[i] = touch && sample(course, i, trajectory.back().t).gap < 0;
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const RunEvent& a, const RunEvent& b) { return a.t < b.t; });
  return events;
}

ContactMonitor::Sample ContactMonitor::sample(const Course& course, std::uint32_t obstacle,
                                              double t) {
  bodies_.clear();
  append_bodies(world_->obstacles[obstacle], obstacle, course.t0 + t, bodies_);
  const PoseStamped swarm = moment_on(course.poses, t);
  double clearance = infinity;
  for (const Body& body : bodies_)
    clearance = std::min(clearance, distance(swarm.pose.position, body));
  if (clearance < obstacles_.clearance) obstacles_ = {clearance, course.t0 + t};
  const double gap = clearance - swarm.radius;
  min_gap_ = std::min(min_gap_, gap);
  return {t, clearance, gap};
}

// Bisects the trajectory, earlier half first, wherever a contact or a new minimum is possible.
std::optional<ContactMonitor::Sample> ContactMonitor::first_touch(const Course& course,
                                                                  std::uint32_t obstacle) {
  const double rate = course.top_speed + top_speeds_[obstacle];
  const double gap_rate = rate + course.top_growth;
  std::optional<Sample> touch;
  std::vector<std::pair<Sample, Sample>> open{
      {sample(course, obstacle, 0), sample(course, obstacle, course.poses.back().t)}};
  if (open.back().first.gap < 0) touch = open.back().first;
  for (int n = 0; n < max_samples && !open.empty(); ++n) {
    const auto [a, b] = open.back();
    open.pop_back();
    if (std::min(a.clearance, b.clearance) == infinity) continue;  // absent at both ends
    const double least = min_between(a.clearance, b.clearance, rate * (b.t - a.t));
    const double min_gap = min_between(a.gap, b.gap, gap_rate * (b.t - a.t));
    const bool may_touch = !touch && min_gap < 0 && std::min(a.gap, b.gap) - min_gap > resolution;
    const bool may_be_nearest =
        least < obstacles_.clearance - resolution || min_gap < min_gap_ - resolution;
    if (may_touch || may_be_nearest) {
      const Sample middle = sample(course, obstacle, (a.t + b.t) / 2);
      open.push_back({middle, b});
      open.push_back({a, middle});
    } else if (!touch && b.gap < 0) {
      // The gap decreases at its maximum rate here, hence linearly; a body that appears on the
      // swarm has none before.
      const double share = std::isinf(a.gap) ? 1 : a.gap / (a.gap - b.gap);
      touch = sample(course, obstacle, a.t + share * (b.t - a.t));
    }
  }
  return touch;
}

std::optional<RunEvent> ContactMonitor::wall_touch(const Course& course) {
  const Map& map = *world_->map;
  std::optional<RunEvent> event;
  bool touching = touching_wall_;
  for (std::size_t i = 0; i < course.poses.size(); ++i) {
    const PoseStamped& here = course.poses[i];
    const PoseStamped& before = course.poses[i > 0 ? i - 1 : 0];
    const Segment piece{before.pose.position, here.pose.position};
    const double radius = std::max(before.radius, here.radius);
    const double path_length_um = distance(piece.a, piece.b);
    if (map.field().lower(piece.b) - path_length_um >= std::max(walls_.clearance, radius)) {
      touching = false;
      continue;
    }
    // Inside the border, the distance to it is concave along the piece: minimal at an end.
    const double border = std::min(map.border_clearance(piece.a), map.border_clearance(piece.b));
    const double clearance = map.walls().clearance(piece, border);
    if (clearance < walls_.clearance) walls_ = {clearance, course.t0 + here.t};
    const bool touches = clearance < radius;
    if (touches && !touching && !event) {
      const std::size_t body = map.walls().nearest(piece.b, clearance + path_length_um);
      event = {.t = course.t0 + here.t,
               .kind = EventKind::contact_wall,
               .position = piece.b,
               .clearance = clearance,
               .speed = i > 0 ? path_length_um / (here.t - before.t) : 0,
               .body = body < map.walls().bodies().size() && clearance < border
                           ? map.walls().bodies()[body].obstacle
                           : border_body};
    }
    touching = touches;
  }
  touching_wall_ = touching;
  return event;
}

PoseStamped moment_on(std::span<const PoseStamped> trajectory, double t) {
  const auto after = std::find_if(trajectory.begin(), trajectory.end(),
                                  [t](const PoseStamped& pose) { return pose.t >= t; });
  if (after == trajectory.end()) return trajectory.back();
  if (after == trajectory.begin()) return *after;
  const PoseStamped& a = *std::prev(after);
  const double share = (t - a.t) / (after->t - a.t);
  return {t,
          {a.pose.position + share * (after->pose.position - a.pose.position),
           wrap(a.pose.heading + share * wrap(after->pose.heading - a.pose.heading))},
          a.radius + share * (after->radius - a.radius)};
}

}  // namespace microswarm::experiment

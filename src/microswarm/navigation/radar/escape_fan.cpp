// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/escape_fan.hpp"

#include <algorithm>
#include <utility>

#include "microswarm/core/execution/each_cpu.hpp"

namespace microswarm::navigation {
namespace {

constexpr double rounding = 1e-9;  // relative, of distances

struct Screened {
  std::int64_t open = 0, undecided = 0;
};

/// Marks positions nearer than √`near` as blocked, others nearer than √`far` as undecided [µm²].
MICROSWARM_EACH_CPU Screened screen_places(const EscapeFan::Positions& positions, double near,
                                           double far, std::int64_t* blocked,
                                           std::int64_t* undecided) {
  const EscapeFan::Positions at = positions;
  std::int64_t open = 0;
  std::int64_t undecided_count = 0;
  for (std::size_t k = 0; k < at.count; ++k) {
    const double x = at.off_x(k);
    const double y = at.off_y(k);
    const double squared = x * x + y * y;
    const std::int64_t is_blocked = blocked[k] | static_cast<std::int64_t>(squared < near);
    const std::int64_t is_undecided = (1 - is_blocked) & static_cast<std::int64_t>(squared < far);
    blocked[k] = is_blocked;
    undecided[k] = is_undecided;
    open += 1 - is_blocked;
    undecided_count += is_undecided;
  }
  return {open, undecided_count};
}

double squared_if_positive(double v) { return v > 0 ? v * v : 0; }

/// Straight remainder of a trajectory, from `before` on [s].
Segment last_leg(const ReachableObstacles& seen, const TwoLegTrajectory& trajectory,
                 double before) {
  const Vec2 start = seen.start().position;
  return {start + trajectory.at(before), start + trajectory.at(seen.end())};
}

}  // namespace

bool is_free(const ReachableObstacles& seen, const TwoLegTrajectory& trajectory,
             std::span<const SampleTime> times, double before) {
  const Vec2 start = seen.start().position;
  Vec2 last = start + trajectory.at(before);
  for (const SampleTime& i : times) {
    const Vec2 p = start + trajectory.at(i.t);
    const Vec2 from = std::exchange(last, p);
    if (!seen.is_clear(p, i) || !seen.is_free_of_walls(from, p, i.t)) return false;
  }
  return true;
}

EscapeFan::EscapeFan(std::vector<Vec2> velocities, double speed)
    : velocities_(std::move(velocities)),
      speed_(speed),
      blocked_(velocities_.size()),
      undecided_(velocities_.size()),
      undecided_indices_(velocities_.size()),
      off_x_(velocities_.size()),
      off_y_(velocities_.size()),
      distances_(velocities_.size()) {
  x_.reserve(velocities_.size());
  y_.reserve(velocities_.size());
  for (const Vec2 v : velocities_) {
    x_.push_back(v.x);
    y_.push_back(v.y);
  }
}

/// Blocks the velocities that get too near to a body; false once fewer than `count` remain.
/// `gap_at` returns the required gap [µm]. The last times come first, since most bodies are near
/// then.
template <class GapAt>
bool EscapeFan::screen(const ReachableObstacles& seen, const Trajectories& trajectories,
                       std::span<const SampleTime> times, ReachableObstacles::MotionError error,
                       GapAt&& gap_at, std::int64_t count) {
  std::fill(blocked_.begin(), blocked_.end(), 0);
  for (std::size_t i = times.size(); i-- > 0;) {
    const Demand demand{gap_at(times[i]), error};
    for (const ReachableObstacles::NearBody& body : seen.near(times[i]))
      if (screen_body(seen, body, trajectories, times[i].t, demand) < count) return false;
  }
  return static_cast<std::int64_t>(velocities_.size()) >= count;
}

bool EscapeFan::has_free(ReachableObstacles& seen, Vec2 begin, double until, int count) {
  const SampleTimes& schedule = seen.sample_times(until);
  const Trajectories trajectories{{begin, until, {}}};
  if (!is_free(seen, trajectories.common, schedule.first_leg(), 0)) return false;
  const auto goes_on = [&](std::size_t k) {
    return is_free(seen, trajectories[velocities_[k]], schedule.second_leg(), schedule.before());
  };
  if (count == 1 && goes_on(last_)) return true;
  const auto required = [](const SampleTime& i) { return i.required; };
  if (!screen(seen, trajectories, schedule.second_leg(), ReachableObstacles::MotionError::bounded,
              required, count))
    return false;
  const auto passes_walls = [&](std::size_t k) {
    const Segment leg = last_leg(seen, trajectories[velocities_[k]], schedule.before());
    return seen.passes_walls(leg) || (!seen.meets_walls(leg) && goes_on(k));
  };
  int found = 0;
  for (std::size_t k = 0; k < velocities_.size() && found < count; ++k) {
    if (blocked_[k] != 0 || !(seen.all_convex() ? passes_walls(k) : goes_on(k))) continue;
    last_ = k;
    ++found;
  }
  return found >= count;
}

// A gap changes by no more than the position does.
bool EscapeFan::excludes(ReachableObstacles& seen, Vec2 begin, double spread, double until,
                         int count) {
  const SampleTimes& schedule = seen.sample_times(until);
  const Trajectories trajectories{{begin, until, {}}};
  const auto slack = [&](double t) {
    return std::min(t, until) * spread * (1 + rounding) + rounding;
  };
  const auto required = [&](const SampleTime& i) { return i.required - slack(i.t); };
  for (const SampleTime& i : schedule.first_leg()) {
    const Vec2 p = seen.start().position + trajectories.common.at(i.t);
    if (seen.gap(p, i, i.required, ReachableObstacles::MotionError::bounded) < required(i))
      return true;
  }
  if (!screen(seen, trajectories, schedule.second_leg(), ReachableObstacles::MotionError::bounded,
              required, count))
    return true;
  int left = 0;
  for (std::size_t k = 0; k < velocities_.size() && left < count; ++k) {
    if (blocked_[k] != 0) continue;
    const Segment leg = last_leg(seen, trajectories[velocities_[k]], schedule.before());
    if (!seen.meets_walls(leg, slack(until))) ++left;
  }
  return left < count;
}

bool EscapeFan::may_keep(const ReachableObstacles& seen, const Trajectories& trajectories,
                         std::span<const SampleTime> times, const RequiredGap& least) {
  const auto gap_at = [&](const SampleTime& i) { return least.at(i.t); };
  return screen(seen, trajectories, times, ReachableObstacles::MotionError::none, gap_at, 1);
}

/// Blocks the velocities that get too near to this body; returns how many remain.
std::int64_t EscapeFan::screen_body(const ReachableObstacles& seen,
                                    const ReachableObstacles::NearBody& body,
                                    const Trajectories& trajectories, double t,
                                    const Demand& demand) {
  const Positions positions{x_.data(),
                            y_.data(),
                            x_.size(),
                            trajectories.varied_for(t),
                            trajectories.common.at(t),
                            seen.start().position,
                            body.centre};
  const ConvexOutline& outline = *body.outline;
  const double keep = body.touch[static_cast<std::size_t>(demand.error)] + demand.gap;
  const double far = std::max(0.0, outline.radius + keep) * (1 + rounding) + rounding;
  const Vec2 off = positions.start + positions.shift - positions.body;
  const double reach = (far + positions.after * speed_) * (1 + rounding);
  if (squared_norm(off) > reach * reach) return static_cast<std::int64_t>(x_.size());
  const double near =
      outline.edges.empty() ? (outline.radius + keep) * (1 - rounding) - rounding : 0;
  const Screened left = screen_places(positions, squared_if_positive(near), far * far,
                                      blocked_.data(), undecided_.data());
  return left.undecided == 0 ? left.open : left.open - test_exactly(positions, body, demand);
}

/// Computes the exact gap of the undecided velocities; blocks and counts those that get too near.
std::int64_t EscapeFan::test_exactly(const Positions& at, const ReachableObstacles::NearBody& body,
                                     const Demand& demand) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < at.count; ++k) {
    if (undecided_[k] == 0) continue;
    undecided_indices_[count] = k;
    off_x_[count] = at.off_x(k);
    off_y_[count++] = at.off_y(k);
  }
  const std::span<double> distances(distances_.data(), count);
  body.outline->distances_at({off_x_.data(), count}, {off_y_.data(), count}, distances);
  const double touch = body.touch[static_cast<std::size_t>(demand.error)];
  std::int64_t met = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(distances[i] - touch < demand.gap)) continue;
    blocked_[undecided_indices_[i]] = 1;
    ++met;
  }
  return met;
}

}  // namespace microswarm::navigation

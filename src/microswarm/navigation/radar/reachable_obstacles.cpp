// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/reachable_obstacles.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm::navigation {
namespace {

constexpr double clearance_rounding = 1e-6;  // [µm]
constexpr double keep_rounding = 1e-7;       // [µm]
constexpr double reach_rounding = 1e-9;      // relative
constexpr double asked_beyond = 1;           // the required gap [µm]

}  // namespace

ReachableObstacles::ReachableObstacles(const SafetyFilterParams& params, double speed)
    : params_(params),
      speed_(speed),
      samples_(static_cast<int>(std::ceil(params.horizon / params.step))),
      outliner_(params.tuning.outline) {}

// A body farther away cannot come near within the horizon unless it is much faster than the swarm.
double ReachableObstacles::range() const {
  return 3 * speed_ * (params_.horizon + params_.tuning.max_dead_time);
}

double ReachableObstacles::max_limit() const {
  return std::max(params_.gap + asked_beyond, params_.tuning.counted_gap);
}

void ReachableObstacles::predict(const EscapeStart& start, const Snapshot& world,
                                 const ObstacleTracker& tracker, double top_speed) {
  start_ = start;
  world_ = &world;
  seen_ = tracker.seen();
  top_speed_ = top_speed;
  near_.clear();
  sampled_.clear();
  scheduled_ = 0;
  if (threats_.size() < tracker.size()) threats_.resize(tracker.size());
  find_threats(tracker);
  if (empty()) return;
  gap_now_ = gap(start.position, predict_at(0), params_.gap, MotionError::none);
  look_at_walls(top_speed);
  for (int s = 1; s <= samples_; ++s) sampled_.push_back(predict_at(s * params_.step));
}

void ReachableObstacles::find_threats(const ObstacleTracker& tracker) {
  bodies_ = 0;
  nonconvex_bodies_.clear();
  closing_ = 0;
  const auto bodies = world_->moving().bodies();
  const double ahead = start_.time - seen_;
  for (std::size_t i = 0; i < bodies.size() && i < tracker.size(); ++i) {
    const Disc extent = enclosing_disc(bodies[i]);
    const double far = distance(extent.centre, start_.position) - extent.radius - start_.radius;
    if (far > range()) continue;
    const TrackedBody motion = tracker.body(i);
    const double widening = outward_speed(bodies[i], motion);
    const double closing = speed_ + norm(motion.velocity) + params_.gap_rate;
    if (far >
        params_.gap + closing * (params_.horizon + ahead) + widening * params_.tuning.growth_time)
      continue;
    Threat& met = threats_[bodies_];
    outliner_.take(bodies[i], met.outline);
    if (outliner_.misleads(met.outline, std::array{start_.position})) {
      nonconvex_bodies_.push_back(bodies[i]);
      const Disc reach{start_.position, start_.radius + speed_ * (params_.tuning.max_dead_time +
                                                                  params_.tuning.growth_time)};
      closing_ = std::max(
          closing_, tracker.outline_speed_within(i, bodies[i], reach) + norm(motion.velocity));
      continue;
    }
    met.velocity = motion.velocity;
    met.widening = widening;
    met.speed = widening + norm(motion.velocity);
    met.outline.centre = motion.centre_after(ahead);
    ++bodies_;
  }
  nonconvex_.assign(nonconvex_bodies_);
}

void ReachableObstacles::look_at_walls(double top_speed) {
  const double clearance = world_->map().clearance(start_.position);
  wall_keep_ = std::clamp(clearance - clearance_rounding, 0.0, start_.radius + params_.wall_gap);
  const double room = clearance - wall_keep_ - 2 * clearance_rounding;
  walls_from_ = room > 0 ? room / (top_speed * (1 + reach_rounding)) : 0;
}

/// Time for which outlines have grown, `t` seconds after the start [s].
double ReachableObstacles::grown_for(double t) const {
  return std::min(params_.tuning.growth_time, start_.time - seen_ + t);
}

SampleTime ReachableObstacles::predict_at(double t) {
  SampleTime out{.t = t,
                 .required = std::min(params_.gap, gap_now_ + params_.tuning.recovery_rate * t),
                 .first = static_cast<std::uint32_t>(near_.size()),
                 .last = 0};
  const double reach = top_speed_ * t + max_limit();
  for (std::size_t k = 0; k < bodies_; ++k) {
    const Threat& met = threats_[k];
    const double touch = start_.radius + met.widening * grown_for(t);
    const double error = std::min(params_.gap_rate, met.speed) * t;
    const Vec2 centre = met.outline.centre + t * met.velocity;
    const double far = met.outline.radius + (touch + error) + reach;
    if (squared_norm(start_.position - centre) > far * far * (1 + reach_rounding) && far >= 0)
      continue;
    near_.push_back({centre, {touch, touch + error}, &met.outline});
  }
  out.last = static_cast<std::uint32_t>(near_.size());
  return out;
}

const SampleTimes& ReachableObstacles::sample_times(double until) {
  const auto end = schedules_.begin() + static_cast<std::ptrdiff_t>(scheduled_);
  const auto known =
      std::find_if(schedules_.begin(), end, [&](const SampleTimes& s) { return s.until == until; });
  if (known != end) return *known;
  if (scheduled_ == schedules_.size()) schedules_.emplace_back();
  SampleTimes& fresh = schedules_[scheduled_++];
  fresh.until = until;
  fresh.times.clear();
  for (const SampleTime& i : sampled_) {
    if (i.t - params_.step < until && until < i.t) fresh.times.push_back(predict_at(until));
    fresh.times.push_back(i);
  }
  fresh.shared =
      static_cast<std::size_t>(std::find_if(fresh.times.begin(), fresh.times.end(),
                                            [&](const SampleTime& i) { return i.t > until; }) -
                               fresh.times.begin());
  return fresh;
}

double ReachableObstacles::gap(Vec2 p, const SampleTime& at, double limit,
                               MotionError error) const {
  double least = limit;
  for (const NearBody& met : near(at)) {
    const double touch = met.touch[static_cast<std::size_t>(error)];
    const Vec2 off = p - met.centre;
    const double far = met.outline->radius + touch + least;
    if (squared_norm(off) < far * far)
      least = std::min(least, met.outline->distance_at(off) - touch);
  }
  if (nonconvex_.empty()) return least;
  const double error_rate = error == MotionError::none ? 0 : params_.gap_rate;
  const double moved = closing_ * std::min(params_.tuning.growth_time, start_.time - seen_);
  const double touch = start_.radius + moved + std::min(error_rate, closing_) * at.t;
  return std::min(least, nonconvex_.clearance(p, touch + limit) - touch);
}

bool ReachableObstacles::is_clear(Vec2 p, const SampleTime& at) const {
  return !(gap(p, at, at.required + asked_beyond, MotionError::bounded) < at.required);
}

bool ReachableObstacles::passes_walls(const Segment& segment) const {
  return walls_from_ >= end() || world_->map().is_free(segment, wall_keep_ + keep_rounding);
}

bool ReachableObstacles::meets_walls(const Segment& segment, double slack) const {
  const double keep = wall_keep_ - slack - keep_rounding;
  return walls_from_ < end() && keep > 0 && !world_->map().is_free(segment, keep);
}

}  // namespace microswarm::navigation

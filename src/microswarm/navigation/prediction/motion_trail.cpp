// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/motion_trail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace microswarm::navigation {
namespace {

constexpr double min_squared_speed = 1;  // [µm²/s²] slower points cannot be divided by

TrailPoint moved(const TrailPoint& p, double t) {
  TrailPoint out = p;
  out.t = t;
  out.position += (t - p.t) * p.velocity;
  return out;
}

}  // namespace

void MotionTrail::add(const TrailPoint& point, double memory) {
  if (points_.size() == max_points)  // rare, and many at once
    points_.erase(points_.begin(), points_.begin() + max_points / 4);
  const auto kept = std::find_if(points_.begin(), points_.end(),
                                 [&](const TrailPoint& p) { return p.t >= point.t - memory; });
  if (static_cast<std::size_t>(kept - points_.begin()) > points_.size() / 4)
    points_.erase(points_.begin(), kept);
  points_.push_back(point);
}

TrailPoint MotionTrail::at(double t) const {
  const auto after = std::lower_bound(points_.begin(), points_.end(), t,
                                      [](const TrailPoint& p, double time) { return p.t < time; });
  if (after == points_.begin()) return moved(points_.front(), t);
  if (after == points_.end()) return moved(points_.back(), t);
  const TrailPoint& a = *(after - 1);
  const TrailPoint& b = *after;
  const double dt = b.t - a.t;
  const double f = (t - a.t) / dt;
  const double g = 1 - f;
  // Cubic Hermite interpolation.
  const Vec2 position = (g * g * (1 + 2 * f)) * a.position + (f * f * (1 + 2 * g)) * b.position +
                        (f * g * dt) * (g * a.velocity - f * b.velocity);
  return {t, position, g * a.velocity + f * b.velocity, g * a.radius + f * b.radius,
          g * a.turn + f * b.turn};
}

std::optional<Recurrence> MotionTrail::recurrence(double noise,
                                                  const RecurrenceTuning& tuning) const {
  if (points_.empty()) return std::nullopt;
  const TrailPoint now = points_.back();
  const double speed = norm(now.velocity);
  if (speed < tuning.min_speed) return std::nullopt;
  const double near =
      tuning.max_time_offset * speed + tuning.max_place_offset + tuning.place_noise_gain * noise;
  const double max_place_off = tuning.max_place_offset + tuning.place_noise_gain * noise;
  const double max_velocity_off =
      tuning.max_velocity_offset * speed + tuning.velocity_noise_gain * noise;
  std::optional<Recurrence> best;
  double min_off = std::numeric_limits<double>::infinity();
  for (std::size_t i = points_.size(); i-- > 0;) {
    const TrailPoint& p = points_[i];
    if (p.t > now.t - tuning.min_age) continue;
    const Vec2 off = now.position - p.position;
    const double speed2 = squared_norm(p.velocity);
    if (squared_norm(off) > near * near || speed2 < min_squared_speed) continue;
    const double shift = dot(off, p.velocity) / speed2;
    if (std::abs(shift) > tuning.max_time_offset || p.t + shift < points_.front().t) continue;
    const TrailPoint was = at(p.t + shift);
    const double position = distance(was.position, now.position);
    if (position > max_place_off) continue;
    for (const bool reversed : {false, true}) {
      if (reversed && was.t < points_.front().t + tuning.min_reversed_time) continue;
      const double velocity =
          norm(reversed ? was.velocity + now.velocity : was.velocity - now.velocity);
      const double sum = position + tuning.velocity_weight * velocity;
      if (velocity > max_velocity_off || sum > min_off - tuning.min_improvement) continue;
      min_off = sum;
      best = Recurrence{was.t, reversed};
    }
  }
  return best;
}

TrailPoint MotionTrail::after(const Recurrence& recurrence, double s) const {
  if (recurrence.reversed) return at(recurrence.t - s);
  const double period = points_.back().t - recurrence.t;
  return at(recurrence.t + std::fmod(s, period));
}

}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/motion_models.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {
namespace {

constexpr double unturned = 1e-6;    // smaller turns are rounding [rad]
constexpr double time_slack = 1e-6;  // rounding of times [s]

/// Whether the model passes within `off` of the newest sightings, as many as `frames`.
template <class At>
bool explains(At&& at, std::span<const Sighting> seen, int frames, double off) {
  const Sighting& last = seen.back();
  const auto tail = seen.last(std::min(static_cast<std::size_t>(frames), seen.size()));
  return std::all_of(tail.begin(), tail.end(), [&](const Sighting& s) {
    return distance(at(s.t - last.t), s.position) < off;
  });
}

/// Least-squares circle through the sightings (Kåsa); nothing if they are on a line, farther than
/// `off` from it, or it is larger than `max_radius`.
std::optional<Disc> circle_through(std::span<const Sighting> seen, double off, double max_radius) {
  const Vec2 origin = seen.back().position;
  Vec2 sum, cube;
  double xx = 0, xy = 0, yy = 0;
  for (const Sighting& s : seen) {
    const Vec2 p = s.position - origin;
    sum += p;
    cube += squared_norm(p) * p;
    xx += p.x * p.x;
    xy += p.x * p.y;
    yy += p.y * p.y;
  }
  const auto n = static_cast<double>(seen.size());
  const Vec2 mean = sum / n;
  const double square = (xx + yy) / n;
  const double a = xx / n - mean.x * mean.x;
  const double b = xy / n - mean.x * mean.y;
  const double c = yy / n - mean.y * mean.y;
  const Vec2 right = 0.5 * (cube / n - square * mean);
  const double determinant = a * c - b * b;
  if (!(determinant > 1e-9 * (a + c) * (a + c))) return std::nullopt;
  const Vec2 centre =
      origin + Vec2{c * right.x - b * right.y, a * right.y - b * right.x} / determinant;
  double radius = 0;
  for (const Sighting& s : seen) radius += distance(s.position, centre) / n;
  if (radius > max_radius) return std::nullopt;
  const bool fits = std::all_of(seen.begin(), seen.end(), [&](const Sighting& s) {
    return std::abs(distance(s.position, centre) - radius) <= off;
  });
  return fits ? std::optional(Disc{centre, radius}) : std::nullopt;
}

std::span<const Sighting> newer_than(std::span<const Sighting> seen, double age) {
  const double oldest = seen.back().t - age - time_slack;
  const auto from =
      std::find_if(seen.begin(), seen.end(), [&](const Sighting& s) { return s.t >= oldest; });
  return {from, seen.end()};
}

}  // namespace

MotionModels::MotionModels(const MotionModelsTuning& tuning, const RecurrenceTuning& recurrence)
    : tuning_(tuning), recurrence_(recurrence) {
  along_.reserve(MotionTrail::max_points);
}

void MotionModels::fit(const MotionTrail& trail, const TrackedBody& motion,
                       std::span<const Sighting> seen, OscillationFit& fit) {
  motion_ = motion;
  holds_ = {};
  holds_[straight] = true;
  holds_[curved] = motion.frames >= tuning_.min_curved_frames;
  const auto& points = trail.points();
  turn_rate_ = 0;
  if (points.size() > 1) {
    const TrailPoint& before = points[points.size() - 2];
    turn_rate_ = (trail.back().turn - before.turn) / (trail.back().t - before.t);
  }
  turns_ = std::any_of(points.begin(), points.end(), [&](const TrailPoint& p) {
    return p.t > trail.back().t - fit.windows().back() &&
           std::abs(p.turn - trail.back().turn) > unturned;
  });
  if (const auto found = trail.recurrence(motion.noise, recurrence_)) {
    again_ = *found;
    holds_[again] = true;
  }
  if (seen.empty()) return;
  fit_swings(seen, motion.noise, fit);
  fit_arcs(seen, motion.noise, fit);
}

void MotionModels::fit_swings(std::span<const Sighting> seen, double noise, OscillationFit& fit) {
  const auto fits = fit.fit(seen);
  for (std::size_t k = 0; k < windows; ++k) {
    if (!fits[k]) continue;
    swings_[k] = *fits[k];
    holds_[swing + k] = explains([&](double t) { return swings_[k].at(t); }, seen,
                                 tuning_.explained_frames, tolerance(noise));
  }
}

void MotionModels::fit_arcs(std::span<const Sighting> seen, double noise, OscillationFit& fit) {
  for (std::size_t k = 0; k < windows; ++k) {
    const auto part = newer_than(seen, fit.windows()[k]);
    if (k > 0 && part.size() == newer_than(seen, fit.windows()[k - 1]).size()) return;
    const auto circle = circle_through(part, tuning_.circle_offset + 2 * tolerance(noise),
                                       tuning_.max_circle_radius);
    if (!circle) continue;
    along_.resize(part.size());
    double angle = heading_along(part.back().position - circle->centre);
    for (std::size_t i = part.size(); i-- > 0;) {
      angle += wrap(heading_along(part[i].position - circle->centre) - angle);
      along_[i] = {part[i].t, {circle->radius * angle, 0}};
    }
    const auto fits = fit.fit(along_);
    if (!fits[k]) continue;
    arcs_[k] = {circle->centre, circle->radius, *fits[k]};
    holds_[arc + k] = explains([&](double t) { return arcs_[k].at(t); }, seen,
                               tuning_.explained_frames, tolerance(noise));
  }
}

std::optional<std::size_t> MotionModels::longest_swing() const {
  for (std::size_t k = windows; k-- > 0;)
    if (holds_[swing + k]) return swing + k;
  return std::nullopt;
}

Vec2 MotionModels::position(std::size_t model, const MotionTrail& trail, double s) const {
  if (model == again) return trail.after(again_, s).position;
  if (model >= arc) return arcs_[model - arc].at(s);
  if (model >= swing) return swings_[model - swing].at(s);
  const Vec2 ahead = motion_.centre_after(s);
  if (model == straight) return ahead;
  const double bent = std::min(s, tuning_.acceleration_time);
  return ahead + (bent * (s - 0.5 * bent)) * motion_.acceleration;
}

double MotionModels::turn(std::size_t model, const MotionTrail& trail, double s) const {
  if (!turns_) return 0;
  if (model == again) {
    return trail.after(again_, s).turn - trail.after(again_, 0).turn;
  }
  // A body that oscillates on a circle and rotates is assumed to be fixed to the radius.
  if (model >= arc && model < again)
    return arcs_[model - arc].angle(s) - arcs_[model - arc].angle(0);
  return std::min(s, tuning_.turning_time) * turn_rate_;
}

}  // namespace microswarm::navigation

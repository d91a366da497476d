// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/guard.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "microswarm/core/angles.hpp"
#include "microswarm/core/infinity.hpp"

namespace microswarm {
namespace {

constexpr double regain = 5;                 // of a gap that is too small [µm/s]
constexpr double gap_that_counts = 30;       // of two ways, more is no better [µm]
constexpr double same_gap = 0.5;             // [µm]
constexpr double contact_gap = 1;            // [µm]
constexpr double contact_rate = 1;           // it grows so fast [µm/s]
constexpr double widening_time = 1;          // for which an outline goes on as seen [s]
constexpr double dead_time = 0.5;            // at most, from a frame to the effect of a command [s]
constexpr double clearance_rounding = 1e-6;  // [µm]
constexpr std::array<double, 2> waits{0.5, 1};
constexpr std::array<double, 3> runs{0.5, 1, 2};
constexpr std::array<double, 2> turns{0.4, 1};
constexpr double time_to_change = 0.25;  // that another way must be free for longer [s]
constexpr double gap_to_change = 5;      // or by which its gaps must be greater [µm]

}  // namespace

Vec2 Guard::Way::at(double t) const {
  return std::min(t, until) * first + std::max(0.0, t - until) * second;
}

bool Guard::Outcome::is_better_than(const Outcome& other) const {
  return until_contact != other.until_contact ? until_contact > other.until_contact
                                              : worth() > other.worth() + same_gap;
}

Guard::Guard(const GuardParams& params, double speed)
    : params_(params),
      speed_(speed),
      samples_(static_cast<int>(std::ceil(params.horizon / params.step))),
      tracker_(params.tracker),
      velocities_(1) {
  for (int k = 0; k < params.directions; ++k)
    velocities_.push_back(speed * unit_vector(wrap(2 * pi * k / params.directions)));
}

void Guard::see(const Observation& observation) {
  // What is farther cannot come near within the horizon unless it is much faster than the swarm.
  const double range = 3 * speed_ * (params_.horizon + dead_time);
  tracker_.see(observation, range + (observation.swarm ? observation.swarm->radius : 0));
  world_ = observation.world;
  if (met_.size() < tracker_.size()) met_.resize(tracker_.size());
}

std::optional<Command> Guard::overrules(const Command& wanted, const Start& start, const Map& map,
                                        double tick) {
  start_ = start;
  look_at_bodies(start);
  if (bodies_ == 0 && hollow_.empty()) return std::nullopt;
  wall_keep_ = std::clamp(map.clearance(start.place) - clearance_rounding, 0.0,
                          start.radius + params_.wall_margin);
  if (leaves_a_way(map, wanted, tick)) {
    begun_.reset();
    return std::nullopt;
  }
  return best_way(map);
}

void Guard::look_at_bodies(const Start& start) {
  bodies_ = 0;
  hollow_bodies_.clear();
  closing_ = 0;
  const auto bodies = world_->moving().bodies();
  const double ahead = start.time - tracker_.seen();
  for (std::size_t i = 0; i < bodies.size() && i < tracker_.size(); ++i) {
    const Disc extent = extent_of(bodies[i]);
    const double far = distance(extent.centre, start.place) - extent.radius - start.radius;
    if (far > 3 * speed_ * (params_.horizon + dead_time)) continue;
    const TrackedBody motion = tracker_.body(i);
    const double widening = outward_speed(bodies[i], motion);
    const double closing = speed_ + norm(motion.velocity) + params_.margin_rate;
    if (far > params_.margin + closing * (params_.horizon + ahead) + widening * widening_time)
      continue;
    Met& met = met_[bodies_];
    outliner_.take(bodies[i], met.outline);
    if (outliner_.misleads(met.outline, std::array{start.place})) {
      hollow_bodies_.push_back(bodies[i]);
      closing_ = std::max(closing_, widening + norm(motion.velocity));
      continue;
    }
    met.velocity = motion.velocity;
    met.widening = widening;
    met.speed = widening + norm(motion.velocity);
    met.outline.centre = motion.centre_after(ahead);
    ++bodies_;
  }
  hollow_.assign(hollow_bodies_);
  gap_now_ = gap(start.place, 0, params_.margin, 0);
}

/// From the swarm at p to whatever is nearest, t seconds after the start, at most `limit` [µm].
/// What moves is taken for wider by `error_rate` [µm/s], as far as it moves so fast.
double Guard::gap(Vec2 p, double t, double limit, double error_rate) const {
  double least = limit;
  const double widened = std::min(widening_time, start_.time - tracker_.seen() + t);
  for (std::size_t k = 0; k < bodies_; ++k) {
    const Met& met = met_[k];
    const double error = std::min(error_rate, met.speed) * t;
    const double touch = start_.radius + met.widening * widened + error;
    const Vec2 off = p - (met.outline.centre + t * met.velocity);
    const double far = met.outline.radius + touch + least;
    if (squared_norm(off) < far * far)
      least = std::min(least, met.outline.distance_at(off) - touch);
  }
  if (hollow_.empty()) return least;
  const double touch = start_.radius + closing_ * widened + std::min(error_rate, closing_) * t;
  return std::min(least, hollow_.clearance(p, touch + limit) - touch);
}

/// At every step, and where it turns, till `visit(time, place)` has had enough and says no.
template <class Visit>
bool Guard::follow(const Way& way, Visit&& visit) const {
  for (int s = 1; s <= samples_; ++s) {
    const double t = s * params_.step;
    if (t - params_.step < way.until && way.until < t)
      if (!visit(way.until, start_.place + way.at(way.until))) return false;
    if (!visit(t, start_.place + way.at(t))) return false;
  }
  return true;
}

bool Guard::is_free(const Map& map, const Way& way) const {
  return follow(way, [&, last = start_.place](double t, Vec2 p) mutable {
    const double margin = std::min(params_.margin, gap_now_ + regain * t);
    if (gap(p, t, margin + 1, params_.margin_rate) < margin) return false;
    const Vec2 from = std::exchange(last, p);
    return p == from || map.is_free(Segment{from, p}, wall_keep_);
  });
}

Guard::Outcome Guard::outcome(const Map& map, const Way& way, double least_time) const {
  Outcome out{.until_contact = 0, .least = gap_that_counts, .last = 0};
  bool touched = false;
  follow(way, [&, last = start_.place](double t, Vec2 p) mutable {
    const Vec2 from = std::exchange(last, p);
    if (p != from && !map.is_free(Segment{from, p}, wall_keep_)) return false;
    out.last = gap(p, t, gap_that_counts, 0);
    out.least = std::min(out.least, out.last);
    touched = touched || out.last < contact_gap + contact_rate * t;
    if (!touched) out.until_contact = t;
    return !touched || out.until_contact >= least_time;
  });
  return out;
}

bool Guard::leaves_a_way(const Map& map, const Command& wanted, double tick) {
  const Vec2 begin = wanted.speed * unit_vector(wanted.heading);
  if (is_free(map, {begin, tick, velocities_[last_]})) return true;
  for (std::size_t k = 0; k < velocities_.size(); ++k) {
    if (!is_free(map, {begin, tick, velocities_[k]})) continue;
    last_ = k;
    return true;
  }
  return false;
}

Command Guard::best_way(const Map& map) {
  Outcome best{-1, -infinity, 0};
  Way chosen;
  const auto consider = [&](const Way& way) {
    const Outcome o = outcome(map, way, best.until_contact);
    if (!o.is_better_than(best)) return;
    best = o;
    chosen = way;
  };
  if (begun_) {
    const double until = begun_->way.until - (start_.time - begun_->time);
    consider({begun_->way.first, std::max(until, 0.0), begun_->way.second});
    best.until_contact = std::min(best.until_contact + time_to_change, samples_ * params_.step);
    best.least += gap_to_change;
    best.last += gap_to_change;
  }
  for (const Vec2 v : velocities_) consider({{}, 0, v});
  for (const Vec2 v : velocities_) {
    for (const double t : waits) consider({{}, t, v});
    for (const double t : runs) consider({v, t, {}});
  }
  for (std::size_t i = 1; i < velocities_.size(); i += 2)
    for (std::size_t j = 1; j < velocities_.size(); j += 2)
      if (i != j)
        for (const double t : turns) consider({velocities_[i], t, velocities_[j]});
  begun_ = Begun{chosen, start_.time};
  const Vec2 begin = chosen.until > 0 ? chosen.first : chosen.second;
  const double speed = norm(begin);
  return {speed > 0 ? heading_of(begin) : 0, speed};
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/safety_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"

namespace microswarm {
namespace {

constexpr double clearance_rounding = 1e-6;  // [µm]
constexpr double tie = 1e-6;

Vec2 velocity_of(const Command& command) { return command.speed * unit_vector(command.heading); }

}  // namespace

Vec2 SafetyFilter::Way::at(double t) const {
  return std::min(t, until) * first + std::max(0.0, t - until) * second;
}

bool SafetyFilter::Outcome::is_better_than(const Outcome& other, double tolerance) const {
  return until_contact != other.until_contact ? until_contact > other.until_contact
                                              : worth() > other.worth() + tolerance;
}

SafetyFilter::SafetyFilter(const SafetyFilterParams& params, double speed)
    : params_(params),
      speed_(speed),
      samples_(static_cast<int>(std::ceil(params.horizon / params.step))),
      tracker_(params.tracker),
      velocities_(1),
      outliner_(params.tuning.outline) {
  for (int k = 0; k < params.directions; ++k)
    velocities_.push_back(speed * unit_vector(wrap(2 * pi * k / params.directions)));
  choices_.reserve(static_cast<std::size_t>(params_.tuning.refinement * params.directions) + 1);
}

void SafetyFilter::update(const Observation& observation) {
  // What is farther cannot come near within the horizon unless it is much faster than the swarm.
  const double range = 3 * speed_ * (params_.horizon + params_.tuning.max_dead_time);
  tracker_.update(observation, range + (observation.swarm ? observation.swarm->radius : 0));
  if (threats_.size() < tracker_.size()) threats_.resize(tracker_.size());
}

std::optional<Command> SafetyFilter::filter(const Command& wanted, const Start& start,
                                            const Snapshot& world, double tick) {
  const Map& map = world.map();
  start_ = start;
  look_at_bodies(start, world);
  std::optional<Command> instead;
  if (bodies_ > 0 || !nonconvex_.empty()) {
    wall_keep_ = std::clamp(map.clearance(start.place) - clearance_rounding, 0.0,
                            start.radius + params_.wall_gap);
    instead = checked(wanted, map, std::max(tick, params_.commitment));
  }
  if (!instead) waited_ = 0;
  if (instead && instead->speed == 0) waited_ += tick;
  const Command& driven = instead ? *instead : wanted;
  if (driven.speed > 0) course_ = driven.heading;
  return instead;
}

std::optional<Command> SafetyFilter::checked(const Command& wanted, const Map& map,
                                             double lasting) {
  std::optional<Command> instead;
  if (!has_escapes(map, velocity_of(wanted), lasting, 1)) {
    instead = nearest_safe(map, wanted, lasting);
    if (!instead) return best_manoeuvre(map);
  }
  committed_.reset();
  return instead;
}

// To hold counts as turning across, as it gets no nearer, and as more the longer it lasts: before
// what stands it would last for ever.
std::optional<Command> SafetyFilter::nearest_safe(const Map& map, const Command& wanted,
                                                  double lasting) {
  const double course = course_.value_or(wanted.heading);
  choices_.assign(1, {0.5 * pi + params_.tuning.impatience * waited_, {wanted.heading, 0}});
  const int count = params_.tuning.refinement * params_.directions;
  for (int k = 0; k < count; ++k) {
    const double heading = wrap(wanted.heading + 2 * pi * k / count);
    // Between the two all turn the same: then what is nearer to the wanted one comes first.
    const double turn =
        (1 + tie) * turn_between(heading, wanted.heading) + turn_between(heading, course);
    choices_.push_back({turn, {heading, speed_}});
  }
  std::sort(choices_.begin(), choices_.end());
  for (const Choice& choice : choices_)
    if (has_escapes(map, velocity_of(choice.command), lasting, params_.tuning.min_escapes))
      return choice.command;
  return std::nullopt;
}

void SafetyFilter::look_at_bodies(const Start& start, const Snapshot& world) {
  bodies_ = 0;
  nonconvex_bodies_.clear();
  closing_ = 0;
  const auto bodies = world.moving().bodies();
  const double ahead = start.time - tracker_.seen();
  for (std::size_t i = 0; i < bodies.size() && i < tracker_.size(); ++i) {
    const Disc extent = extent_of(bodies[i]);
    const double far = distance(extent.centre, start.place) - extent.radius - start.radius;
    if (far > 3 * speed_ * (params_.horizon + params_.tuning.max_dead_time)) continue;
    const TrackedBody motion = tracker_.body(i);
    const double widening = outward_speed(bodies[i], motion);
    const double closing = speed_ + norm(motion.velocity) + params_.gap_rate;
    if (far >
        params_.gap + closing * (params_.horizon + ahead) + widening * params_.tuning.growth_time)
      continue;
    Threat& met = threats_[bodies_];
    outliner_.take(bodies[i], met.outline);
    if (outliner_.misleads(met.outline, std::array{start.place})) {
      nonconvex_bodies_.push_back(bodies[i]);
      const Disc reach{start.place, start.radius + speed_ * (params_.tuning.max_dead_time +
                                                             params_.tuning.growth_time)};
      closing_ = std::max(
          closing_, tracker_.outline_speed_within(i, bodies[i], reach) + norm(motion.velocity));
      continue;
    }
    met.velocity = motion.velocity;
    met.widening = widening;
    met.speed = widening + norm(motion.velocity);
    met.outline.centre = motion.centre_after(ahead);
    ++bodies_;
  }
  nonconvex_.assign(nonconvex_bodies_);
  gap_now_ = gap(start.place, 0, params_.gap, 0);
}

/// From the swarm at p to whatever is nearest, t seconds after the start, at most `limit` [µm].
/// What moves is taken for wider by `error_rate` [µm/s], as far as it moves so fast.
double SafetyFilter::gap(Vec2 p, double t, double limit, double error_rate) const {
  double least = limit;
  const double widened = std::min(params_.tuning.growth_time, start_.time - tracker_.seen() + t);
  for (std::size_t k = 0; k < bodies_; ++k) {
    const Threat& met = threats_[k];
    const double error = std::min(error_rate, met.speed) * t;
    const double touch = start_.radius + met.widening * widened + error;
    const Vec2 off = p - (met.outline.centre + t * met.velocity);
    const double far = met.outline.radius + touch + least;
    if (squared_norm(off) < far * far)
      least = std::min(least, met.outline.distance_at(off) - touch);
  }
  if (nonconvex_.empty()) return least;
  const double moved =
      closing_ * std::min(params_.tuning.growth_time, start_.time - tracker_.seen());
  const double touch = start_.radius + moved + std::min(error_rate, closing_) * t;
  return std::min(least, nonconvex_.clearance(p, touch + limit) - touch);
}

/// At every step, and where it turns, till `visit(time, place)` has had enough and says no.
template <class Visit>
bool SafetyFilter::follow(const Way& way, Visit&& visit) const {
  for (int s = 1; s <= samples_; ++s) {
    const double t = s * params_.step;
    if (t - params_.step < way.until && way.until < t)
      if (!visit(way.until, start_.place + way.at(way.until))) return false;
    if (!visit(t, start_.place + way.at(t))) return false;
  }
  return true;
}

bool SafetyFilter::is_free(const Map& map, const Way& way) const {
  return follow(way, [&, last = start_.place](double t, Vec2 p) mutable {
    const double required = std::min(params_.gap, gap_now_ + params_.tuning.recovery_rate * t);
    if (gap(p, t, required + 1, params_.gap_rate) < required) return false;
    const Vec2 from = std::exchange(last, p);
    return p == from || map.is_free(Segment{from, p}, wall_keep_);
  });
}

SafetyFilter::Outcome SafetyFilter::outcome(const Map& map, const Way& way, double min_time) const {
  Outcome out{.until_contact = 0, .least = params_.tuning.counted_gap, .last = 0};
  bool touched = false;
  follow(way, [&, last = start_.place](double t, Vec2 p) mutable {
    const Vec2 from = std::exchange(last, p);
    if (p != from && !map.is_free(Segment{from, p}, wall_keep_)) return false;
    out.last = gap(p, t, params_.tuning.counted_gap, 0);
    out.least = std::min(out.least, out.last);
    touched =
        touched || out.last < params_.tuning.contact_gap + params_.tuning.contact_gap_rate * t;
    if (!touched) out.until_contact = t;
    return !touched || out.until_contact >= min_time;
  });
  return out;
}

bool SafetyFilter::has_escapes(const Map& map, Vec2 begin, double lasting, int count) {
  int found = is_free(map, {begin, lasting, velocities_[last_]}) ? 1 : 0;
  const std::size_t asked = last_;
  for (std::size_t k = 0; k < velocities_.size() && found < count; ++k) {
    if (k == asked || !is_free(map, {begin, lasting, velocities_[k]})) continue;
    last_ = k;
    ++found;
  }
  return found >= count;
}

Command SafetyFilter::best_manoeuvre(const Map& map) {
  Outcome best{-1, -infinity, 0};
  Way chosen;
  const auto consider = [&](const Way& way) {
    const Outcome o = outcome(map, way, best.until_contact);
    if (!o.is_better_than(best, params_.tuning.gap_tolerance)) return;
    best = o;
    chosen = way;
  };
  if (committed_) {
    const double until = committed_->way.until - (start_.time - committed_->time);
    consider({committed_->way.first, std::max(until, 0.0), committed_->way.second});
    best.until_contact =
        std::min(best.until_contact + params_.tuning.switch_time, samples_ * params_.step);
    best.least += params_.tuning.switch_gap;
    best.last += params_.tuning.switch_gap;
  }
  for (const Vec2 v : velocities_) consider({{}, 0, v});
  for (const Vec2 v : velocities_) {
    for (const double t : params_.tuning.hold_times) consider({{}, t, v});
    for (const double t : params_.tuning.run_times) consider({v, t, {}});
  }
  for (std::size_t i = 1; i < velocities_.size(); i += 2)
    for (std::size_t j = 1; j < velocities_.size(); j += 2)
      if (i != j)
        for (const double t : params_.tuning.turn_times)
          consider({velocities_[i], t, velocities_[j]});
  committed_ = Committed{chosen, start_.time};
  const Vec2 begin = chosen.until > 0 ? chosen.first : chosen.second;
  const double speed = norm(begin);
  return {speed > 0 ? heading_of(begin) : 0, speed};
}

}  // namespace microswarm

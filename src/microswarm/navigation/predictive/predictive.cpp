// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/predictive/predictive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm {
namespace {

constexpr double leg_rounding = 1e-9;

/// Minimum distance from the outline to a point that moves straight from a to b, both relative to
/// the outline's centre and rotated back with it. The distance is convex along the segment.
double distance_to(const ConvexOutline& outline, Vec2 a, Vec2 b, double near) {
  const double bound = std::min(norm(a), norm(b)) - 0.5 * distance(a, b) - outline.radius;
  if (outline.edges.empty() || bound > near)
    return distance(Vec2{}, Segment{a, b}) - outline.radius;
  constexpr int halvings = 12;
  double first = 0;
  double last = 1;
  const auto at = [&](double share) { return outline.distance_at(a + share * (b - a)); };
  for (int k = 0; k < halvings; ++k) {
    const double left = first + (last - first) / 3;
    const double right = last - (last - first) / 3;
    (at(left) <= at(right) ? last : first) = at(left) <= at(right) ? right : left;
  }
  return std::min({at(0), at(1), at(0.5 * (first + last))});
}

/// An issue if the value of the first key is not less than that of the second.
void require_less(double a, double b, std::string_view first, std::string_view second,
                  Issues& issues) {
  constexpr std::string_view group = "prediction.tuning";
  if (a < b) return;
  issues.add(fmt::format("{}.{}", group, first),
             fmt::format("{0}.{1} must be less than {0}.{2}", group, first, second));
}

}  // namespace

Issues validate(const PredictiveParams& params) {
  Issues issues;
  if (params.tuning.speed_shares.empty())
    issues.add("tuning.speed_shares", "tuning.speed_shares is empty, must have a value");
  const OscillationTuning& o = params.prediction.tuning.oscillation;
  require_less(o.short_window, o.medium_window, "oscillation.short_window_s",
               "oscillation.medium_window_s", issues);
  require_less(o.medium_window, o.long_window, "oscillation.medium_window_s",
               "oscillation.long_window_s", issues);
  require_less(o.min_frequency, o.max_frequency, "oscillation.min_frequency_per_s",
               "oscillation.max_frequency_per_s", issues);
  // A recurrence must lie in the past.
  const RecurrenceTuning& r = params.prediction.tuning.recurrence;
  require_less(r.max_time_offset, r.min_age, "recurrence.max_time_offset_s", "recurrence.min_age_s",
               issues);
  return issues;
}

PredictiveNavigator::PredictiveNavigator(const PredictiveParams& params, const Task& task, Rng)
    : SteeringNavigator(task, params.speed),
      params_(params),
      reached_{goal(), params_.tuning.goal_share * goal_tolerance()},
      radius_(swarm().radius + params.gap),
      predictor_(params.prediction),
      field_(speed(), params.horizon, params.step),
      outliner_(params.tuning.outline) {
  path_.reserve(static_cast<std::size_t>(field_.steps()) + 1);
}

void PredictiveNavigator::prepare(const Snapshot& world, const Stop&) {
  choose_aim(world, swarm().radius, swarm().radius + params_.wall_gap);
  const double left = aim().tolerance;
  reached_ = {aim().position, params_.tuning.goal_share * left};
  ends_within_ = goal_tolerance() - (1 - params_.tuning.goal_share) * left;
  if (params_.guide == Guide::route)
    route_ = DistanceField::to_goal(
        world.shared_map(), aim().position,
        wall_clearance(swarm().radius + params_.wall_gap, aim().position, 0), params_.route_cell);
}

Diagnostics PredictiveNavigator::diagnostics() const {
  if (path_.empty()) return {};
  PredictiveDiagnostics out{.effect = effect_, .radius = radius_};
  for (std::size_t k = 0; k < ahead_.size(); ++k) {
    const std::size_t sample = k / bodies_, i = k % bodies_;
    if (sample % 2 != 0) continue;  // one a step
    const PredictedBody& body = ahead_[k];
    out.bodies.push_back({.body = static_cast<std::uint32_t>(body_of_[i]),
                          .t = effect_ + field_.time_of(static_cast<int>(sample)),
                          .centre = body.centre,
                          .turn = body.turn,
                          .radius = outlines_[i].radius + body.growth,
                          .growth = body.growth,
                          .uncertainty = body.uncertainty});
  }
  for (std::size_t i = 0; i < bodies_; ++i)
    for (const ConvexOutline::Edge& edge : outlines_[i].edges)
      out.corners.push_back({static_cast<std::uint32_t>(body_of_[i]),
                             edge.offset * edge.normal + edge.begin * perpendicular(edge.normal)});
  return out;
}

void PredictiveNavigator::update(const Observation& seen, const Stop& stop) {
  route_.stop_with(stop);
  predictor_.update(seen);
  path_.clear();
}

Decision PredictiveNavigator::finish(const Decision& decision, const Observation&) {
  step_view().path = path_;
  return decision;
}

Decision PredictiveNavigator::decide(const Moment& moment) {
  const Observation& seen = moment.seen;
  const Pose2& pose = moment.pose;
  const Map& map = moment.map();
  radius_ = std::max(swarm().radius, seen.swarm->radius) + params_.gap;
  look_at_bodies(seen, pose.position);
  look_ahead(seen.seen + delay());
  in_sight_ = params_.guide == Guide::straight ||
              map.is_free(Segment{pose.position, aim().position}, swarm().radius);
  path_.push_back(pose.position);
  if (goal_is_clear(map, pose)) {
    step_view().local_target = aim().position;
    path_.push_back(aim().position);
    return {{heading_of(aim().position - pose.position), speed()}, NavigatorState::follow};
  }
  step_view().planned = true;
  solve(map, pose.position);
  const Leg leg = best_leg(map, pose);
  const Vec2 end =
      pose.position + field_.step() * leg.command.speed * unit_vector(leg.command.heading);
  step_view().local_target = end;
  const double gap = std::min(leg.min_gap, follow_field(end));
  const bool meets = gap < -params_.gap;
  if (leg.command.speed == 0) return hold(meets ? NavigatorState::escape : NavigatorState::hold);
  const bool alone = gap > 2 * params_.risk.reach;
  return {leg.command, meets   ? NavigatorState::escape
                       : alone ? NavigatorState::follow
                               : NavigatorState::avoid};
}

/// Collects the outlines of all bodies. A hollow body that hardly moves, such as a channel with
/// moving walls, is represented by its actual present outline.
void PredictiveNavigator::look_at_bodies(const Observation& seen, Vec2 from) {
  bodies_ = 0;
  body_of_.clear();
  nonconvex_bodies_.clear();
  closing_ = 0;
  const auto bodies = seen.world->moving().bodies();
  for (std::size_t i = 0; i < bodies.size() && i < predictor_.size(); ++i) {
    if (outlines_.size() == bodies_) outlines_.emplace_back();
    ConvexOutline& outline = outlines_[bodies_];
    outliner_.take(bodies[i], outline);
    if (stands_hollow(outline, predictor_.tracked(i), from)) {
      nonconvex_bodies_.push_back(bodies[i]);
      closing_ =
          std::max(closing_, params_.tuning.closing_time * predictor_.tracked(i).outline_speed);
      continue;
    }
    body_of_.push_back(i);
    ++bodies_;
  }
  nonconvex_.assign(nonconvex_bodies_);
}

bool PredictiveNavigator::stands_hollow(const ConvexOutline& outline, const TrackedBody& motion,
                                        Vec2 from) const {
  if (norm(motion.velocity) > params_.tuning.slow_share * speed()) return false;
  return outliner_.misleads(outline, std::array{from, aim().position});
}

/// Predicts the bodies from the time at which this step's command takes effect.
void PredictiveNavigator::look_ahead(double effect) {
  effect_ = effect;
  ahead_.clear();
  leg_ahead_.clear();
  for (int s = 0; s < 2 * field_.steps(); ++s)
    for (const std::size_t body : body_of_)
      ahead_.push_back(predictor_.at(body, effect + field_.time_of(s)));
  for (int s = 0; s <= leg_pieces; ++s)
    for (const std::size_t body : body_of_)
      leg_ahead_.push_back(predictor_.at(body, effect + field_.step() * s / leg_pieces));
}

/// Whether nothing is near the straight path to the goal within the horizon. Between samples, a
/// body may have approached by half the distance that both moved.
bool PredictiveNavigator::goal_is_clear(const Map& map, const Pose2& pose) const {
  const Vec2 offset = aim().position - pose.position;
  const double heading = heading_of(offset);
  constexpr double turned = 0.02;  // [rad]
  const bool turns = std::isfinite(swarm().max_turn_rate);
  if (!in_sight_ || (turns && turn_between(heading, pose.heading) > turned)) return false;
  const double own_step = 0.5 * field_.step() * speed();
  for (int s = 0; s < 2 * field_.steps(); ++s) {
    const double gone = std::min(norm(offset), field_.time_of(s) * speed());
    const Vec2 p = pose.position + gone * unit_vector(heading);
    if (standing_risk(map, p) > 0) return false;
    const std::size_t first = static_cast<std::size_t>(s) * bodies_;
    for (std::size_t i = 0; i < bodies_; ++i) {
      const PredictedBody& body = ahead_[first + i];
      const double step = s > 0 ? distance(body.centre, ahead_[first + i - bodies_].centre) : 0;
      const double gap =
          outlines_[i].distance_at(rotated(p - body.centre, -body.turn)) - body.growth - radius_;
      if (gap < params_.risk.reach + body.uncertainty + 0.5 * (own_step + step)) return false;
    }
    if (gone == norm(offset)) break;
  }
  return true;
}

void PredictiveNavigator::solve(const Map& map, Vec2 from) {
  field_.begin(
      from, reached_, [&](Vec2 p) { return standing_risk(map, p); },
      [&](Vec2 p) { return static_cast<float>(left_from(p)); });
  field_.solve(std::span(outlines_).first(bodies_), ahead_, radius_, params_.risk);
}

/// Time to the goal without obstacles [s].
double PredictiveNavigator::left_from(Vec2 p) {
  const double straight = distance(p, aim().position) - reached_.radius;
  if (in_sight_) return std::max(0.0, straight) / speed();
  const double length = route_.from(p);
  return std::isfinite(length) ? length / speed() : params_.tuning.unreachable_time;
}

float PredictiveNavigator::standing_risk(const Map& map, Vec2 p) const {
  const double radius = radius_ - params_.gap;
  double clearance = map.field().lower(p) + 0.5 * map.field().spread();
  if (!nonconvex_.empty()) {
    const double limit = radius + params_.wall_gap + params_.tuning.wall_reach + closing_;
    clearance = std::min(clearance, nonconvex_.clearance(p, limit) - closing_);
  }
  const double gap = clearance - radius - params_.wall_gap;
  if (gap >= params_.tuning.wall_reach) return 0;
  if (gap < -params_.wall_gap) return static_cast<float>(params_.tuning.wall_contact_cost);
  const double share = std::min(1.0, 1 - gap / params_.tuning.wall_reach);
  return static_cast<float>(params_.tuning.wall_proximity_cost * share * share);
}

PredictiveNavigator::Leg PredictiveNavigator::best_leg(const Map& map, const Pose2& pose) {
  const bool turns_slowly = std::isfinite(swarm().max_turn_rate);
  ending_ = false;
  wanted_ = turns_slowly ? best_heading(pose.position) : std::nullopt;
  Leg best = tried(map, pose, {pose.heading, 0}, std::numeric_limits<double>::infinity());
  const bool alone = std::isinf(best.min_gap);
  ending_ =
      alone && in_sight_ && distance(pose.position, aim().position) < 2 * field_.step() * speed();
  // With nothing moving, waiting is useless: a swarm with limited turn rate does not turn at rest,
  // and the final approach is finer than the field's cells.
  if (alone && (turns_slowly || ending_)) best.cost = std::numeric_limits<double>::infinity();
  const double straight = heading_of(aim().position - pose.position);
  const std::span shares(params_.tuning.speed_shares);
  for (const double share :
       turns_slowly ? shares : shares.first(std::min<std::size_t>(2, shares.size())))
    for (int k = 0; k < params_.directions; ++k) {
      const Command command{wrap(straight + 2 * pi * k / params_.directions), share * speed()};
      const Leg leg = tried(map, pose, command, best.cost);
      if (leg.cost < best.cost - leg_rounding) best = leg;
    }
  return best;
}

/// Cost of a first leg plus the best continuation; more than `bound` if it is no better.
PredictiveNavigator::Leg PredictiveNavigator::tried(const Map& map, const Pose2& from,
                                                    const Command& command, double bound) {
  const double dt = field_.step() / leg_pieces;
  const double needed = std::min(
      wall_clearance(swarm().radius + params_.wall_gap, from.position, field_.step() * speed()),
      (1 - leg_rounding) * map.clearance(from.position));
  Leg leg{command, field_.cost(1, from.position), std::numeric_limits<double>::infinity()};
  leg.cost = 0;
  Pose2 pose = from;
  for (int piece = 0; piece < leg_pieces; ++piece) {
    const Pose2 next = unicycle_step(pose, command, swarm().max_turn_rate, dt);
    const Segment move{pose.position, next.position};
    const Meeting met = meeting(piece, move);
    leg.min_gap = std::min(leg.min_gap, met.gap);
    const double risk = std::max(met.risk, static_cast<double>(standing_risk(map, next.position)));
    leg.cost += dt * (1 + risk);
    if (command.speed > 0 && !map.is_free(move, needed))
      leg.cost = params_.tuning.unreachable_time + bound;
    if (leg.cost > bound) return leg;
    pose = next;
    if (ending_ ? distance(goal(), move) < ends_within_
                : distance(pose.position, reached_.centre) < reached_.radius)
      return leg;
  }
  leg.cost += ending_ ? left_from(pose.position) : field_.cost(1, pose.position);
  leg.cost += turning_time(pose);
  return leg;
}

/// Heading of the field's path from `p`, over enough steps to smooth the grid; nothing if it waits.
std::optional<double> PredictiveNavigator::best_heading(Vec2 p) const {
  constexpr int steps_ahead = 3;
  const Vec2 from = p;
  for (int k = 1; k < std::min(steps_ahead + 1, field_.steps()); ++k) p = field_.next(k, p);
  if (p == from) return std::nullopt;
  return heading_of(p - from);
}

/// Time lost to turning into the best continuation, which the field ignores [s]. While the swarm
/// turns by an angle at its full rate, it advances only by the sine of that angle.
double PredictiveNavigator::turning_time(const Pose2& pose) const {
  if (!wanted_) return 0;
  const double wanted = ending_ ? heading_of(aim().position - pose.position) : *wanted_;
  const double turn = turn_between(wanted, pose.heading);
  return (turn - maths::sin(turn)) / swarm().max_turn_rate;
}

/// Gap and risk of the bodies along a segment of the first leg.
PredictiveNavigator::Meeting PredictiveNavigator::meeting(int piece, Segment move) const {
  Meeting out;
  const std::size_t first = static_cast<std::size_t>(piece) * bodies_;
  for (std::size_t i = 0; i < bodies_; ++i) {
    const PredictedBody& a = leg_ahead_[first + i];
    const PredictedBody& b = leg_ahead_[first + bodies_ + i];
    const double grown = radius_ + std::max(a.growth, b.growth);
    const double near = grown + params_.risk.reach + b.uncertainty;
    const Vec2 p = move.a - a.centre;
    const Vec2 q = move.b - b.centre;
    const double away = outlines_[i].radius + near + distance(p, q);
    if (squared_norm(p) > away * away) continue;
    const double gap =
        distance_to(outlines_[i], rotated(p, -a.turn), rotated(q, -b.turn), near) - grown;
    const auto risk =
        risk_of(params_.risk, static_cast<float>(gap), static_cast<float>(b.uncertainty));
    out.gap = std::min(out.gap, gap);
    out.risk = std::max(out.risk, static_cast<double>(risk));
  }
  return out;
}

/// Computes the field's best path and returns the minimum gap to a body on it [µm], evaluated at
/// the start of each step.
double PredictiveNavigator::follow_field(Vec2 from) {
  double least = std::numeric_limits<double>::infinity();
  Vec2 p = from;
  path_.push_back(p);
  for (int k = 1; k < field_.steps(); ++k) {
    const std::size_t first = static_cast<std::size_t>(2 * k) * bodies_;
    for (std::size_t i = 0; i < bodies_; ++i) {
      const PredictedBody& body = ahead_[first + i];
      const Vec2 off = rotated(p - body.centre, -body.turn);
      least = std::min(least, outlines_[i].distance_at(off) - body.growth - radius_);
    }
    if (arrives(p)) break;
    p = field_.next(k, p);
    path_.push_back(p);
  }
  return least;
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/predictive/predictive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/navigation/prediction/validate_prediction.hpp"

namespace microswarm::navigation {
namespace {

constexpr double leg_rounding = 1e-9;

}  // namespace

Issues validate(const PredictiveParams& params) {
  Issues issues;
  if (params.tuning.speed_shares.empty())
    issues.add("tuning.speed_shares", "tuning.speed_shares is empty, must have a value");
  issues.add(validate_prediction(params.prediction));
  return issues;
}

PredictiveNavigator::PredictiveNavigator(const PredictiveParams& params, const Task& task, Rng)
    : SteeringNavigator(task, params.speed),
      params_(params),
      reached_{goal(), params_.tuning.goal_share * goal_tolerance()},
      radius_(swarm().radius + params.gap),
      predictor_(params.prediction),
      field_(speed(), params.horizon, params.step),
      horizon_(params, params.tuning.slow_share * speed()) {
  path_.reserve(static_cast<std::size_t>(field_.steps()) + 1);
}

void PredictiveNavigator::prepare(const Snapshot& world, const Stop&) {
  choose_aim(world, swarm().radius, swarm().radius + params_.wall_gap);
  const double left = aim().tolerance;
  reached_ = {aim().position, params_.tuning.goal_share * left};
  ends_within_ = goal_tolerance() - (1 - params_.tuning.goal_share) * left;
  if (params_.guide == Guide::route)
    route_ = planning::DistanceField::to_goal(
        world.shared_map(), aim().position,
        wall_clearance(swarm().radius + params_.wall_gap, aim().position, 0), params_.route_cell);
}

Diagnostics PredictiveNavigator::diagnostics() const {
  return path_.empty() ? Diagnostics() : horizon_.diagnostics(field_, radius_);
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
  horizon_.update(moment.world(), predictor_, field_, seen.seen + delay(),
                  std::array{pose.position, aim().position});
  in_sight_ = params_.guide == Guide::straight ||
              map.is_free(Segment{pose.position, aim().position}, swarm().radius);
  path_.push_back(pose.position);
  if (goal_is_clear(map, pose)) {
    step_view().local_target = aim().position;
    path_.push_back(aim().position);
    return {{heading_along(aim().position - pose.position), speed()}, NavigatorState::follow};
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

/// Whether nothing is near the straight path to the goal within the horizon. Between samples, a
/// body may have approached by half the distance that both moved.
bool PredictiveNavigator::goal_is_clear(const Map& map, const Pose2& pose) const {
  const Vec2 offset = aim().position - pose.position;
  const double heading = heading_along(offset);
  constexpr double turned = 0.02;  // [rad]
  const bool turns = std::isfinite(swarm().max_turn_rate);
  if (!in_sight_ || (turns && turn_between(heading, pose.heading) > turned)) return false;
  const double own_step = 0.5 * field_.step() * speed();
  for (int s = 0; s < 2 * field_.steps(); ++s) {
    const double gone = std::min(norm(offset), field_.time_at(s) * speed());
    const Vec2 p = pose.position + gone * unit_vector(heading);
    if (standing_risk(map, p) > 0) return false;
    for (std::size_t i = 0; i < horizon_.size(); ++i) {
      const PredictedBody& body = horizon_.sample(s)[i];
      const double step = s > 0 ? distance(body.centre, horizon_.sample(s - 1)[i].centre) : 0;
      const double gap = horizon_.distance_to(i, body, p) - radius_;
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
  field_.solve(horizon_.outlines(), horizon_.samples(), radius_, params_.risk);
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
  const double limit = radius + params_.wall_gap + params_.tuning.wall_reach;
  clearance = std::min(clearance, horizon_.present_clearance(p, limit));
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
  const double straight = heading_along(aim().position - pose.position);
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
  const double dt = field_.step() / ObstacleHorizon::leg_pieces;
  const double needed = std::min(
      wall_clearance(swarm().radius + params_.wall_gap, from.position, field_.step() * speed()),
      (1 - leg_rounding) * map.clearance(from.position));
  Leg leg{command, field_.cost(1, from.position), std::numeric_limits<double>::infinity()};
  leg.cost = 0;
  Pose2 pose = from;
  for (int piece = 0; piece < ObstacleHorizon::leg_pieces; ++piece) {
    const Pose2 next = unicycle_step(pose, command, swarm().max_turn_rate, dt);
    const Segment move{pose.position, next.position};
    const ObstacleHorizon::Meeting met = horizon_.meeting(piece, move, radius_);
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
  return heading_along(p - from);
}

/// Time lost to turning into the best continuation, which the field ignores [s]. While the swarm
/// turns by an angle at its full rate, it advances only by the sine of that angle.
double PredictiveNavigator::turning_time(const Pose2& pose) const {
  if (!wanted_) return 0;
  const double wanted = ending_ ? heading_along(aim().position - pose.position) : *wanted_;
  const double turn = turn_between(wanted, pose.heading);
  return (turn - maths::sin(turn)) / swarm().max_turn_rate;
}

/// Computes the field's best path and returns the minimum gap to a body on it [µm], evaluated at
/// the start of each step.
double PredictiveNavigator::follow_field(Vec2 from) {
  double least = std::numeric_limits<double>::infinity();
  Vec2 p = from;
  path_.push_back(p);
  for (int k = 1; k < field_.steps(); ++k) {
    for (std::size_t i = 0; i < horizon_.size(); ++i)
      least = std::min(least, horizon_.distance_to(i, horizon_.sample(2 * k)[i], p) - radius_);
    if (arrives(p)) break;
    p = field_.next(k, p);
    path_.push_back(p);
  }
  return least;
}

}  // namespace microswarm::navigation

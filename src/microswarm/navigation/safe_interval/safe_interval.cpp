// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/safe_interval/safe_interval.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/navigation/prediction/validate_prediction.hpp"

namespace microswarm::navigation {
namespace {

constexpr double relative_rounding = 1e-9;
/// Shares of the gaps with which a plan is searched in turn.
constexpr std::array<double, 3> gap_shares{1, 0.5, 0.15};
/// Shares of the gap to walls of routes.
constexpr std::array<double, 4> route_gap_shares{1, 0.5, 0.2, 0.1};

}  // namespace

Issues validate(const SafeIntervalParams& params) { return validate_prediction(params.prediction); }

SafeIntervalNavigator::SafeIntervalNavigator(const SafeIntervalParams& params, const Task& task,
                                             Rng)
    : SteeringNavigator(task, params.speed),
      params_(params),
      tick_(task.tick),
      radius_(swarm().radius),
      predictor_(params.prediction),
      forecast_(params, speed()),
      turning_{swarm().max_turn_rate},
      planner_(params, swarm().radius, speed(), turning_),
      plan_(speed(), turning_),
      tried_(speed(), turning_),
      imminent_(params.tuning.imminent, swarm(), speed(), task.tick) {
  estimate_swarm(params.tuning.straying_time);
  path_.reserve(KeptPlan::max_legs + 1);
}

void SafeIntervalNavigator::prepare(const Snapshot& world, const Stop&) {
  const double wanted = swarm().radius + params_.wall_gap;
  choose_aim(world, swarm().radius, wanted);
  planner_.prepare(world.map(), {aim().position, params_.tuning.goal_share * aim().tolerance},
                   wall_clearance(wanted, aim().position, 0));
  routes_.clear();
  for (const double share : route_gap_shares) {
    const double clearance = std::min(swarm().radius + share * params_.wall_gap,
                                      (1 - relative_rounding) * aim().clearance);
    routes_.emplace_back(world.shared_map(), aim().position, clearance);
  }
}

Diagnostics SafeIntervalNavigator::diagnostics() const {
  return path_.empty() ? Diagnostics() : forecast_.diagnostics(radius_);
}

void SafeIntervalNavigator::update(const Observation& seen, const Stop&) {
  predictor_.update(seen);
  path_.clear();
}

Decision SafeIntervalNavigator::finish(const Decision& decision, const Observation&) {
  last_ = decision.command;
  step_view().path = path_;
  return decision;
}

/// Clearance from walls that the next move can keep [µm].
double SafeIntervalNavigator::entry_clearance(const Map& map, Vec2 p) const {
  const double wanted = swarm().radius + params_.tuning.imminent.wall_gap + straying_;
  return std::min(wall_clearance(wanted, p, tick_ * speed()),
                  (1 - relative_rounding) * map.clearance(p));
}

Decision SafeIntervalNavigator::decide(const Moment& moment) {
  const Pose2& pose = moment.pose;
  const double now = moment.seen.seen + delay();
  straying_ = params_.tuning.straying_gain * std::sqrt(estimate()->variance());
  radius_ = std::max(swarm().radius, moment.seen.swarm->radius) + straying_;
  forecast_.update(moment.world(), predictor_, now, std::array{pose.position, aim().position});
  forecast_.measure_from(pose.position, radius_);
  imminent_.begin({&moment.map(),
                   &forecast_,
                   pose,
                   radius_,
                   entry_clearance(moment.map(), pose.position),
                   {goal(), goal_tolerance()},
                   response(),
                   now});
  plan_.advance(pose.position, 0.6 * tick_ * speed(), now);
  review(moment, now);
  path_.push_back(pose.position);
  for (const KeptPlan::Leg& leg : plan_.legs()) path_.push_back(leg.end);
  if (!plan_.empty()) step_view().local_target = plan_.leg().end;

  const Command command = wanted(moment, now);
  const Command kept = steady(command);
  const bool waits = command.speed == 0;
  constexpr double near = 60;  // [µm]
  const auto planned_state = [&] {
    if (waits) return plan_.empty() ? NavigatorState::hold : NavigatorState::wait;
    return forecast_.min_current_gap() < near ? NavigatorState::avoid : NavigatorState::follow;
  };
  // At first bodies near the swarm may turn round at any moment; then they move as predicted.
  for (const auto turns : {ImminentCheck::Turns::of_any_body, ImminentCheck::Turns::none}) {
    if (kept.heading != command.heading && imminent_.is_safe(kept, turns))
      return {kept, planned_state()};
    if (imminent_.is_safe(command, turns)) return {command, planned_state()};
    if (const auto instead = imminent_.nearest_safe(command, last_, turns))
      return {*instead, instead->speed > 0 ? NavigatorState::avoid : NavigatorState::hold};
  }
  if (const auto instead = imminent_.kept_escape())
    return {*instead, instead->speed > 0 ? NavigatorState::avoid : NavigatorState::hold};
  return {imminent_.best_escape(last_), NavigatorState::escape};
}

// Keeps the plan while it is safe; looks for a better one from time to time.
void SafeIntervalNavigator::review(const Moment& moment, double now) {
  const double conflict =
      plan_.empty()
          ? 0
          : plan_.conflict(moment.pose, now, forecast_, forecast_.near_samples(), radius_,
                           params_.tuning.kept_share, params_.tuning.imminent.recovery_rate);
  const bool is_due =
      !reviewed_ || now - *reviewed_ >= params_.replan_period - 1e-9 || now < *reviewed_;
  if (!plan_.empty() && conflict == infinity && !is_due) return;
  reviewed_ = now;
  if (goes_straight(moment, now)) return;
  replan(moment, now, conflict);
}

/// Adopts the straight way to the goal if nothing is near it.
bool SafeIntervalNavigator::goes_straight(const Moment& moment, double now) {
  const Vec2 position = moment.pose.position;
  const Segment way{position, aim().position};
  const double clearance = wall_clearance(swarm().radius + params_.wall_gap, position,
                                          distance(position, aim().position));
  if (!moment.map().is_free(way, std::min(clearance, entry_clearance(moment.map(), position))))
    return false;
  return takes(moment.pose, std::array{position, aim().position}, now);
}

/// Adopts the straight pieces between `points` if nothing is near them that moves, rests or is
/// hollow.
bool SafeIntervalNavigator::takes(const Pose2& pose, std::span<const Vec2> points, double now) {
  tried_.adopt(std::array{planning::TimedPoint{points[0], 0}}, now, 0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!forecast_.hollow().empty() &&
        !forecast_.hollow().is_free(Segment{points[i - 1], points[i]},
                                    radius_ + params_.gap + forecast_.closing()))
      return false;
    tried_.append(points[i]);
  }
  forecast_.predict_all(predictor_);
  if (tried_.conflict(pose, now, forecast_, forecast_.samples(), radius_, 1,
                      params_.tuning.imminent.recovery_rate) < infinity)
    return false;
  plan_ = tried_;
  return true;
}

void SafeIntervalNavigator::replan(const Moment& moment, double now, double conflict) {
  const Pose2& pose = moment.pose;
  planner_.refresh(moment.map(), forecast_, pose.position, now);
  forecast_.predict_all(predictor_);
  step_view().planned = true;
  for (const double share : gap_shares) {
    planner_.plan(moment.map(), forecast_, pose, radius_,
                  entry_clearance(moment.map(), pose.position), share, moment.stop);
    if (planner_.path().size() > 1) break;
  }
  const bool has_path = planner_.path().size() > 1;
  const bool leads_on = has_path && !planner_.is_coarse() && !planner_.ends_in_stay();
  if (!leads_on && takes_route(moment, now)) return;
  if (!has_path) {
    if (conflict < params_.tuning.checked_time) plan_.clear();
    return;
  }
  if (!plan_.empty()) {
    double kept = plan_.duration(pose, now) + plan_.left();
    if (conflict < infinity) kept += params_.tuning.conflict_delay;
    const bool is_used_up = plan_.duration(pose, now) < 0.5 * params_.horizon && plan_.left() > 0 &&
                            !planner_.ends_at_goal();
    const bool is_near = conflict < 0.5 * params_.tuning.checked_time;
    const bool opens = plan_.ends_in_stay() && !planner_.ends_in_stay();
    if (!is_near && !is_used_up && !opens && planner_.cost() > kept - params_.switch_time) return;
  }
  plan_.adopt(planner_.path(), now, planner_.ends_at_goal() ? 0 : planner_.left());
  if (planner_.ends_at_goal()) plan_.append(aim().position);
  shorten(moment, now);
}

/// Adopts the shortest path among walls if nothing is near it: passages may be narrower than the
/// planner's cells.
bool SafeIntervalNavigator::takes_route(const Moment& moment, double now) {
  for (planning::Route& route : routes_) {
    route.stop_with(moment.stop);
    const std::vector<Vec2> path = route.path_from(moment.pose.position);
    if (path.size() > 1) return takes(moment.pose, path, now);
  }
  return false;
}

/// Cuts corners of the plan's next seconds that are due to the grid and to cells occupied for whole
/// slots, where the direct way keeps the gaps.
void SafeIntervalNavigator::shorten(const Moment& moment, double now) {
  constexpr double shorten_time = 3;  // [s]
  const Vec2 position = moment.pose.position;
  const double clearance = entry_clearance(moment.map(), position);
  while (const KeptPlan::Leg* next = plan_.next_leg()) {
    if (next->depart - now > shorten_time) return;
    if (!moment.map().is_free(Segment{position, next->end}, clearance)) return;
    tried_ = plan_;
    tried_.cut(position);
    if (tried_.conflict(moment.pose, now, forecast_, forecast_.near_samples(), radius_, 1,
                        params_.tuning.imminent.recovery_rate) < infinity)
      return;
    plan_ = tried_;
  }
}

/// Command along the plan. A corner is cut when the next leg is in sight.
Command SafeIntervalNavigator::wanted(const Moment& moment, double now) {
  const Pose2& pose = moment.pose;
  if (plan_.empty()) return {pose.heading, 0};
  constexpr double cut_time = 0.3;  // [s]
  const double clearance = entry_clearance(moment.map(), pose.position);
  while (const KeptPlan::Leg* next = plan_.next_leg()) {
    if (next->depart - now > cut_time) break;
    if (distance(pose.position, plan_.leg().end) > cut_time * speed()) break;
    if (plan_.wait(now) > 0.5 * tick_) break;
    const double arrival = now + distance(pose.position, plan_.leg().end) / speed();
    if (next->depart > arrival + 0.5 * tick_) break;  // it waits there
    if (!moment.map().is_free(Segment{pose.position, next->end}, clearance)) break;
    tried_ = plan_;
    tried_.cut(pose.position);
    if (tried_.conflict(pose, now, forecast_, forecast_.near_samples(), radius_, 1,
                        params_.tuning.imminent.recovery_rate) < infinity)
      break;
    plan_ = tried_;
  }
  const Vec2 target = plan_.leg().end;
  const Vec2 offset = target - pose.position;
  if (norm(offset) == 0) return {pose.heading, 0};
  const double course = heading_along(offset);
  if (plan_.wait(now) <= 0.5 * tick_)
    return {course, approach_speed(pose, target, plan_.is_last())};
  if (plan_.is_stay() || !turning_.applies(turn_between(course, pose.heading)))
    return {pose.heading, 0};
  return {course, planning::TurnFirst::slow_share * speed()};
}

/// Speed at which the target can be reached after the turn towards it, and without passing the goal
/// in a tick.
double SafeIntervalNavigator::approach_speed(const Pose2& pose, Vec2 target, bool is_goal) const {
  const double away = distance(pose.position, target);
  double fastest = speed();
  if (is_goal) fastest = std::min(fastest, std::max(away, 0.5 * aim().tolerance) / tick_);
  if (!std::isfinite(swarm().max_turn_rate)) return fastest;
  const Command course{heading_along(target - pose.position), speed()};
  const double turn = turn_between(response().command_for(course, speed()).heading, pose.heading);
  const double sine = maths::sin(std::min(turn, 0.5 * pi));
  if (turning_.applies(turn)) return std::min(planning::TurnFirst::slow_share * speed(), fastest);
  constexpr double slowest_share = 0.1;
  constexpr double reserve = 0.8;
  const double turning = reserve * swarm().max_turn_rate * away / std::max(2 * sine, 1e-6);
  return std::clamp(turning, std::min(slowest_share * speed(), fastest), fastest);
}

/// The last heading, if the command hardly differs from it.
Command SafeIntervalNavigator::steady(const Command& command) const {
  if (command.speed <= 0 || last_.speed <= 0) return command;
  if (turn_between(command.heading, last_.heading) > params_.tuning.deadband) return command;
  return {last_.heading, command.speed};
}

}  // namespace microswarm::navigation

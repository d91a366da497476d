// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/hierarchical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "microswarm/core/fields/published.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm::navigation {

namespace {

HierarchicalParams with_speed(HierarchicalParams params, double speed) {
  params.speed = speed;
  return params;
}

}  // namespace

HierarchicalParams HierarchicalParams::in_effect() const {
  HierarchicalParams p = *this;
  if (!as_published) return p;
  p.extra_clearance = 0;
  p.horizon = 0;
  p.target_horizon = 0;
  p.guide = Guide::straight;
  p.follower.kind = FollowerKind::pure_pursuit;
  p.follower.correct_flow = false;
  p.tuning.patience = infinity;
  p.planner.as_published = true;
  p.planner = p.planner.in_effect();
  return p;
}

Issues validate(const HierarchicalParams& params, const IsGiven& is_given) {
  Issues issues;
  issues.add_within("planner", validate(params.planner, given_within(is_given, "planner")));
  if (params.as_published)
    issues.add(validate_published(is_given, params, params.in_effect(), HierarchicalParams{}));
  if (params.tuning.speed_shares.empty())
    issues.add("tuning.speed_shares", "tuning.speed_shares is empty, must have a value");
  const std::vector<double>& waits = params.tuning.wait_times;
  if (waits.empty() || waits.front() != 0 || !std::ranges::is_sorted(waits))
    issues.add("tuning.wait_times_s", "tuning.wait_times_s must ascend from 0");
  return issues;
}

HierarchicalNavigator::HierarchicalNavigator(const HierarchicalParams& params, const Task& task,
                                             Rng rng)
    : SteeringNavigator(task, params.speed),
      params_(with_speed(params.in_effect(), speed())),
      rng_(rng),
      safety_(params_, swarm()),
      obstacles_(params.tracker, params.tuning.prediction),
      follower_(params.follower, swarm()),
      leader_(params_, task) {}

void HierarchicalNavigator::prepare(const Snapshot& world, const Stop&) {
  choose_aim(world, params_.clearance, params_.clearance + params_.extra_clearance);
  guide_.prepare(world.shared_map(), aim(), params_);
}

void HierarchicalNavigator::overruled(double now, const Command& command) {
  SteeringNavigator::overruled(now, command);
  leader_.overruled(now, command);
}

void HierarchicalNavigator::update(const Observation& seen, const Stop& stop) {
  leader_.begin_step();
  guide_.stop_with(stop);
  obstacles_.update(seen);
  if (sees_swarm(seen)) follower_.update(seen, compensator());
}

Decision HierarchicalNavigator::finish(const Decision& decision, const Observation& seen) {
  if (last_command())
    safety_.set_period(std::clamp(seen.now - *last_command(), params_.tuning.check_step, 1.0));
  if (!leader_.leads()) leader_.overruled(seen.now, decision.command);
  NavigatorView& view = step_view();
  view.local_target = target_;
  if (guide_.has_routes() && seen.world) view.phased_goal = guide_.towards(pose_.position);
  view.path = leader_.leads() ? leader_.view().path : path_.points;
  view.plan = plan_ ? &*plan_ : nullptr;
  return decision;
}

Diagnostics HierarchicalNavigator::diagnostics() const {
  if (!plan_ && !wait_ && !leader_.leads()) return {};
  HierarchicalDiagnostics out{.towards = view().phased_goal.value_or(aim().position),
                              .path_clearance = path_.clearance,
                              .in_time = path_.kind == FollowedPath::Kind::in_time,
                              .is_led = leader_.leads()};
  if (wait_) out.wait_since = wait_->since, out.wait_at = wait_->at;
  return out;
}

Decision HierarchicalNavigator::decide(const Moment& moment) {
  pose_ = moment.pose;
  if (const auto decision = led(moment)) return *decision;
  return advance(moment);
}

/// The leader's decision in an impasse.
std::optional<Decision> HierarchicalNavigator::led(const Moment& moment) {
  const bool is_alone =
      moment.world().moving().is_free(pose_.position, params_.target.base_distance);
  const auto decision =
      leader_.decide(moment.seen, guide_.length_from(pose_.position), is_alone, moment.stop);
  if (!decision) return std::nullopt;
  path_ = {};
  plan_.reset();
  target_.reset();
  step_view().planned = leader_.view().planned;
  return decision;
}

// Algorithm 4 [drrt], one pass of its loop
Decision HierarchicalNavigator::advance(const Moment& moment) {
  const Snapshot& seen = moment.world();
  const bool is_lost = path_.is_route() && !is_alone(seen, path_.points, path_.position);
  if (is_lost || is_used_up() || !path_holds(seen)) replan(seen, moment.stop);  // lines 4–11
  auto decision = keep_path(seen);
  if (!decision && path_) {
    replan(seen, moment.stop, !path_.is_route());
    decision = keep_path(seen);
  }
  if (decision) return *decision;
  const auto hold_heading = [&](const Pose2&, double) { return hold().command; };
  if (params_.as_published || safety_.is_safe(situation(seen), std::ref(hold_heading)))
    return hold();
  path_ = {};
  const Command command = safety_.escape(situation(seen));
  return {command, command.speed > 0 ? NavigatorState::escape : NavigatorState::hold};
}

Decision HierarchicalNavigator::at_goal(const Moment& moment) {  // line 2
  pose_ = moment.pose;
  path_ = {};
  return hold(NavigatorState::arrived);
}

// Follows the path, more slowly if only that is safe.
std::optional<Decision> HierarchicalNavigator::keep_path(const Snapshot& seen) {
  if (!path_) return std::nullopt;
  if (path_.is_route()) return keep_route(seen);
  for (const double ease : params_.tuning.speed_shares) {
    const double speed = ease * params_.speed;
    if (!params_.as_published && !path_is_safe(seen, speed)) continue;
    return follow_path(speed);
  }
  return std::nullopt;
}

// The route bends closely around corners. It is followed with a shorter look-ahead rather than more
// slowly, and without using up all the room to the walls, which the next steps need. What faces a
// wall turns nearly on the spot, and may come a little nearer.
std::optional<Decision> HierarchicalNavigator::keep_route(const Snapshot& seen) {
  constexpr double slack = 1, turning_room = 5;  // [µm]
  constexpr double rounding = 1e-9;
  const double here = (1 - rounding) * seen.map().clearance(pose_.position);
  const double least = swarm().radius + slack;
  const double kept = std::min(params_.clearance, here);
  const double wanted = std::min(0.5 * (params_.clearance + path_.route_clearance), here);
  const auto tried = [&](double ease, double from_walls) -> std::optional<Decision> {
    for (const double share : {1.0, 0.5, 0.25, 0.125}) {
      path_.lookahead_share = share;
      if (path_is_safe(seen, ease * params_.speed, std::max(from_walls, least)))
        return follow_path(ease * params_.speed);
    }
    return std::nullopt;
  };
  for (const double ease : params_.tuning.speed_shares)
    for (const double from_walls : {wanted, kept})
      if (const auto decision = tried(ease, from_walls)) return decision;
  for (const double ease : {0.1, 0.05})
    if (const auto decision = tried(ease, kept - turning_room)) return decision;
  return std::nullopt;
}

Decision HierarchicalNavigator::follow_path(double speed) {
  const auto next = follow(path_.position, pose_, speed);
  return {next.command, next.handed_over ? NavigatorState::fallback : NavigatorState::follow};
}

// A path to a local target is replaced before its end, the one to the aim at its end.
bool HierarchicalNavigator::is_used_up() {
  if (!path_ || !target_) return false;
  if (!(*target_ == aim().position)) return remaining(path_.points, path_.position) < used_up();
  if (params_.as_published) return false;
  path_.position = nearest_position(path_.points, pose_.position, path_.position);
  return remaining(path_.points, path_.position) < path_end();
}

// Path Safety, P_clt Unsafe: tests the rest of the path against the current observation.
bool HierarchicalNavigator::path_holds(const Snapshot& world) const {
  if (!path_) return false;
  const double clearance = std::min(params_.clearance, path_.clearance);
  return path_.kind == FollowedPath::Kind::in_time
             ? is_free_in_time(world, obstacles_, path_.rest(), params_.speed, delay(),
                               params_.target_horizon, clearance)
             : world.is_free(path_.rest(), clearance);
}

void HierarchicalNavigator::replan(const Snapshot& seen, const Stop& stop, bool may_take_route) {
  path_ = {};
  const double here = seen.clearance(pose_.position);
  double wanted = params_.clearance + params_.extra_clearance;
  if (distance(pose_.position, aim().position) <= guide_.reach())  // it may have less
    wanted = std::clamp(aim().clearance, params_.clearance, wanted);
  if (may_take_route && replan_along_route(seen, here, stop)) return;
  if (here < params_.clearance) {
    target_.reset();
    return;
  }
  for (const double clearance : {wanted, params_.clearance})
    if (clearance <= here && replan_in_time(seen, clearance, stop)) return;
  const Snapshot ahead = obstacles_.swept_obstacles(
      seen, std::min(params_.horizon, params_.tuning.max_sweep), params_.clearance);
  for (const double clearance : {wanted, params_.clearance}) {
    if (clearance > here || stop()) continue;
    if (replan_with(ahead, clearance, stop) || replan_with(seen, clearance, stop)) return;
  }
  target_.reset();
}

// Everything beyond the horizon looks free, so without a limit waiting would always look better.
double HierarchicalNavigator::max_wait(double now) {
  if (wait_ && distance(wait_->at, pose_.position) > used_up()) wait_.reset();
  return params_.target_horizon - (wait_ ? now - wait_->since : 0);
}

// Whether no body comes near the next part of the route, and walls hide the goal: in the open a
// target in space and time is as good.
bool HierarchicalNavigator::is_alone(const Snapshot& seen, std::span<const Vec2> route,
                                     PathPosition position) const {
  if (seen.moving().empty()) return true;
  if (seen.map().is_free(Segment{pose_.position, aim().position}, params_.clearance)) return false;
  const double far = 2 * params_.clearance + params_.extra_clearance;
  const Snapshot swept = obstacles_.swept_obstacles(seen, params_.target_horizon, far);
  double left = params_.speed * params_.target_horizon;
  Vec2 from = point_ahead(route, position, 0);
  for (std::size_t i = position.piece + 1; i < route.size() && left > 0; ++i) {
    if (!swept.moving().is_free(Segment{from, route[i]}, far)) return false;
    left -= distance(from, route[i]);
    from = route[i];
  }
  return true;
}

// Among walls alone the shortest path to the aim is known, and nothing local is better.
bool HierarchicalNavigator::replan_along_route(const Snapshot& seen, double here,
                                               const Stop& stop) {
  constexpr double rounding = 1e-9;
  for (AimGuide::WallRoute& one : guide_.routes()) {
    if (stop()) return false;
    std::vector<Vec2> path = one.route.path_from(pose_.position);
    const double clearance = std::min({params_.clearance, one.clearance, (1 - rounding) * here});
    if (path.size() < 2 || !seen.is_free(Segment{path[0], path[1]}, clearance)) continue;
    if (!is_alone(seen, path, {})) return false;
    step_view().planned = true;
    plan_ = Plan{.status = Status::solved, .path = path};
    path_ = {.points = std::move(path),
             .kind = FollowedPath::Kind::route,
             .clearance = clearance,
             .route_clearance = one.clearance};
    target_ = aim().position;
    return true;
  }
  return false;
}

bool HierarchicalNavigator::replan_in_time(const Snapshot& seen, double clearance,
                                           const Stop& stop) {
  if (params_.target_horizon <= 0 || obstacles_.all_rest()) return false;
  const Vec2 from = pose_.position;
  const auto length_from = [&](Vec2 p) { return guide_.length_from(p, params_.tuning.detour); };
  const auto target = select_predicted_target(seen, obstacles_,
                                              {.swarm = pose_,
                                               .delay = delay(),
                                               .speed = params_.speed,
                                               .goal = aim().position,
                                               .towards = guide_.towards(from),
                                               .reach = params_.target.base_distance,
                                               .min_reach = 2 * used_up(),
                                               .angle_step = params_.target.angle_step,
                                               .turn_weight = params_.planner.smoothness_weight,
                                               .clearance = clearance,
                                               .horizon = params_.target_horizon,
                                               .max_wait = max_wait(seen.time()),
                                               .wait_times = params_.tuning.wait_times,
                                               .wait_weight = params_.tuning.wait_weight,
                                               .contact_weight = params_.tuning.contact_weight},
                                              length_from);
  if (!target) return false;
  if (target->wait > 0) {  // without a path it holds
    if (!wait_) wait_ = Wait{seen.time(), from};
    return true;
  }
  plan_to(Snapshot(seen.shared_map(), seen.time()), target->position, clearance, stop);
  path_.kind = FollowedPath::Kind::in_time;
  if (!path_holds(seen)) path_.points = {from, target->position};
  return true;
}

bool HierarchicalNavigator::replan_with(const Snapshot& world, double clearance, const Stop& stop) {
  const Vec2 from = pose_.position;
  if (!world.is_free(from, clearance)) return false;
  const LocalTargetQuery query{.swarm = pose_,
                               .goal_heading = heading_along(guide_.towards(from) - from),
                               .goal_distance = distance(from, aim().position),
                               .previous_target = target_,
                               .clearance = clearance,
                               .min_distance = swarm().radius};
  const bool near_goal =  // line 6
      params_.as_published
          ? query.goal_distance <= target_distance(world, query, params_.target, stop)
          : query.goal_distance <= guide_.reach() &&
                world.is_free(Segment{from, aim().position}, clearance);
  std::optional<Vec2> target;
  if (near_goal) {
    target = aim().position;  // line 9
  } else if (const auto chosen =
                 select_local_target(world, query, params_.target, stop)) {  // line 7
    target = chosen->position;
  }
  if (target) plan_to(world, *target, clearance, stop);
  return target.has_value();
}

void HierarchicalNavigator::plan_to(const Snapshot& world, Vec2 target, double clearance,
                                    const Stop& stop) {
  step_view().planned = true;
  const Vec2 from = pose_.position;
  planning::DrrtStarParams local = params_.planner;
  local.clearance = clearance;
  local.goal_tolerance =
      std::min({local.goal_tolerance, aim().tolerance, 0.25 * distance(from, target)});
  plan_ = planning::plan(world, pose_, target, local, rng_, stop);  // line 11
  if (plan_->status == Status::solved)
    path_.points = plan_->path;
  else if (!params_.as_published)
    path_.points = {from, target};  // free: checked by target selection
  path_.clearance = clearance;
  target_ = target;
}

// A learned follower circles a small goal, so pure pursuit takes over for the last part. At the
// goal and at the end of the path it holds, and it does not pass the aim within a tick, so that the
// look-ahead matches the motion.
PathFollower::Answer HierarchicalNavigator::follow(PathPosition& position, const Pose2& pose,
                                                   double speed) const {
  const double lookahead = params_.as_published ? params_.lookahead : lookahead_at(speed);
  const bool last_bit =
      *target_ == aim().position && distance(pose.position, aim().position) < lookahead;
  PathFollower::Answer answer =
      last_bit ? PathFollower::Answer{pursue(path_.points, position, pose, lookahead, speed)}
               : follower_.command(path_.points, position, pose, lookahead, speed);
  if (params_.as_published) return answer;
  const double left = remaining(path_.points, position);
  if (left < path_end() || arrives(pose.position)) return {{pose.heading, 0}};
  if (last_bit) answer.command.speed = std::min(answer.command.speed, left / safety_.period());
  return answer;
}

bool HierarchicalNavigator::path_is_safe(const Snapshot& seen, double speed,
                                         std::optional<double> from_walls) const {
  PathPosition position = path_.position;
  const auto steer = [&](const Pose2& pose, double) {
    return follow(position, pose, speed).command;
  };
  return safety_.is_safe(situation(seen), std::ref(steer), from_walls);
}

}  // namespace microswarm::navigation

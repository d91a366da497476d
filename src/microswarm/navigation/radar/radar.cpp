// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/radar.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths.hpp"
#include "microswarm/navigation/radar/wait_area.hpp"
#include "microswarm/navigation/steering/helm.hpp"
#include "microswarm/planning/path/fmt_star.hpp"
#include "microswarm/world/connectivity/free_place.hpp"

namespace microswarm {
namespace {

constexpr double replan_time = 1;    // between two plans, at least [s]
constexpr double longest_wait = 30;  // after plans that failed [s]
constexpr double usual_tick = 0.1;   // [s]

}  // namespace

RadarNavigator::RadarNavigator(const RadarParams& params, const SwarmLimits& swarm, Vec2 goal,
                               double goal_tolerance, Rng rng, double frame_timeout)
    : params_(params.in_effect()),
      swarm_(swarm),
      goal_(goal),
      aim_{.position = goal, .tolerance = goal_tolerance},
      goal_tolerance_(goal_tolerance),
      frame_timeout_(frame_timeout),
      rng_(rng),
      safety_radius_(params.safety_radius),
      forecast_(swarm),
      scanner_(directions_of(params)),
      guard_(params.guard, std::min(params.speed, swarm.max_speed)) {
  params_.speed = std::min(params.speed, swarm.max_speed);
}

void RadarNavigator::prepare(const Snapshot& world) {
  if (params_.as_published) return;
  aim_ = aim_at(Snapshot(world.shared_map()), goal_, goal_tolerance_, swarm_.radius,
                swarm_.radius + params_.safety_distance);
}

Command RadarNavigator::step(const Observation& seen, const Stop& stop) {
  view_ = {};
  look_.reset();
  contact_.reset();
  Command command = decide(seen, stop);
  if (params_.guard.active && seen.world) command = guarded(command, seen);
  if (command.speed > 0) course_ = unit_vector(command.heading);
  last_ = seen.now;
  forecast_.note(seen.now, command);
  view_.path = route_.rest();
  if (!route_.empty()) view_.phased_goal = view_.path.front();
  if (plan_) view_.plan = &*plan_;
  return command;
}

// A frame without a swarm is no reason to forget where it was.
Command RadarNavigator::guarded(const Command& command, const Observation& seen) {
  guard_.see(seen);
  if (look_) {
    sighted_ = seen.seen;
    sighting_ = seen.swarm;
  } else if (sighting_ && seen.now - sighted_ <= frame_timeout_) {
    pose_ = forecast_.at_effect(
        {.now = seen.now, .seen = sighted_, .swarm = sighting_, .robots = {}, .world = seen.world});
  } else {
    return command;
  }
  const Guard::Start start{.place = pose_.position,
                           .radius = std::max(sighting_->radius, swarm_.radius),
                           .time = seen.now + swarm_.response_lag};
  const double since = last_ ? seen.now - *last_ : 0;
  const double tick = since > 0 && since < 1 ? since : usual_tick;
  const auto instead = guard_.overrules(command, start, *seen.world, tick);
  if (!instead) return command;
  return issue(*instead, instead->speed > 0 ? NavigatorState::guard : NavigatorState::hold);
}

Command RadarNavigator::decide(const Observation& seen, const Stop& stop) {
  if (!sees_swarm(seen, frame_timeout_) || !(seen.swarm->radius > 0))
    return issue({}, NavigatorState::blind);
  pose_ = params_.compensate_delay ? forecast_.at_effect(seen) : seen.swarm->pose;
  if (!seen.world->is_free(pose_.position, 0)) return issue({}, NavigatorState::hold);
  find_route(seen, stop);
  const bool has_plan = !route_.empty();
  const Vec2 target = has_plan ? route_.target(seen.world->map(), pose_.position,
                                               seen.swarm->radius, params_.waypoint_tolerance)
                               : aim_.position;
  look_ = look_around(seen, target);
  contact_ = scanner_.detect(*look_, *seen.world);
  if (contact_)
    look_->circles.safety = safety_radius_.radius(look_->circles.safety, look_->circles.prediction,
                                                  contact_->distance - look_->radius);
  view_.local_target = target;

  if (distance(pose_.position, goal_) <= goal_tolerance_)
    return rest(seen, NavigatorState::arrived);
  if (!has_plan) return rest(seen, NavigatorState::stuck);
  const Waiting waiting{pose_.position, look_->radius, look_->circles.prediction, target};
  for (const WaitArea& area : params_.wait_areas)  // Eq 29
    if (must_wait(area, seen.world->moving().bodies(), waiting))
      return rest(seen, NavigatorState::wait);
  if (const auto heading = scanner_.choose(*look_, *seen.world)) {
    const bool straight =
        !contact_ && turn_between(*heading, heading_of(target - pose_.position)) < 1e-9;
    return issue({*heading, params_.speed},
                 straight ? NavigatorState::direct : NavigatorState::avoid);
  }
  const bool near_wall = !seen.world->map().is_free(pose_.position, look_->wall_reach());
  if (!contact_ && !near_wall) return rest(seen, NavigatorState::stuck);
  if (params_.retreat)
    if (const auto heading = scanner_.retreat(*look_, *seen.world))
      return issue({*heading, params_.speed}, NavigatorState::retreat);
  return issue({pose_.heading, 0}, contact_ ? NavigatorState::hold : NavigatorState::stuck);
}

// Waypoints by hand, planned, or just the goal.
void RadarNavigator::find_route(const Observation& seen, const Stop& stop) {
  if (!routed_ && !params_.waypoints.empty()) {
    std::vector<Vec2> points = params_.waypoints;
    points.push_back(aim_.position);
    route_ = RadarRoute(std::move(points), false);
  } else if (!routed_ && !params_.global_plan) {
    route_ = RadarRoute({aim_.position}, true);
  } else if (params_.waypoints.empty() && params_.global_plan && seen.now >= plan_again_at_ &&
             (route_.empty() || !route_.in_sight())) {
    view_.planned = true;
    const Snapshot walls(seen.world->shared_map());
    const double radius = std::max(swarm_.radius, seen.swarm->radius);
    const bool found =
        plan_route(walls, pose_, std::max(params_.planner.clearance, radius), stop) ||
        plan_route(walls, beside_walls(walls.map(), radius), radius, stop);
    wait_ = found ? replan_time : std::min(2 * std::max(wait_, 0.5 * replan_time), longest_wait);
    plan_again_at_ = seen.now + wait_;
  }
  routed_ = true;
}

// A swarm that is seen, or was pushed, a little too near to a wall can plan from beside it.
Pose2 RadarNavigator::beside_walls(const Map& map, double radius) const {
  const Vec2 place = free_place(map, pose_.position, radius);
  const bool in_sight = map.is_free(Segment{pose_.position, place}, 0);
  return {in_sight ? place : pose_.position, pose_.heading};
}

bool RadarNavigator::plan_route(const Snapshot& walls, Pose2 from, double clearance,
                                const Stop& stop) {
  FmtStarParams planner = params_.planner;
  planner.clearance = clearance;
  planner.goal_tolerance = std::min(planner.goal_tolerance, aim_.tolerance);
  plan_ = plan(walls, from, aim_.position, planner, rng_, stop);
  if (plan_->status != Status::solved) return false;
  std::vector<Vec2> points = plan_->path;
  if (points.size() > 1 && from.position == pose_.position) points.erase(points.begin());
  route_ = RadarRoute(std::move(points), !params_.as_published);
  return true;
}

RadarLook RadarNavigator::look_around(const Observation& seen, Vec2 target) const {
  const double radius = seen.swarm->radius;
  const double dead_time = seen.age() + swarm_.response_lag;
  const double from_walls = aim_.wall_clearance(radius, radius + params_.safety_distance,
                                                pose_.position, params_.prediction_distance);
  return {.centre = pose_.position,
          .radius = radius,
          .target = target,
          .circles = circles_of(params_, radius),
          .step = params_.prediction_distance,
          .wall_distance = from_walls - radius,
          .approach = params_.compensate_delay ? params_.obstacle_speed_bound * dead_time : 0,
          .target_gain = params_.target_gain,
          .avoidance_gain = params_.avoidance_gain,
          .course = course_,
          .least_cosine = maths::cos(params_.most_turn)};
}

Command RadarNavigator::rest(const Observation& seen, NavigatorState state) {
  const bool pressed = contact_ && contact_->distance < look_->circles.prediction;
  if (pressed && params_.retreat)
    if (const auto heading = scanner_.retreat(*look_, *seen.world))
      return issue({*heading, params_.speed}, NavigatorState::retreat);
  return issue({pose_.heading, 0}, state);
}

Command RadarNavigator::issue(const Command& command, NavigatorState state) {
  view_.state = state;
  return command;
}

}  // namespace microswarm

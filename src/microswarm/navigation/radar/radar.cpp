// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/radar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/navigation/radar/wait_zone.hpp"
#include "microswarm/planning/trees/fmt_star.hpp"
#include "microswarm/world/connectivity/free_place.hpp"

namespace microswarm::navigation {
namespace {

constexpr double usual_tick = 0.1;  // [s]

}  // namespace

Issues validate(const RadarParams& params, const SwarmLimits& swarm, const Map& map,
                const IsGiven& is_given) {
  Issues issues = validate(params, is_given);
  issues.add(validate_step(params, swarm));
  const Snapshot walls = Snapshot::of(map);
  for (std::size_t i = 0; i < params.waypoints.size(); ++i)
    if (const auto why = walls.blocked_reason(params.waypoints[i], swarm.radius); !why.empty())
      issues.add(fmt::format("waypoints_um.{}", i), fmt::format("waypoint {} {}", i + 1, why));
  return issues;
}

RadarNavigator::RadarNavigator(const RadarParams& params, const Task& task, Rng rng)
    : SteeringNavigator(task, params.speed),
      params_(params.in_effect()),
      rng_(rng),
      safety_radius_(params.safety_radius),
      scanner_(direction_count(params), params.tuning),
      filter_(params.safety_filter, speed()) {
  params_.speed = speed();
}

void RadarNavigator::prepare(const Snapshot& world, const Stop&) {
  if (params_.as_published) return;
  choose_aim(world, swarm().radius, swarm().radius + params_.safety_distance);
}

void RadarNavigator::update(const Observation&, const Stop&) {
  look_.reset();
  contact_.reset();
}

bool RadarNavigator::sees_swarm(const Observation& seen) const {
  return SteeringNavigator::sees_swarm(seen) && seen.swarm->radius > 0;
}

Decision RadarNavigator::finish(const Decision& decided, const Observation& seen) {
  const bool filters = params_.safety_filter.active && seen.world;
  const Decision decision = filters ? filtered(decided, seen) : decided;
  if (decision.command.speed > 0) course_ = unit_vector(decision.command.heading);
  NavigatorView& view = step_view();
  view.path = route_.rest();
  if (!route_.empty()) view.phased_goal = view.path.front();
  if (plan_) view.plan = &*plan_;
  return decision;
}

Diagnostics RadarNavigator::diagnostics() const {
  return look_ ? Diagnostics(scan(*look_, *seen_, directions())) : Diagnostics();
}

// Remembers the last position over frames without a swarm.
Decision RadarNavigator::filtered(const Decision& decision, const Observation& seen) {
  filter_.update(seen);
  Vec2 position = pose_.position;
  if (look_) {
    sighting_ = Sighting{seen.seen, *seen.swarm};
  } else if (sighting_ && seen.now - sighting_->time <= frame_timeout()) {
    position = compensator()
                   .at_effect({.now = seen.now,
                               .seen = sighting_->time,
                               .swarm = sighting_->swarm,
                               .robots = {},
                               .world = seen.world})
                   .position;
  } else {
    return decision;
  }
  const SafetyFilter::Start start{.position = position,
                                  .radius = std::max(sighting_->swarm.radius, swarm().radius),
                                  .time = seen.now + swarm().response_lag};
  const double since = seen.now - last_command().value_or(seen.now);
  const double tick = since > 0 && since < 1 ? since : usual_tick;
  const auto instead = filter_.filter(decision.command, start, *seen.world, tick);
  if (!instead) return decision;
  return {*instead, instead->speed > 0 ? NavigatorState::guard : NavigatorState::hold};
}

Decision RadarNavigator::decide(const Moment& moment) {
  const auto& [seen, at_effect, stop] = moment;
  pose_ = params_.compensate_delay ? at_effect : seen.swarm->pose;
  if (!seen.world->is_free(pose_.position, 0)) return {{}, NavigatorState::hold};
  find_route(seen, stop);
  const bool has_plan = !route_.empty();
  const Vec2 target = has_plan ? route_.target(seen.world->map(), pose_.position,
                                               seen.swarm->radius, params_.waypoint_tolerance)
                               : aim().position;
  look_around(seen, target);
  step_view().local_target = target;

  if (arrives(pose_.position)) return rest(seen, NavigatorState::arrived);
  if (!has_plan) return rest(seen, NavigatorState::stuck);
  const Waiting waiting{pose_.position, look_->radius, look_->circles.prediction, target};
  for (const WaitZone& zone : params_.wait_zones)  // Eq 29
    if (must_wait(zone, seen.world->moving().bodies(), waiting))
      return rest(seen, NavigatorState::wait);
  if (const auto heading = scanner_.choose(*look_, *seen.world)) {
    const bool straight =
        !contact_ && turn_between(*heading, heading_along(target - pose_.position)) < 1e-9;
    return {{*heading, params_.speed}, straight ? NavigatorState::direct : NavigatorState::avoid};
  }
  const bool near_wall = !seen.world->map().is_free(pose_.position, look_->wall_reach());
  if (!contact_ && !near_wall) return rest(seen, NavigatorState::stuck);
  if (const auto retreat = this->retreat(seen)) return *retreat;
  return {{pose_.heading, 0}, contact_ ? NavigatorState::hold : NavigatorState::stuck};
}

// Route of given waypoints, planned waypoints, or only the goal.
void RadarNavigator::find_route(const Observation& seen, const Stop& stop) {
  if (!routed_ && !params_.waypoints.empty()) {
    std::vector<Vec2> points = params_.waypoints;
    points.push_back(aim().position);
    route_ = RadarRoute(std::move(points), false);
  } else if (!routed_ && !params_.global_plan) {
    route_ = RadarRoute({aim().position}, true);
  } else if (params_.waypoints.empty() && params_.global_plan && seen.now >= plan_again_at_ &&
             (route_.empty() || !route_.in_sight())) {
    step_view().planned = true;
    const Snapshot walls(seen.world->shared_map());
    const double radius = std::max(swarm().radius, seen.swarm->radius);
    const bool found =
        plan_route(walls, pose_, std::max(params_.planner.clearance, radius), stop) ||
        plan_route(walls, beside_walls(walls.map(), radius), radius, stop);
    wait_ = found ? params_.tuning.replan_interval
                  : std::min(2 * std::max(wait_, 0.5 * params_.tuning.replan_interval),
                             params_.tuning.max_replan_interval);
    plan_again_at_ = seen.now + wait_;
  }
  routed_ = true;
}

// A swarm observed or pushed slightly too near to a wall plans from a free point beside it.
Pose2 RadarNavigator::beside_walls(const Map& map, double radius) const {
  const Vec2 position = free_place(map, pose_.position, radius);
  const bool in_sight = map.is_free(Segment{pose_.position, position}, 0);
  return {in_sight ? position : pose_.position, pose_.heading};
}

bool RadarNavigator::plan_route(const Snapshot& walls, Pose2 from, double clearance,
                                const Stop& stop) {
  planning::FmtStarParams planner = params_.planner;
  planner.clearance = clearance;
  planner.goal_tolerance = std::min(planner.goal_tolerance, aim().tolerance);
  plan_ = planning::plan(walls, from, aim().position, planner, rng_, stop);
  if (plan_->status != Status::solved) return false;
  std::vector<Vec2> points = plan_->path;
  if (points.size() > 1 && from.position == pose_.position) points.erase(points.begin());
  route_ = RadarRoute(std::move(points), !params_.as_published);
  return true;
}

// Input of the decision: the detected contact determines the radius of the safety circle.
void RadarNavigator::look_around(const Observation& seen, Vec2 target) {
  const double radius = seen.swarm->radius;
  const double from_walls = aim().wall_clearance(radius, radius + params_.safety_distance,
                                                 pose_.position, params_.prediction_distance);
  RadarLook look{.centre = pose_.position,
                 .radius = radius,
                 .target = target,
                 .circles = make_circles(params_, radius),
                 .step = params_.prediction_distance,
                 .wall_distance = from_walls - radius,
                 .approach = params_.compensate_delay ? params_.obstacle_speed_bound * delay() : 0,
                 .target_gain = params_.target_gain,
                 .avoidance_gain = params_.avoidance_gain,
                 .printed_weights = params_.printed_weights,
                 .course = course_,
                 .min_cosine = maths::cos(params_.max_turn)};
  contact_ = scanner_.detect(look, *seen.world);
  if (contact_)
    look.circles.safety = safety_radius_.radius(look.circles.safety, look.circles.prediction,
                                                contact_->distance - look.radius);
  look_ = look;
  seen_ = seen.world;
}

std::optional<Decision> RadarNavigator::retreat(const Observation& seen) {
  if (!params_.retreat) return std::nullopt;
  const auto heading = scanner_.retreat(*look_, *seen.world);
  if (!heading) return std::nullopt;
  return Decision{{*heading, params_.speed}, NavigatorState::retreat};
}

// Holds, unless an obstacle is too close.
Decision RadarNavigator::rest(const Observation& seen, NavigatorState state) {
  const bool pressed = contact_ && contact_->distance < look_->circles.prediction;
  if (pressed)
    if (const auto retreat = this->retreat(seen)) return *retreat;
  return {{pose_.heading, 0}, state};
}

}  // namespace microswarm::navigation

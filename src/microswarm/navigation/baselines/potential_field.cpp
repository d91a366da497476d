// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/baselines/potential_field.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::navigation {
namespace {

/// Nearest point of an outline to `p`.
Vec2 nearest_to(const Disc& disc, Vec2 p) {
  const Vec2 away = p - disc.centre;
  const double d = norm(away);
  return d > 0 ? disc.centre + (disc.radius / d) * away : disc.centre;
}
Vec2 nearest_to(const Polygon& polygon, Vec2 p) {
  Vec2 nearest;
  double least = std::numeric_limits<double>::infinity();
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    const Vec2 q = nearest_point(p, Segment{a, b});
    if (squared_norm(q - p) >= least) return;
    least = squared_norm(q - p);
    nearest = q;
  });
  return nearest;
}
Vec2 nearest_to(const Body& body, Vec2 p) {
  return std::visit([&](const auto& shape) { return nearest_to(shape, p); }, body.shape);
}

}  // namespace

PotentialFieldNavigator::PotentialFieldNavigator(const PotentialFieldParams& params,
                                                 const Task& task, Rng)
    : SteeringNavigator(task, params.speed),
      params_(params),
      guide_(params.guide, goal(), params.tuning.route_reach),
      tracker_(params.tracker) {}

void PotentialFieldNavigator::prepare(const Snapshot& world, const Stop&) {
  const double radius = swarm().radius;
  choose_aim(world, radius, radius + params_.gap);
  guide_.prepare(world.shared_map(), aim().position, radius + params_.gap, radius);
}

void PotentialFieldNavigator::update(const Observation& seen, const Stop& stop) {
  guide_.stop_with(stop);
  tracker_.update(seen);
}

Decision PotentialFieldNavigator::decide(const Moment& moment) {
  const Snapshot& world = moment.world();
  const Vec2 p = moment.pose.position;
  const Vec2 target = guide_.target(world.map(), p);
  step_view().local_target = target;
  const Vec2 draw = unit_vector(heading_along(target - p));
  Vec2 pushes = push_of_walls(world.map(), p);
  const auto bodies = world.moving().bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    pushes += repulsive_push(bodies[i], tracker_.body(i), p, speed() * draw);
  const Vec2 force = draw + pushes;
  if (norm(force) < params_.min_force) return hold(NavigatorState::stuck);
  if (const auto command = clear_of_walls(world.map(), moment.pose, force))
    return {*command, pushes == Vec2{} ? NavigatorState::follow : NavigatorState::avoid};
  return hold();
}

/// Magnitude of the repulsion at a gap [µm].
double PotentialFieldNavigator::push(double gap, double influence) const {
  if (gap >= influence) return 0;
  const double x = std::min(params_.tuning.max_proximity, influence / std::max(gap, 1e-9));
  return params_.repulsion * (x - 1) * x * x;
}

/// Repulsion of static objects is reduced near the goal; otherwise a goal beside a wall could not
/// be reached (GNRON).
double PotentialFieldNavigator::calm_near_goal(Vec2 p) const {
  return std::min(1.0, distance(p, aim().position) / params_.influence);
}

/// The gradient of the clearance points away from the nearest wall; between two walls its central
/// differences cancel.
Vec2 PotentialFieldNavigator::push_of_walls(const Map& map, Vec2 p) const {
  const double edge = swarm().radius + params_.gap;
  const double gap = map.clearance(p) - edge;
  if (gap >= params_.wall_influence) return {};
  const auto slope = [&](Vec2 d) {
    return (map.clearance(p + d) - map.clearance(p - d)) / (2 * params_.tuning.stencil);
  };
  return calm_near_goal(p) * push(gap, params_.wall_influence) *
         Vec2{slope({params_.tuning.stencil, 0}), slope({0, params_.tuning.stencil})};
}

/// −∇ of ½ k g₀ (g₀ / g − 1)² with g = gap − reaction time · closing speed: away from the nearest
/// point, and sideways in the direction in which the two already pass each other. `wanted` is the
/// swarm's velocity without obstacles. Using its current velocity, it would oscillate in front of
/// resting obstacles.
Vec2 PotentialFieldNavigator::repulsive_push(const Body& body, const TrackedBody& motion, Vec2 p,
                                             Vec2 wanted) const {
  const Vec2 at = p - delay() * motion.velocity;  // relative to the body's observed position
  const bool inside = depth_in(body, at) >= 0;
  const Vec2 offset = (inside ? motion.centre : nearest_to(body, at)) - at;
  const double d = norm(offset);
  if (d == 0) return {};
  const Vec2 n = (1 / d) * offset;
  const Vec2 relative = wanted - motion.velocity;
  const double growth = outward_speed(body, motion);
  const double closing = std::max(0.0, dot(relative, n)) + growth;
  const double gap = (inside ? 0 : d) - swarm().radius - params_.gap - delay() * growth -
                     params_.reaction_time * closing;
  const Vec2 across = relative - dot(relative, n) * n;
  const double spoke = std::max(swarm().radius, distance(at, motion.centre));
  const double calm = norm(motion.velocity) < params_.tuning.rest_speed ? calm_near_goal(p) : 1;
  return calm * push(gap, params_.influence) * ((params_.reaction_time / spoke) * across - n);
}

/// Command along the force or the nearest direction beside it that leads into no wall.
std::optional<Command> PotentialFieldNavigator::clear_of_walls(const Map& map, const Pose2& pose,
                                                               Vec2 force) const {
  constexpr int max_aside = 5;
  constexpr double step_aside = pi / 10;
  const double turn_rate = swarm().max_turn_rate;
  const double r = std::min(swarm().radius, (1 - 1e-9) * map.clearance(pose.position));
  const double commanded = speed() * std::min(1.0, norm(force));
  for (int k = 0; k <= 2 * max_aside; ++k) {
    const int steps = k % 2 == 0 ? -k / 2 : (k + 1) / 2;
    const double aside = steps * step_aside;
    Command command{wrap(heading_along(force) + aside), commanded};
    const double turn = std::isinf(turn_rate) ? 0 : wrap(command.heading - pose.heading);
    if (std::abs(turn) > pi / 2) command.speed *= 0.5;
    const Pose2 next = unicycle_step(pose, command, turn_rate, params_.tuning.command_time / 2);
    const Pose2 last = unicycle_step(next, command, turn_rate, params_.tuning.command_time / 2);
    if (map.is_free(Segment{pose.position, next.position}, r) &&
        map.is_free(Segment{next.position, last.position}, r))
      return command;
  }
  return std::nullopt;
}

}  // namespace microswarm::navigation

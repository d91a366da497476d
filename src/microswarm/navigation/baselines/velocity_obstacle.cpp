// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/baselines/velocity_obstacle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::navigation {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double choice_rounding = 1e-9;
constexpr int turning_pieces = 4;

/// Time in [0, t] at which a point at `d` from a disc's centre, moving with `v`, meets its rim,
/// which starts at `reach` and grows: the smallest root of |d + v t| = reach + growth t.
double rim_contact(Vec2 d, Vec2 v, double reach, double growth, double t) {
  const double c = squared_norm(d) - reach * reach;
  if (c <= 0) return 0;
  const double a = squared_norm(v) - growth * growth;
  const double b = dot(d, v) - reach * growth;  // half of the linear term
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return never;
  const double root = c / (-b + std::sqrt(discriminant));
  return root >= 0 && root <= t ? root : never;
}

/// Calls visit(way, t0, t1) for the straight segments of the path over the next `time` seconds,
/// including the turn, until one call returns false. Returns whether none did.
template <class Visit>
bool along_trajectory(Pose2 pose, const Command& command, double turn_rate, double time,
                      Visit&& visit) {
  double t = 0;
  const double turn = std::abs(wrap(command.heading - pose.heading));
  if (command.speed > 0 && std::isfinite(turn_rate) && turn > choice_rounding) {
    const double piece = std::min(time, turn / turn_rate) / turning_pieces;
    for (int k = 0; k < turning_pieces; ++k, t += piece) {
      const Pose2 next = unicycle_step(pose, command, turn_rate, piece);
      if (!visit(Segment{pose.position, next.position}, t, t + piece)) return false;
      pose = next;
    }
  }
  const Vec2 move = std::max(0.0, time - t) * command.speed * unit_vector(command.heading);
  return visit(Segment{pose.position, pose.position + move}, t, time);
}

}  // namespace

VelocityObstacleNavigator::VelocityObstacleNavigator(const VelocityObstacleParams& params,
                                                     const Task& task, Rng)
    : SteeringNavigator(task, params.speed),
      params_(params),
      guide_(params.guide, goal(), params.tuning.route_reach),
      tracker_(params.tracker) {
  rank_choices();
}

void VelocityObstacleNavigator::rank_choices() {
  const Vec2 preferred{speed(), 0};
  choices_.push_back({0, 0, speed()});
  for (int s = params_.speeds; s > 0; --s)
    for (int k = 0; k < params_.directions; ++k) {
      const double turn = wrap(2 * pi * k / params_.directions);
      const double share = speed() * s / params_.speeds;
      choices_.push_back({turn, share, distance(share * unit_vector(turn), preferred)});
    }
  std::stable_sort(choices_.begin(), choices_.end(),
                   [](const Choice& a, const Choice& b) { return a.off < b.off; });
}

void VelocityObstacleNavigator::prepare(const Snapshot& world, const Stop&) {
  const double radius = swarm().radius;
  choose_aim(world, radius, radius + params_.gap);
  guide_.prepare(world.shared_map(), aim().position, radius + params_.gap, radius);
}

void VelocityObstacleNavigator::update(const Observation& seen, const Stop& stop) {
  guide_.stop_with(stop);
  tracker_.update(seen);
}

Decision VelocityObstacleNavigator::decide(const Moment& moment) {
  const Map& map = moment.map();
  const Pose2& pose = moment.pose;
  const Vec2 target = guide_.target(map, pose.position);
  step_view().local_target = target;
  find_threats(moment.world(), pose.position);
  const double preferred = heading_along(target - pose.position);
  Command best{pose.heading, 0};
  double min_penalty = never;
  for (const Choice& choice : choices_) {
    const Command command{wrap(preferred + choice.turn), choice.speed};
    if (!clear_of_walls(map, pose, command)) continue;
    const double time = time_to_contact(pose, command);
    if (time >= params_.horizon) {
      if (choice.speed == 0) return hold();
      return {command, choice.off == 0 ? NavigatorState::follow : NavigatorState::avoid};
    }
    const double penalty = choice.off + params_.urgency / std::max(time, choice_rounding);
    if (penalty >= min_penalty) continue;
    min_penalty = penalty;
    best = command;
  }
  if (best.speed == 0) return hold();
  return {best, NavigatorState::escape};
}

/// Collects the bodies that can be met within the horizon. The swarm may move away from a body
/// already nearer than the gap, but not approach it.
void VelocityObstacleNavigator::find_threats(const Snapshot& world, Vec2 p) {
  threats_.clear();
  const auto bodies = world.moving().bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const TrackedBody motion = tracker_.body(i);
    const bool round = is_disc(bodies[i]);
    const double growth = outward_speed(bodies[i], motion);
    const Vec2 at = p - delay() * motion.velocity;
    const double away = distance(at, bodies[i]);
    const double wanted = swarm().radius + params_.gap +
                          growth * (delay() + (round ? 0 : params_.tuning.growth_time));
    const double top = speed() + norm(motion.velocity) + growth;
    if (away - wanted > top * params_.horizon) continue;
    threats_.push_back({.body = &bodies[i],
                        .velocity = motion.velocity,
                        .reach = std::min(wanted, (1 - choice_rounding) * away),
                        .growth = round ? growth : 0});
  }
}

bool VelocityObstacleNavigator::clear_of_walls(const Map& map, const Pose2& pose,
                                               const Command& command) const {
  if (command.speed == 0) return true;
  const double reach = params_.wall_horizon * command.speed;
  const double wanted = swarm().radius + params_.gap;
  const double r = std::min(wall_clearance(wanted, pose.position, reach),
                            (1 - choice_rounding) * map.clearance(pose.position));
  const double time =
      std::min(params_.wall_horizon, distance(pose.position, aim().position) / command.speed);
  return along_trajectory(pose, command, swarm().max_turn_rate, time,
                          [&](Segment leg, double, double) { return map.is_free(leg, r); });
}

/// Time until the command leads into a body; infinity if not within the horizon.
double VelocityObstacleNavigator::time_to_contact(const Pose2& pose, const Command& command) const {
  double first = never;
  along_trajectory(pose, command, swarm().max_turn_rate, params_.horizon,
                   [&](Segment leg, double t0, double t1) {
                     for (const Threat& threat : threats_)
                       first = std::min(first, time_to_contact(threat, leg, t0, t1));
                     return first == never;
                   });
  return first;
}

double VelocityObstacleNavigator::time_to_contact(const Threat& threat, Segment leg, double t0,
                                                  double t1) const {
  const Segment own_frame{leg.a - (delay() + t0) * threat.velocity,
                          leg.b - (delay() + t1) * threat.velocity};
  const auto with_disc = [&](const Disc& disc) {
    if (t1 <= t0) return never;
    const Vec2 velocity = (1 / (t1 - t0)) * (own_frame.b - own_frame.a);
    const double reach = disc.radius + threat.reach + threat.growth * t0;
    return t0 + rim_contact(own_frame.a - disc.centre, velocity, reach, threat.growth, t1 - t0);
  };
  const auto with_polygon = [&](const Polygon& polygon) {
    const double share = first_contact(own_frame, threat.reach, polygon);
    return share <= 1 ? t0 + share * (t1 - t0) : never;
  };
  return std::visit(Overloaded{with_disc, with_polygon}, threat.body->shape);
}

}  // namespace microswarm::navigation

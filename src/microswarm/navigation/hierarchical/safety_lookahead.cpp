// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical/safety_lookahead.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/swarm/body/unicycle.hpp"

namespace microswarm::navigation {

SafetyLookahead::SafetyLookahead(const HierarchicalParams& params, const SwarmLimits& swarm)
    : params_(params), radius_(swarm.radius), max_turn_rate_(swarm.max_turn_rate) {
  // Deviation of a tick's arc from its chord; 0 for a swarm that turns at once.
  if (std::isfinite(max_turn_rate_))
    slack_ = std::max(1.0, params_.speed * max_turn_rate_ * params_.tuning.check_step *
                               params_.tuning.check_step / 8);
}

// Clearance from walls, increased where it hardly exceeds the swarm's radius, so that motion within
// a tick causes no contact. Reduced if the swarm, or the aim on the next `reach` µm, has less.
double SafetyLookahead::wall_floor(const Start& start, double reach) const {
  const double wanted = radius_ + slack_;
  if (params_.clearance >= wanted) return params_.clearance;
  const Vec2 p = start.pose.position;
  const double near_aim = start.aim.wall_clearance(params_.clearance, wanted, p, reach);
  return std::max(params_.clearance, std::min(near_aim, start.world.map().clearance(p)));
}

// Predicted motion of the swarm once the command takes effect, relative to the predicted obstacles:
// visits its moves and the times since the frame at which they begin, as long as `visit` returns
// true.
template <class Visit>
void SafetyLookahead::roll_out(const Start& start, const Steering& steer, Visit&& visit) const {
  const double begin = params_.horizon > 0 ? start.delay : 0;
  const int ticks =
      std::max(1, static_cast<int>(std::lround(params_.horizon / params_.tuning.check_step)));
  Pose2 pose = start.pose;
  Command command;
  double next_command = 0;
  for (int k = 0; k < ticks; ++k) {
    if (k * params_.tuning.check_step >= next_command - 1e-9) {
      command = steer(pose, k * params_.tuning.check_step);
      next_command += period_;
    }
    const Pose2 next = predict_unicycle(pose, command, max_turn_rate_, params_.tuning.check_step);
    if (!visit(Segment{pose.position, next.position}, begin + k * params_.tuning.check_step))
      return;
    pose = next;
  }
}

// Distance to the moving obstacles, which is only known up to `enough`.
double SafetyLookahead::from_obstacles(const Start& start, Segment move, double from,
                                       double enough) const {
  return start.obstacles.clearance(start.world, move, from, from + params_.tuning.check_step,
                                   enough);
}

// Among obstacles at rest, one distance to them answers for all moves nearby.
bool SafetyLookahead::is_safe(const Start& start, const Steering& steer,
                              std::optional<double> wanted) const {
  const Map& map = start.world.map();
  const double from_walls = wanted ? *wanted : wall_floor(start, far_enough());
  const double least = params_.clearance + slack_;
  const double enough = std::min(far_enough(), least + 1);  // 1 µm more than what is asked for
  const double end = start.delay + params_.horizon + params_.tuning.check_step;
  const bool all_rest = start.obstacles.all_rest() && least <= far_enough();
  constexpr double rounding = 1e-6;
  Disc free;  // for all times
  const auto is_near = [&](Vec2 p) { return distance(p, free.centre) + rounding < free.radius; };
  bool safe = true;
  roll_out(start, steer, [&](Segment move, double from) {
    if (all_rest && !is_near(move.b)) {
      const double most = least + params_.speed * params_.horizon;
      free = {move.a,
              start.obstacles.clearance(start.world, {move.a, move.a}, from, end, most) - least};
    }
    const bool far = all_rest && is_near(move.a) && is_near(move.b);
    safe = (far || from_obstacles(start, move, from, enough) >= least) &&
           map.is_free(move, from_walls);
    return safe;
  });
  return safe;
}

// Clearance of a manoeuvre; ends early when that falls below `floor`.
SafetyLookahead::Rollout SafetyLookahead::look_ahead(const Start& start, double floor,
                                                     const Steering& steer) const {
  const Map& map = start.world.map();
  const double enough = far_enough();
  Rollout out{.least = enough, .last = enough};
  roll_out(start, steer, [&](Segment move, double from) {
    const double moving = from_obstacles(start, move, from, enough);
    // The whole move is tested, so that a path through a wall is never the best one.
    out.last = map.is_free(move, 0) ? std::min(moving, map.clearance(move.b)) : 0;
    out.least = std::min(out.least, out.last);
    return out.least >= floor;
  });
  return out;
}

Command SafetyLookahead::escape(const Start& start) const {
  constexpr int directions = 16;
  const double goal_heading = heading_along(start.aim.position - start.pose.position);
  Command best{start.pose.heading, 0};
  double best_score = -1;
  double best_clearance = 0;
  const auto consider = [&](const Command& first, const Command& second) {
    const auto steer = [&](const Pose2&, double t) {
      return t < params_.tuning.first_leg ? first : second;
    };
    const double floor = best_score - params_.tuning.final_weight * far_enough();
    const Rollout o = look_ahead(start, floor, std::ref(steer));
    const double score = o.least + params_.tuning.final_weight * o.last;
    if (score <= best_score + 1e-9) return;
    best_score = score;
    best_clearance = o.least;
    best = first;
  };
  const auto leg = [&](int k, double ease = 1) {
    return Command{wrap(goal_heading + 2 * pi * k / directions), ease * params_.speed};
  };
  consider(best, best);
  for (int i = 0; i < directions; ++i) consider(leg(i), leg(i));
  if (best_clearance < params_.clearance + slack_)  // a slow turn comes less near
    for (int i = 0; i < directions; ++i)
      for (const double ease : {0.25, 0.1}) consider(leg(i, ease), leg(i));
  if (best_clearance < params_.clearance + slack_)
    for (int i = 0; i < directions; ++i)
      for (int j = 0; j < directions; ++j)
        if (i != j) consider(leg(i), leg(j));
  return best;
}

}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/hierarchical.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/core/angles.hpp"
#include "microswarm/navigation/forecast.hpp"
#include "microswarm/navigation/helm.hpp"
#include "microswarm/swarm/unicycle.hpp"

namespace microswarm {
namespace {

constexpr double escape_tick = 0.1;  // of the look-ahead [s]
constexpr double first_leg = 1.0;    // of an escape [s]
constexpr double last_weight = 0.1;  // of the clearance at an escape's end beside the least one
constexpr std::array<double, 3> eases{1.0, 0.5, 0.25};

}  // namespace

HierarchicalNavigator::HierarchicalNavigator(const HierarchicalParams& params,
                                             const SwarmLimits& swarm, Vec2 goal,
                                             double goal_tolerance, Rng rng)
    : params_(params),
      swarm_(swarm),
      goal_(goal),
      goal_tolerance_(goal_tolerance),
      rng_(rng),
      forecast_(swarm),
      follower_(params.follower, swarm) {
  params_.speed = std::min(params.speed, swarm.max_speed);
  // How far the arc of a tick is from its chord; a swarm that turns at once makes none.
  if (std::isfinite(swarm.max_turn_rate))
    slack_ = std::max(1.0, params_.speed * swarm.max_turn_rate * escape_tick * escape_tick / 8);
}

void HierarchicalNavigator::prepare(const Snapshot& world) {
  if (params_.guide == Guide::route)
    route_ = Route(world.map(), goal_, params_.margin, params_.route_cell);
}

Command HierarchicalNavigator::step(const Observation& seen, const Stop& stop) {
  view_ = {};
  Command command = decide(seen, stop);
  view_.local_target = target_;
  view_.path = path_;
  view_.plan = plan_ ? &*plan_ : nullptr;
  return command;
}

Command HierarchicalNavigator::issue(double now, Command command, std::string_view state) {
  view_.state = state;
  if (issued_at_) period_ = std::clamp(now - *issued_at_, escape_tick, 1.0);
  issued_at_ = now;
  forecast_.note(now, command);
  return command;
}

// Algorithm 4 [drrt], one pass of its loop
Command HierarchicalNavigator::decide(const Observation& seen, const Stop& stop) {
  if (!sees_swarm(seen, params_.frame_timeout)) return issue(seen.now, {}, "blind");
  follower_.see(seen, forecast_);
  pose_ = forecast_.at_effect(seen);
  const Command hold{pose_.heading, 0};
  if (distance(pose_.position, goal_) <= goal_tolerance_) {  // line 2
    path_.clear();
    return issue(seen.now, hold, "arrived");
  }

  const Snapshot& now = *seen.world;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const bool near_end = path_.size() > 1 && target_ && !(*target_ == goal_) &&
                          way_left(path_, place_) < std::max(params_.lookahead, 2 * swarm_.radius);
    if (attempt > 0 || near_end || !path_holds(now)) {  // line 4
      const Snapshot ahead = drawn_out(now, std::min(params_.horizon, 1.5), params_.margin);
      replan(now, ahead, stop);  // lines 5–11
    }
    if (path_.size() < 2) break;
    for (const double ease : eases)
      if (const double speed = ease * params_.speed; look_along_path(seen, speed).safe) {
        const auto next = follower_.command(path_, place_, pose_, lookahead_at(speed), speed);
        return issue(seen.now, next.command, next.handed_over ? "fallback" : "follow");
      }
  }
  if (look_ahead(seen, params_.margin, [&](const Pose2&, double) { return hold; }).safe)
    return issue(seen.now, hold, "hold");
  return escape(seen);
}

// Path Safety, P_clt Unsafe: the rest of the path against what is seen now.
bool HierarchicalNavigator::path_holds(const Snapshot& world) const {
  if (path_.size() < 2) return false;
  std::vector<Vec2> rest{point_ahead(path_, place_, 0)};
  rest.insert(rest.end(), path_.begin() + static_cast<std::ptrdiff_t>(place_.piece) + 1,
              path_.end());
  return world.is_free(rest, std::min(params_.margin, path_clearance_));
}

void HierarchicalNavigator::replan(const Snapshot& seen, const Snapshot& ahead, const Stop& stop) {
  path_.clear();
  place_ = {};
  const double here = seen.clearance(pose_.position);
  const double wanted = params_.margin + params_.extra_margin;
  if (here < params_.margin) {
    target_.reset();
    return;
  }
  for (const double clearance : {wanted, params_.margin}) {
    if (clearance > here) continue;
    if (replan_with(ahead, clearance, stop) || replan_with(seen, clearance, stop)) return;
  }
  target_.reset();
}

bool HierarchicalNavigator::replan_with(const Snapshot& world, double clearance, const Stop& stop) {
  const Vec2 from = pose_.position;
  if (!world.is_free(from, clearance)) return false;
  view_.planned = true;
  Vec2 towards = goal_;
  if (params_.guide == Guide::route) {
    const Vec2 via =
        route_.ahead(world.map(), from, 1.5 * params_.target.base_distance, params_.margin);
    if (!(via == from)) towards = via;
  }
  const double goal_distance = distance(from, goal_);
  std::optional<Vec2> target;
  if (goal_distance <= params_.target.base_distance &&
      world.is_free(Segment{from, goal_}, clearance)) {
    target = goal_;                                    // line 9
  } else if (const auto chosen = select_local_target(  // line 7
                 world,
                 {.swarm = pose_,
                  .goal_heading = heading_of(towards - from),
                  .goal_distance = goal_distance,
                  .previous_target = target_,
                  .clearance = clearance,
                  .least_distance = swarm_.radius},
                 params_.target)) {
    target = chosen->position;
  }
  if (!target) return false;
  DrrtStarParams local = params_.planner;
  local.clearance = clearance;
  local.goal_tolerance =
      std::min({local.goal_tolerance, goal_tolerance_, 0.25 * distance(from, *target)});
  plan_ = plan(world, pose_, *target, local, rng_, stop);  // line 11
  // The straight way there is free, target selection has checked it.
  path_ = plan_->status == Status::solved ? plan_->path : std::vector<Vec2>{from, *target};
  path_clearance_ = clearance;
  target_ = target;
  return true;
}

// Where the swarm goes once the command takes effect, against where the obstacles go.
template <class Steer>
HierarchicalNavigator::Outlook HierarchicalNavigator::look_ahead(const Observation& seen,
                                                                 double floor,
                                                                 Steer&& steer) const {
  const double enough = far_enough();
  const double delay = params_.horizon > 0 ? seen.age() + swarm_.response_lag : 0;
  const int ticks = std::max(1, static_cast<int>(std::lround(params_.horizon / escape_tick)));
  const Map& map = seen.world->map();
  Pose2 pose = pose_;
  Outlook out{.safe = true, .least = enough, .last = enough};
  Command command;
  double next_command = 0;
  for (int k = 0; k < ticks; ++k) {
    if (k * escape_tick >= next_command - 1e-9) {
      command = steer(pose, k * escape_tick);
      next_command += period_;
    }
    const Pose2 next = unicycle_step(pose, command, swarm_.max_turn_rate, escape_tick);
    const Segment move{pose.position, next.position};
    const double from = delay + k * escape_tick;
    const double moving = forecast_clearance(*seen.world, move, from, from + escape_tick, enough);
    out.safe = out.safe && moving >= params_.margin + slack_ && map.is_free(move, params_.margin);
    // The whole move counts, so that no way through a wall is ever the best one.
    out.last = map.is_free(move, 0) ? std::min(moving, map.clearance(next.position)) : 0;
    out.least = std::min(out.least, out.last);
    pose = next;
    if (out.least < floor) break;
  }
  return out;
}

HierarchicalNavigator::Outlook HierarchicalNavigator::look_along_path(const Observation& seen,
                                                                      double speed) const {
  PathPlace place = place_;
  const double lookahead = lookahead_at(speed);
  return look_ahead(seen, params_.margin, [&](const Pose2& pose, double) {
    const Command command = follower_.command(path_, place, pose, lookahead, speed).command;
    return way_left(path_, place) < 1 ? Command{pose.heading, 0} : command;
  });
}

// Of the hold and the ways of one leg, or two where one will not do, the one that keeps the most
// distance.
Command HierarchicalNavigator::escape(const Observation& seen) {
  constexpr int directions = 16;
  const double goal_heading = heading_of(goal_ - pose_.position);
  Command best{pose_.heading, 0};
  double best_score = -1;
  double best_least = 0;
  const auto consider = [&](const Command& first, const Command& second) {
    const Outlook o =
        look_ahead(seen, best_score - last_weight * far_enough(),
                   [&](const Pose2&, double t) { return t < first_leg ? first : second; });
    const double score = o.least + last_weight * o.last;
    if (score <= best_score + 1e-9) return;
    best_score = score;
    best_least = o.least;
    best = first;
  };
  const auto leg = [&](int k) {
    return Command{wrap(goal_heading + 2 * pi * k / directions), params_.speed};
  };
  consider(best, best);
  for (int i = 0; i < directions; ++i) consider(leg(i), leg(i));
  if (best_least < params_.margin + slack_)
    for (int i = 0; i < directions; ++i)
      for (int j = 0; j < directions; ++j)
        if (i != j) consider(leg(i), leg(j));
  path_.clear();
  return issue(seen.now, best, best.speed > 0 ? "escape" : "hold");
}

}  // namespace microswarm

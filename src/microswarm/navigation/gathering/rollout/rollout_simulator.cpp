// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm {
namespace {

AggregationParams with(AggregationParams params, Aggregation method) {
  params.method = method;
  return params;
}

Robots one_of(const Robots& robots, std::size_t i) {
  return {robots.origin, {robots.x[i]}, {robots.y[i]}};
}

}  // namespace

RolloutSimulator::RolloutSimulator(const AggregationMap& map, const RobotStepper& stepper,
                                   const AggregationParams& params)
    : map_(&map), stepper_(&stepper), params_(params), routes_(&map.routes()) {}

void RolloutSimulator::move(PartialPlan& partial, Vec2 move) {
  if (partial.steps() % RolloutPlan::checkpoint_interval == 0) {
    partial.merged.merge_coincident();
    if (partial.keeps_checkpoints) partial.checkpoints.push_back(partial.merged);
  }
  stepper_->step(partial.merged.places(), move, ContactRule::stop);
  partial.moves.push_back(move);
  work_ +=
      static_cast<double>(partial.merged.places().size()) + params_.rollout.tuning.step_overhead;
}

void RolloutSimulator::follow(PartialPlan& partial, std::span<const Vec2> moves, std::size_t most) {
  for (const Vec2 m : moves) {
    if (partial.steps() >= most) return;
    move(partial, m);
  }
}

void RolloutSimulator::lead(PartialPlan& partial, std::size_t place, std::size_t steps,
                            std::size_t most) {
  AggregationParams alone = with(params_, Aggregation::heuristic);
  alone.sigma = 2 * params_.step;
  AggregationPolicy policy(*map_, alone);
  Robots leader = one_of(partial.merged.places(), place);
  for (std::size_t i = 0; i < steps && partial.steps() < most; ++i) {
    const std::optional<Vec2> next = policy.next(leader);
    if (!next) return;
    stepper_->step(leader, *next, ContactRule::stop);
    move(partial, *next);
  }
}

bool RolloutSimulator::finish(PartialPlan& partial, Aggregation method, std::size_t most) {
  return pursue(partial, method, most, true);
}

bool RolloutSimulator::pursue(PartialPlan& partial, Aggregation method, std::size_t most,
                              bool to_the_end) {
  AggregationPolicy policy(*map_, with(params_, method));
  for (;;) {
    if (partial.steps() % RolloutPlan::checkpoint_interval == 0)
      policy.remap(partial.merged.merge_coincident());
    const std::optional<Vec2> next = policy.next(partial.merged.places(), partial.merged.counts());
    if (!next) return true;
    // The mean path length decreases by at most one step per move.
    const double least = to_the_end ? (policy.mean_distance() - params_.sigma) / params_.step : 0;
    if (static_cast<double>(partial.steps()) + least >= static_cast<double>(most)) return false;
    move(partial, *next);
  }
}

std::vector<Vec2> RolloutSimulator::look_ahead(const MergedRobots& merged, Rng& rng) {
  const RolloutParams& p = params_.rollout;
  const auto horizon = static_cast<std::size_t>(p.horizon);
  MergedRobots some = merged;
  some.coarsen(static_cast<std::size_t>(p.lookahead_representatives),
               p.tuning.finest_cell * params_.step);
  std::vector<Vec2> best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = -2; k < p.candidates; ++k) {
    PartialPlan partial{some};
    if (k >= 0) lead(partial, rng.below(some.places().size()), horizon, horizon);
    const Aggregation base = k == -2 ? Aggregation::divide_and_conquer : Aggregation::heuristic;
    const bool ends = pursue(partial, base, horizon, false);
    // A plan that gathers all beats everything else; the shortest one is best.
    const double left =
        ends ? static_cast<double>(partial.steps()) - 1e9 : left_to_do(partial.merged);
    if (left >= least) continue;
    least = left;
    if (!ends) partial.moves.resize(std::min(horizon, static_cast<std::size_t>(p.commit)));
    best = std::move(partial.moves);
  }
  return best;
}

double RolloutSimulator::way(const Robots& robots, std::size_t i) const {
  return map_->tree.length(*routes_, robots.position(i));
}

double RolloutSimulator::mean_distance(const MergedRobots& merged) const {
  double sum = 0;
  double robots = 0;
  for (std::size_t i = 0; i < merged.places().size(); ++i) {
    sum += merged.counts()[i] * way(merged.places(), i);
    robots += merged.counts()[i];
  }
  return sum / std::max(1.0, robots);
}

/// Positions count more than the robots at them, since robots at one position are led together. Far
/// positions count more than near ones. The exponents gave the shortest plans on three maps.
double RolloutSimulator::left_to_do(MergedRobots merged) const {
  const RolloutTuning& tuning = params_.rollout.tuning;
  merged.merge_coincident(tuning.merge_cell * params_.step);
  double sum = 0;
  for (std::size_t i = 0; i < merged.places().size(); ++i) {
    const double far = way(merged.places(), i);
    sum += maths::pow(merged.counts()[i], tuning.robots_exponent) * far * far;
  }
  return sum;
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::navigation {
namespace {

AggregationParams with(AggregationParams params, Aggregation method) {
  params.method = method;
  return params;
}

Robots single_robot(const Robots& robots, std::size_t i) {
  return {robots.origin, {robots.x[i]}, {robots.y[i]}};
}

}  // namespace

/// Work of one simulation, added to that of all at its end.
class RolloutSimulator::Work {
 public:
  explicit Work(RolloutSimulator& simulator) : all_(simulator.work_) {}
  ~Work() { all_.fetch_add(work_, std::memory_order_relaxed); }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;
  void add(std::uint64_t work) { work_ += work; }

 private:
  std::atomic<std::uint64_t>& all_;
  std::uint64_t work_ = 0;
};

RolloutSimulator::RolloutSimulator(const AggregationMap& map, const CommonInput& input,
                                   const AggregationParams& params)
    : map_(&map), input_(input), params_(params), threads_(params.rollout.threads) {
  constexpr std::size_t tabled = 2048;
  for (std::size_t c = 0; c < tabled; ++c)
    powers_.push_back(maths::pow(static_cast<double>(c), params.rollout.tuning.robots_exponent));
}

double RolloutSimulator::power(std::uint32_t count) const {
  return count < powers_.size() ? powers_[count]
                                : maths::pow(count, params_.rollout.tuning.robots_exponent);
}

void RolloutSimulator::try_each(std::size_t count, const std::function<void(std::size_t)>& trial) {
  threads_.for_each_index(count, trial);
}

void RolloutSimulator::move(PartialPlan& partial, Vec2 move, Work& work) const {
  if (partial.steps() % RolloutPlan::checkpoint_interval == 0) {
    partial.merged.merge_coincident();
    if (partial.keeps_checkpoints) partial.checkpoints.push_back(partial.merged);
  }
  input_.step(partial.merged.positions(), move);
  partial.moves.push_back(move);
  work.add(partial.merged.positions().size() +
           static_cast<std::uint64_t>(params_.rollout.tuning.step_overhead));
}

void RolloutSimulator::follow(PartialPlan& partial, std::span<const Vec2> moves, std::size_t most) {
  Work work(*this);
  for (const Vec2 m : moves) {
    if (partial.steps() >= most) return;
    move(partial, m, work);
  }
}

// The distance left decreases by at most one step per move.
void RolloutSimulator::follow_until_gathered(PartialPlan& partial, std::span<const Vec2> moves,
                                             std::size_t most) {
  Work work(*this);
  std::size_t unmeasured = 0;
  for (const Vec2 m : moves) {
    if (partial.steps() >= most) return;
    if (unmeasured == 0) {
      const double left = distance_left(partial.merged) - params_.sigma;
      if (left < 0) return;
      unmeasured = static_cast<std::size_t>(std::min(left / params_.step, 1e6));
    } else {
      --unmeasured;
    }
    move(partial, m, work);
  }
}

void RolloutSimulator::lead(PartialPlan& partial, std::size_t position, std::size_t steps,
                            std::size_t most) {
  AggregationParams alone = with(params_, Aggregation::heuristic);
  alone.sigma = 2 * params_.step;
  AggregationPolicy policy(*map_, alone);
  Work work(*this);
  Robots leader = single_robot(partial.merged.positions(), position);
  for (std::size_t i = 0; i < steps && partial.steps() < most; ++i) {
    const std::optional<Vec2> next = policy.next(leader);
    if (!next) return;
    input_.step(leader, *next);
    move(partial, *next, work);
  }
}

AggregationPolicy RolloutSimulator::policy(Aggregation method) const {
  return {*map_, with(params_, method)};
}

bool RolloutSimulator::finish(PartialPlan& partial, Aggregation method, std::size_t most) {
  constexpr auto never = std::numeric_limits<std::size_t>::max();
  AggregationPolicy base = policy(method);
  return pursue(partial, base, most, never) == Pursuit::gathered;
}

RolloutSimulator::Pursuit RolloutSimulator::pursue(PartialPlan& partial, AggregationPolicy& policy,
                                                   std::size_t most, std::size_t pause) {
  Work work(*this);
  while (partial.steps() < pause) {
    if (partial.steps() % RolloutPlan::checkpoint_interval == 0)
      policy.remap(partial.merged.merge_coincident());
    const std::optional<Vec2> next =
        policy.next(partial.merged.positions(), partial.merged.counts());
    if (!next) return Pursuit::gathered;
    // Neither the mean nor the longest path decreases by more than one step per move.
    const double least = (policy.distance_left() - params_.sigma) / params_.step;
    if (static_cast<double>(partial.steps()) + least >= static_cast<double>(most))
      return Pursuit::too_long;
    move(partial, *next, work);
  }
  return Pursuit::paused;
}

void RolloutSimulator::try_moves(PartialPlan& partial, bool first, std::size_t most, Rng& rng) {
  const RolloutParams& p = params_.rollout;
  partial.keeps_checkpoints = true;
  const auto longest = static_cast<std::size_t>(p.horizon);
  const std::size_t shortest = std::min(static_cast<std::size_t>(p.tuning.min_trial), longest);
  const std::size_t length = shortest + rng.below(longest - shortest + 1);
  const std::size_t end = std::min(most, partial.steps() + length);
  const bool one_direction = rng.uniform() < p.tuning.direction_share;
  const std::size_t position = rng.below(partial.merged.positions().size());
  const double angle = 0.25 * pi * static_cast<double>(rng.below(8));
  if (first)
    lead(partial, farthest(partial.merged.positions()), length, end);
  else if (one_direction)
    follow(partial, std::vector<Vec2>(length, params_.step * unit_vector(angle)), end);
  else
    lead(partial, position, length, end);
}

MergedRobots RolloutSimulator::representatives(const MergedRobots& merged) const {
  MergedRobots some = merged;
  some.coarsen(static_cast<std::size_t>(params_.rollout.lookahead_representatives),
               params_.rollout.tuning.finest_cell * params_.step);
  return some.condensed();
}

std::size_t RolloutSimulator::farthest(const Robots& robots) const {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const double far = remaining(robots, i);
    if (far <= most) continue;
    most = far;
    best = i;
  }
  return best;
}

double RolloutSimulator::remaining(const Robots& robots, std::size_t i) const {
  const Vec2 p = robots.position(i);
  return map_->length_from(p, map_->tree.nearest(p));
}

double RolloutSimulator::mean_distance(const MergedRobots& merged) const {
  double sum = 0;
  double robots = 0;
  for (std::size_t i = 0; i < merged.positions().size(); ++i) {
    sum += merged.counts()[i] * remaining(merged.positions(), i);
    robots += merged.counts()[i];
  }
  return sum / std::max(1.0, robots);
}

double RolloutSimulator::distance_left(const MergedRobots& merged) const {
  if (params_.gathered == Gathered::mean) return mean_distance(merged);
  double most = 0;
  for (std::size_t i = 0; i < merged.positions().size(); ++i)
    most = std::max(most, remaining(merged.positions(), i));
  return most;
}

/// Positions count more than the robots at them, since robots at one position are led together. Far
/// positions count more than near ones. The exponents gave the shortest plans on three maps.
double RolloutSimulator::left_to_do(MergedRobots merged) const {
  const RolloutTuning& tuning = params_.rollout.tuning;
  merged.merge_coincident(tuning.merge_cell * params_.step);
  double sum = 0;
  for (std::size_t i = 0; i < merged.positions().size(); ++i) {
    const double far = remaining(merged.positions(), i);
    sum += power(merged.counts()[i]) * far * far;
  }
  return sum;
}

}  // namespace microswarm::navigation

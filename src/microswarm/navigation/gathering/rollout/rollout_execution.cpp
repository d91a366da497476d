// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_execution.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace microswarm::navigation {

void RolloutExecution::start(const Robots& robots, RolloutPlan&& plan) {
  plan_ = std::move(plan);
  done_ = 0;
  expected_ = MergedRobots(robots);
}

Vec2 RolloutExecution::advance(const CommonInput& input) {
  const Vec2 move = plan_.moves[done_++];
  if (done_ % RolloutPlan::checkpoint_interval == 0) expected_.merge_coincident();
  input.step(expected_.positions(), move);
  return move;
}

bool RolloutExecution::shorten(PartialPlan&& partial) {
  if (partial.steps() >= steps()) return false;
  plan_.moves.resize(partial.from);
  plan_.moves.insert(plan_.moves.end(), partial.moves.begin(), partial.moves.end());
  const auto kept = static_cast<std::ptrdiff_t>(partial.from / RolloutPlan::checkpoint_interval);
  plan_.checkpoints.erase(plan_.checkpoints.begin() + kept, plan_.checkpoints.end());
  std::move(partial.checkpoints.begin(), partial.checkpoints.end(),
            std::back_inserter(plan_.checkpoints));
  return true;
}

double RolloutExecution::deviation(const Robots& robots) const {
  double sum = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const PointF p = expected_.position(i);
    sum += distance(Vec2{robots.x[i], robots.y[i]}, Vec2{p.x, p.y});
  }
  return sum;
}

}  // namespace microswarm::navigation

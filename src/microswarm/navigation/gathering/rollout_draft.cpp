// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout_draft.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "microswarm/core/maths.hpp"

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

RolloutSimulator::RolloutSimulator(const AggregationMap& ground, const RobotStepper& stepper,
                                   const AggregationParams& params)
    : ground_(&ground), stepper_(&stepper), params_(params), routes_(&ground.routes()) {}

void RolloutSimulator::move(RolloutDraft& draft, Vec2 move) {
  constexpr double rest_of_a_step = 20;
  if (draft.steps() % RolloutPlan::mark_interval == 0) {
    draft.crowd.join();
    if (draft.keeps_marks) draft.marks.push_back(draft.crowd);
  }
  stepper_->step(draft.crowd.places(), move, ContactRule::stop);
  draft.moves.push_back(move);
  work_ += static_cast<double>(draft.crowd.places().size()) + rest_of_a_step;
}

void RolloutSimulator::follow(RolloutDraft& draft, std::span<const Vec2> moves, std::size_t most) {
  for (const Vec2 m : moves) {
    if (draft.steps() >= most) return;
    move(draft, m);
  }
}

void RolloutSimulator::lead(RolloutDraft& draft, std::size_t place, std::size_t steps,
                            std::size_t most) {
  AggregationParams alone = with(params_, Aggregation::heuristic);
  alone.sigma = 2 * params_.step;
  Gatherer gatherer(*ground_, alone);
  Robots leader = one_of(draft.crowd.places(), place);
  for (std::size_t i = 0; i < steps && draft.steps() < most; ++i) {
    const std::optional<Vec2> next = gatherer.next(leader);
    if (!next) return;
    stepper_->step(leader, *next, ContactRule::stop);
    move(draft, *next);
  }
}

bool RolloutSimulator::finish(RolloutDraft& draft, Aggregation method, std::size_t most) {
  return pursue(draft, method, most, true);
}

bool RolloutSimulator::pursue(RolloutDraft& draft, Aggregation method, std::size_t most,
                              bool to_the_end) {
  Gatherer gatherer(*ground_, with(params_, method));
  for (;;) {
    if (draft.steps() % RolloutPlan::mark_interval == 0) gatherer.joined(draft.crowd.join());
    const std::optional<Vec2> next = gatherer.next(draft.crowd.places(), draft.crowd.counts());
    if (!next) return true;
    // The mean way shrinks by a step a move at best.
    const double least = to_the_end ? (gatherer.mean_way() - params_.sigma) / params_.step : 0;
    if (static_cast<double>(draft.steps()) + least >= static_cast<double>(most)) return false;
    move(draft, *next);
  }
}

std::vector<Vec2> RolloutSimulator::look_ahead(const Crowd& crowd, Rng& rng) {
  const RolloutParams& p = params_.rollout;
  const auto horizon = static_cast<std::size_t>(p.horizon);
  Crowd some = crowd;
  some.thin_out(static_cast<std::size_t>(p.lookahead_places), 0.25 * params_.step);
  std::vector<Vec2> best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = -2; k < p.candidates; ++k) {
    RolloutDraft draft{some};
    if (k >= 0) lead(draft, rng.below(some.places().size()), horizon, horizon);
    const Aggregation base = k == -2 ? Aggregation::divide_and_conquer : Aggregation::heuristic;
    const bool ends = pursue(draft, base, horizon, false);
    // An end in sight is better than everything else, and a near one best.
    const double left = ends ? static_cast<double>(draft.steps()) - 1e9 : left_to_do(draft.crowd);
    if (left >= least) continue;
    least = left;
    if (!ends) draft.moves.resize(std::min(horizon, static_cast<std::size_t>(p.commit)));
    best = std::move(draft.moves);
  }
  return best;
}

double RolloutSimulator::way(const Robots& robots, std::size_t i) const {
  return ground_->tree.length(*routes_, robots.position(i));
}

double RolloutSimulator::mean_way(const Crowd& crowd) const {
  double sum = 0;
  double robots = 0;
  for (std::size_t i = 0; i < crowd.places().size(); ++i) {
    sum += crowd.counts()[i] * way(crowd.places(), i);
    robots += crowd.counts()[i];
  }
  return sum / std::max(1.0, robots);
}

/// Places count more than robots in them, since those of one place are led together; far ones count
/// more than near ones. The exponents are those that gave the shortest plans on three maps.
double RolloutSimulator::left_to_do(Crowd crowd) const {
  constexpr double weight_of_robots = 0.3;
  crowd.join(0.5 * params_.step);
  double sum = 0;
  for (std::size_t i = 0; i < crowd.places().size(); ++i) {
    const double far = way(crowd.places(), i);
    sum += maths::pow(crowd.counts()[i], weight_of_robots) * far * far;
  }
  return sum;
}

}  // namespace microswarm

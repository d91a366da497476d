// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_layers.hpp"

#include <algorithm>
#include <utility>

#include "microswarm/core/execution/parallel.hpp"

namespace microswarm {
namespace {

constexpr std::size_t layer_steps = RolloutPlan::checkpoint_interval;

}  // namespace

RolloutLayers::RolloutLayers(const RolloutExecution& plan, std::size_t checkpoint,
                             const RolloutSimulator& simulator)
    : from_(checkpoint * layer_steps) {
  const auto marks = plan.checkpoints().subspan(checkpoint);
  for (std::size_t k = 0; k < marks.size(); ++k) {
    std::vector<Vec2> moves;
    if (k > 0) {
      const auto steps = plan.moves().subspan(from_ + (k - 1) * layer_steps, layer_steps);
      moves.assign(steps.begin(), steps.end());
    }
    add(k > 0 ? static_cast<std::uint32_t>(k - 1) : 0, k, std::move(moves),
        simulator.representatives(marks[k]), simulator);
  }
}

std::optional<LayerPath> RolloutLayers::expand(RolloutSimulator& simulator, std::size_t most,
                                               Rng& rng) {
  const RolloutParams& params = simulator.params().rollout;
  std::vector<std::uint32_t> states;
  std::size_t layer = 0;
  while (states.empty()) {
    if (next_layer_ >= layers_.size() || from_ + next_layer_ * layer_steps >= most) {
      is_exhausted_ = !std::exchange(expanded_in_pass_, false);
      next_layer_ = 0;
      ++passes_;
      if (is_exhausted_) return std::nullopt;
    }
    layer = next_layer_++;
    states = best_open(layer, static_cast<std::size_t>(params.tuning.states_per_layer));
  }
  expanded_in_pass_ = true;
  const auto candidates = static_cast<std::size_t>(std::max(1, params.candidates));
  std::vector<PartialPlan> trials;
  std::vector<Rng> streams;
  for (const std::uint32_t state : states) {
    states_[state].is_open = false;
    trials.resize(trials.size() + candidates,
                  PartialPlan{*states_[state].robots, from_ + layer * layer_steps});
  }
  for (std::size_t i = 0; i < trials.size(); ++i)
    streams.emplace_back(rng.bits(), Purpose::planner);
  for_each_index(trials.size(), params.threads, [&](std::size_t i) {
    simulator.try_moves(trials[i], i % candidates == 0, most, streams[i]);
  });
  std::optional<LayerPath> best;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    auto path = take(states[i / candidates], layer, std::move(trials[i]), simulator);
    if (!path || from_ + path->moves.size() >= most) continue;
    most = from_ + path->moves.size();
    best = std::move(path);
  }
  return best;
}

// The best states of a layer that are open, the best one first.
std::vector<std::uint32_t> RolloutLayers::best_open(std::size_t layer, std::size_t count) const {
  std::vector<std::uint32_t> open;
  for (const std::uint32_t i : layers_[layer])
    if (states_[i].is_open) open.push_back(i);
  std::ranges::sort(open, {}, [&](std::uint32_t i) { return std::pair(states_[i].work_left, i); });
  if (open.size() > count) open.resize(count);
  return open;
}

LayerPath RolloutLayers::path_so_far() const {
  const std::size_t layer = next_layer_ > 0 ? next_layer_ - 1 : layers_.size() - 1;
  const auto work_left = [&](std::uint32_t i) { return states_[i].work_left; };
  return path_to(*std::ranges::min_element(layers_[layer], {}, work_left));
}

// Files what a trial passed into the layers ahead; the moves to its end if all are gathered there.
std::optional<LayerPath> RolloutLayers::take(std::uint32_t parent, std::size_t layer,
                                             PartialPlan&& trial,
                                             const RolloutSimulator& simulator) {
  for (std::size_t k = 1; k < trial.checkpoints.size(); ++k) {
    const auto first = trial.moves.begin() + static_cast<std::ptrdiff_t>((k - 1) * layer_steps);
    parent = add(parent, layer + k, {first, first + static_cast<std::ptrdiff_t>(layer_steps)},
                 trial.checkpoints[k], simulator);
  }
  if (!simulator.gathered(trial.merged)) return std::nullopt;
  LayerPath path = path_to(parent);
  const std::size_t filed = layer_steps * (std::max<std::size_t>(1, trial.checkpoints.size()) - 1);
  path.moves.insert(path.moves.end(), trial.moves.begin() + static_cast<std::ptrdiff_t>(filed),
                    trial.moves.end());
  return path;
}

std::uint32_t RolloutLayers::add(std::uint32_t parent, std::size_t layer, std::vector<Vec2> moves,
                                 const MergedRobots& robots, const RolloutSimulator& simulator) {
  const auto state = static_cast<std::uint32_t>(states_.size());
  states_.push_back({parent, std::move(moves), std::nullopt, 0, false});
  file(state, layer, robots, simulator);
  return state;
}

// Among the best of its layer, in place of the worst if there are enough, unless one is equal.
void RolloutLayers::file(std::uint32_t state, std::size_t layer, const MergedRobots& robots,
                         const RolloutSimulator& simulator) {
  if (layers_.size() <= layer) layers_.resize(layer + 1);
  std::vector<std::uint32_t>& kept = layers_[layer];
  const double left = simulator.left_to_do(robots);
  const auto work_left = [&](std::uint32_t i) { return states_[i].work_left; };
  if (std::ranges::find(kept, left, work_left) != kept.end()) return;
  if (kept.size() >= static_cast<std::size_t>(simulator.params().rollout.layer_width)) {
    const auto worst = std::ranges::max_element(kept, {}, work_left);
    if (left >= work_left(*worst)) return;
    states_[*worst].robots.reset();
    *worst = state;
  } else {
    kept.push_back(state);
  }
  states_[state].robots = robots;
  states_[state].work_left = left;
  states_[state].is_open = true;
}

LayerPath RolloutLayers::path_to(std::uint32_t state) const {
  LayerPath path;
  for (; state != 0; state = states_[state].parent) path.states.push_back(state);
  std::ranges::reverse(path.states);
  for (const std::uint32_t i : path.states)
    path.moves.insert(path.moves.end(), states_[i].moves.begin(), states_[i].moves.end());
  return path;
}

void RolloutLayers::correct(const LayerPath& path, std::span<const MergedRobots> checkpoints,
                            const RolloutSimulator& simulator) {
  for (std::size_t k = 0; k < path.states.size() && k + 1 < checkpoints.size(); ++k) {
    State& state = states_[path.states[k]];
    if (!state.robots) continue;
    state.robots = simulator.representatives(checkpoints[k + 1]);
    const double left = simulator.left_to_do(*state.robots);
    state.is_open = state.is_open || left != state.work_left;
    state.work_left = left;
  }
}

}  // namespace microswarm

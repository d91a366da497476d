// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/gathering/rollout/rollout_layers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace microswarm::navigation {
namespace {

constexpr std::size_t layer_steps = RolloutPlan::checkpoint_interval;

}  // namespace

RolloutLayers::RolloutLayers(const RolloutExecution& plan, std::size_t checkpoint,
                             RolloutSimulator& simulator)
    : width_(static_cast<std::size_t>(simulator.params().rollout.layer_width)),
      from_(checkpoint * layer_steps) {
  const auto marks = plan.checkpoints().subspan(checkpoint);
  std::vector<MergedRobots> robots(marks.begin(), marks.end());
  std::vector<double> work_left(marks.size());
  simulator.try_each(marks.size(), [&](std::size_t k) {
    robots[k] = simulator.representatives(robots[k]);
    work_left[k] = simulator.left_to_do(robots[k]);
  });
  for (std::size_t k = 0; k < marks.size(); ++k) {
    std::vector<Vec2> moves;
    if (k > 0) {
      const auto steps = plan.moves().subspan(from_ + (k - 1) * layer_steps, layer_steps);
      moves.assign(steps.begin(), steps.end());
    }
    add(k > 0 ? static_cast<std::uint32_t>(k - 1) : 0, k, std::move(moves), std::move(robots[k]),
        work_left[k]);
  }
}

std::optional<LayerPath> RolloutLayers::expand(RolloutSimulator& simulator, std::size_t most,
                                               double work, Rng& rng) {
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
  const std::size_t candidates = passes_ > 0
                                     ? static_cast<std::size_t>(std::max(1, params.candidates))
                                     : affordable_trials(states, most, work, params);
  std::vector<Trial> trials = list_trials(states, candidates, layer, most, simulator, rng);
  std::optional<LayerPath> best;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    auto path = take(states[i / candidates], layer, std::move(trials[i]), simulator);
    if (!path || from_ + path->moves.size() >= most) continue;
    most = from_ + path->moves.size();
    best = std::move(path);
  }
  return best;
}

// Trials of each of these states, if all later layers had as many, with as many positions.
std::size_t RolloutLayers::affordable_trials(std::span<const std::uint32_t> states,
                                             std::size_t most, double work,
                                             const RolloutParams& params) const {
  const auto all = static_cast<double>(std::max(1, params.candidates));
  const std::size_t at = from_ + (next_layer_ - 1) * layer_steps;
  const double layers = std::ceil(static_cast<double>(most - at) / layer_steps);
  double once = 0;
  for (const std::uint32_t state : states)
    once += mean_trial(params) * (static_cast<double>(states_[state].robots->positions().size()) +
                                  params.tuning.step_overhead);
  return static_cast<std::size_t>(
      std::clamp(work / (layers * once), std::min(min_trials, all), all));
}

// Continuations of these states of a layer, equally many of each.
std::vector<RolloutLayers::Trial> RolloutLayers::list_trials(std::span<const std::uint32_t> states,
                                                             std::size_t candidates,
                                                             std::size_t layer, std::size_t most,
                                                             RolloutSimulator& simulator,
                                                             Rng& rng) {
  std::vector<Trial> trials;
  std::vector<Rng> streams;
  for (const std::uint32_t state : states) {
    states_[state].is_open = false;
    trials.resize(trials.size() + candidates,
                  Trial{PartialPlan{*states_[state].robots, from_ + layer * layer_steps}});
  }
  for (std::size_t i = 0; i < trials.size(); ++i)
    streams.emplace_back(rng.bits(), Purpose::planner);
  simulator.try_each(trials.size(), [&](std::size_t i) {
    Trial& trial = trials[i];
    simulator.try_moves(trial.moves, i % candidates == 0, most, streams[i]);
    for (const MergedRobots& robots : trial.moves.checkpoints)
      trial.work_left.push_back(simulator.left_to_do(robots));
  });
  return trials;
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
std::optional<LayerPath> RolloutLayers::take(std::uint32_t parent, std::size_t layer, Trial&& trial,
                                             const RolloutSimulator& simulator) {
  PartialPlan& tried = trial.moves;
  for (std::size_t k = 1; k < tried.checkpoints.size(); ++k) {
    const auto first = tried.moves.begin() + static_cast<std::ptrdiff_t>((k - 1) * layer_steps);
    parent = add(parent, layer + k, {first, first + static_cast<std::ptrdiff_t>(layer_steps)},
                 std::move(tried.checkpoints[k]), trial.work_left[k]);
  }
  if (!simulator.gathered(tried.merged)) return std::nullopt;
  LayerPath path = path_to(parent);
  const std::size_t filed = layer_steps * (std::max<std::size_t>(1, tried.checkpoints.size()) - 1);
  path.moves.insert(path.moves.end(), tried.moves.begin() + static_cast<std::ptrdiff_t>(filed),
                    tried.moves.end());
  return path;
}

std::uint32_t RolloutLayers::add(std::uint32_t parent, std::size_t layer, std::vector<Vec2> moves,
                                 MergedRobots&& robots, double work_left) {
  const auto state = static_cast<std::uint32_t>(states_.size());
  states_.push_back({parent, std::move(moves), std::nullopt, 0, false});
  file(state, layer, std::move(robots), work_left);
  return state;
}

// Among the best of its layer, in place of the worst if there are enough, unless one is equal.
void RolloutLayers::file(std::uint32_t state, std::size_t layer, MergedRobots&& robots,
                         double work_left) {
  if (layers_.size() <= layer) layers_.resize(layer + 1);
  std::vector<std::uint32_t>& kept = layers_[layer];
  const auto remaining_work = [&](std::uint32_t i) { return states_[i].work_left; };
  if (std::ranges::find(kept, work_left, remaining_work) != kept.end()) return;
  if (kept.size() >= width_) {
    const auto worst = std::ranges::max_element(kept, {}, remaining_work);
    if (work_left >= remaining_work(*worst)) return;
    states_[*worst].robots.reset();
    *worst = state;
  } else {
    kept.push_back(state);
  }
  states_[state].robots = std::move(robots);
  states_[state].work_left = work_left;
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

void RolloutLayers::correct(const LayerPath& path, std::size_t first,
                            std::span<const MergedRobots> checkpoints,
                            RolloutSimulator& simulator) {
  if (checkpoints.empty() || first >= path.states.size()) return;
  const std::size_t count = std::min(path.states.size() - first, checkpoints.size() - 1);
  simulator.try_each(count, [&](std::size_t k) {
    State& state = states_[path.states[first + k]];
    if (!state.robots) return;
    state.robots = simulator.representatives(checkpoints[k + 1]);
    const double left = simulator.left_to_do(*state.robots);
    state.is_open = state.is_open || left != state.work_left;
    state.work_left = left;
  });
}

}  // namespace microswarm::navigation

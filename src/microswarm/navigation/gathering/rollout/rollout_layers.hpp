// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/navigation/gathering/rollout/rollout_execution.hpp"
#include "microswarm/navigation/gathering/rollout/rollout_simulator.hpp"

namespace microswarm::navigation {

/// Moves from the first layer on, and the states that they pass, one in each layer.
struct LayerPath {
  std::vector<std::uint32_t> states{};
  std::vector<Vec2> moves{};
};

/// Mean steps of a trial.
inline double mean_trial(const RolloutParams& params) {
  return 0.5 * (std::min(params.tuning.min_trial, params.horizon) + params.horizon);
}

/// Search for a shorter plan over layers of states: those of one layer are equally many steps from
/// the start, so that their remaining work can be compared. Each layer keeps its best states. An
/// expansion takes the best state of a layer that was not expanded yet, simulates some moves from
/// there (one robot leads, or all go in one direction) and files what it passes into the layers
/// ahead. Passes over all layers are repeated; the first is a greedy lookahead, later ones widen
/// it. Trials run on several threads and are filed in order, so the result is the same with any
/// number of them.
class RolloutLayers {
 public:
  /// Minimum number of trials of a state, independent of the remaining work.
  static constexpr double min_trials = 2;

  /// Starts at a checkpoint of the plan, with representative robots; the plan's own states are
  /// filed too.
  RolloutLayers(const RolloutExecution& plan, std::size_t checkpoint, RolloutSimulator& simulator);

  /// Steps of the plan before the first layer.
  std::size_t from() const { return from_; }
  /// Number of complete passes over all layers.
  int passes() const { return passes_; }
  /// Whether nothing is left to be expanded.
  bool is_exhausted() const { return is_exhausted_; }
  /// Expands the best states of the next layer. Returns a path that gathers the
  /// representative robots in less than `most` steps of the plan, if it found one. In the first
  /// pass there are fewer trials of a state where the rest of it would take more than `work`
  /// robot-steps.
  std::optional<LayerPath> expand(RolloutSimulator& simulator, std::size_t most, double work,
                                  Rng& rng);
  /// Path to the best state of the layer expanded last.
  LayerPath path_so_far() const;
  /// Replaces the robots on a path from its state `first` on, which are representatives, by those
  /// that were simulated with all robots: `checkpoints` along its moves, the first one before that
  /// state.
  void correct(const LayerPath& path, std::size_t first, std::span<const MergedRobots> checkpoints,
               RolloutSimulator& simulator);

 private:
  /// State after a layer's steps, and how it was reached.
  struct State {
    std::uint32_t parent;
    std::vector<Vec2> moves;             ///< from its parent
    std::optional<MergedRobots> robots;  ///< while it is kept by its layer
    double work_left;
    bool is_open;
  };

  std::vector<std::uint32_t> best_open(std::size_t layer, std::size_t count) const;
  /// Moves that were tried, with the remaining work at each checkpoint.
  struct Trial {
    PartialPlan moves;
    std::vector<double> work_left{};
  };

  std::size_t affordable_trials(std::span<const std::uint32_t> states, std::size_t most,
                                double work, const RolloutParams& params) const;
  std::vector<Trial> list_trials(std::span<const std::uint32_t> states, std::size_t candidates,
                                 std::size_t layer, std::size_t most, RolloutSimulator& simulator,
                                 Rng& rng);
  std::uint32_t add(std::uint32_t parent, std::size_t layer, std::vector<Vec2> moves,
                    MergedRobots&& robots, double work_left);
  void file(std::uint32_t state, std::size_t layer, MergedRobots&& robots, double work_left);
  LayerPath path_to(std::uint32_t state) const;
  std::optional<LayerPath> take(std::uint32_t parent, std::size_t layer, Trial&& trial,
                                const RolloutSimulator& simulator);

  std::size_t width_;  ///< states kept in a layer
  std::size_t from_;
  std::vector<State> states_;
  std::vector<std::vector<std::uint32_t>> layers_;  ///< states kept, by layer
  std::size_t next_layer_ = 0;
  int passes_ = 0;
  bool expanded_in_pass_ = false;
  bool is_exhausted_ = false;
};

}  // namespace microswarm::navigation

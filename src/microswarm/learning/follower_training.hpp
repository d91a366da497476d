// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "microswarm/learning/demonstrations.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

namespace microswarm::learning {

/// Settings of `train_follower`.
struct FollowerTrainingParams {
  std::uint64_t seed = 1;
  int runs = 150;
  int rounds = 4;
  int hidden = 24;
  int iterations = 150;
  int last_iterations = 500;
  double decay = 1e-6;
  FollowerTaskParams tasks{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.seed, plain("seed", "Seed of tasks, noise and initial weights."));
    visit(self.runs, plain("runs", 2, 1e5, "Tasks run in each round."));
    visit(self.rounds, plain("rounds", 0, 100, "Rounds in which the student drives (DAgger)."));
    visit(self.hidden, plain("hidden", 1, 64, "Width of the two hidden layers."));
    visit(self.iterations, plain("iterations", 1, 1e5, "L-BFGS iterations after a round."));
    visit(self.last_iterations,
          plain("last_iterations", 1, 1e5, "L-BFGS iterations after the last round."));
    visit(self.decay,
          plain("decay", 0, 1, "Weight decay: factor of the squared weights in the loss."));
    visit(self.tasks, plain("tasks", "Distribution of the tasks."));
  }
};

/// A trained follower and its imitation error: root mean square over both outputs, on the training
/// data and on every tenth run, which is held out.
struct TrainedFollower {
  bool finished = false;  ///< false if stopped; the model is then unusable
  navigation::FollowerModel model{};
  std::size_t demonstrations = 0;
  double training_error = 0;
  double held_out_error = 0;
};

/// Progress callback and number of threads; 0: one per core. The result is bit-identical with any
/// number.
struct TrainingOptions {
  int jobs = 0;
  /// `share` is the completed fraction of the work, in [0, 1].
  std::function<void(double share, const std::string& what)> progress{};
};

/// Trains a follower: demonstrations of the expert, a first network, then rounds in which the
/// newest network drives and the expert labels. All demonstrations are kept.
TrainedFollower train_follower(const FollowerTrainingParams& params,
                               const TrainingOptions& options = {}, const Stop& stop = {});

}  // namespace microswarm::learning

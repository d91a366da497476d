// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/navigation/prediction/convex_outline_tuning.hpp"

namespace microswarm::navigation {

/// The exact check of the next seconds of a command (ImminentCheck).
struct ImminentTuning {
  double horizon = 2.5;
  double commitment = 0.4;
  double turn_time = 0.2;
  double hidden_turn = 2;
  double gap = 1.5;
  double gap_rate = 1;
  double noise_gain = 1;
  double recovery_rate = 5;
  double wall_gap = 1.5;
  int directions = 36;
  double turn_weight = 0.5;
  double switch_gap = 3;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.horizon, s("horizon", 0.2, 30, "Time for which an escape must be free."));
    visit(self.commitment, s("commitment", 0, 10, "Time after which an escape must remain."));
    visit(self.turn_time,
          s("turn_time", 0, 10, "Time for which an obstacle that turns round is not met."));
    visit(self.hidden_turn, plain("hidden_turn", 0, 100,
                                  "Noise deviations an obstacle moves before its turn is seen."));
    visit(self.gap, um("gap", 0, 1e4, "Least gap to obstacles now."));
    visit(self.gap_rate, um_per_s("gap_rate", 0, 1e4, "Growth of the gap with prediction time."));
    visit(self.noise_gain,
          plain("noise_gain", 0, 100, "Noises of an obstacle's position added to the gap."));
    visit(self.recovery_rate,
          um_per_s("recovery_rate", 0, 1e5, "Rate at which a gap that is too small must grow."));
    visit(self.wall_gap, um("wall_gap", 0, 1e4, "Least gap to walls."));
    visit(self.directions, plain("directions", 4, 360, "Number of directions of a replacement."));
    visit(self.turn_weight,
          plain("turn_weight", 0, 100, "Weight of the turn from the last command."));
    visit(self.switch_gap, um("switch_gap", 0, 1e4, "Extra gap for which an escape is replaced."));
  }
};

/// Constants of SafeIntervalNavigator that rarely need a change.
struct SafeIntervalTuning {
  double goal_share = 0.9;
  double kept_share = 0.4;
  double checked_time = 5;
  double conflict_delay = 3;
  double turn_cost = 0.4;
  double deadband = radians(4);
  double rest_time = 0.5;
  double rest_speed = 1;
  double slow_share = 0.1;
  double closing_time = 1.5;
  double refresh_period = 1;
  double reaction_time = 0.3;
  double noisy_turn = 2;
  double turn_gain = 0.7;
  double straying_gain = 1.5;
  double straying_time = 3;
  int max_expansions = 5000;
  int max_cells = 400'000;
  ImminentTuning imminent{};
  ConvexOutlineTuning outline{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.goal_share,
          plain("goal_share", 0, 1, "Share of the tolerance in which the goal is reached."));
    visit(self.kept_share,
          plain("kept_share", 0, 1, "Share of the gaps that a plan needs to be kept."));
    visit(self.checked_time, s("checked_time", 0.2, 60, "Time for which a kept plan is checked."));
    visit(self.conflict_delay,
          s("conflict_delay", 0, 60, "Delay expected of a plan that meets an obstacle."));
    visit(self.turn_cost, s("turn_cost", 0, 60, "Cost of a turn by a radian at the start."));
    visit(self.deadband,
          deg("deadband", 0, 90, "Change of the heading below which the last one is kept."));
    visit(self.rest_time, s("rest_time", 0, 60, "Time at rest after which an obstacle is static."));
    visit(self.rest_speed, um_per_s("rest_speed", 0, 1e4, "Speed below which an obstacle rests."));
    visit(self.slow_share,
          plain("slow_share", 0, 1, "Relative speed below which an obstacle is slow."));
    visit(self.closing_time,
          s("closing_time", 0, 60, "Time for which a non-convex obstacle closes in."));
    visit(self.refresh_period,
          s("refresh_period", 0, 60, "Time after which a non-convex obstacle is drawn again."));
    visit(self.reaction_time,
          s("reaction_time", 0, 60, "Time in which an obstacle's turn is noticed and answered."));
    visit(self.noisy_turn,
          plain("noisy_turn", 0, 100, "Noises of an obstacle's position added to that way."));
    visit(self.turn_gain,
          plain("turn_gain", 0, 100, "Share of an unnoticed turn's way added to the gap."));
    visit(self.straying_gain,
          plain("straying_gain", 0, 100, "Position errors of the swarm added to its gaps."));
    visit(self.straying_time,
          s("straying_time", 1e-2, 1e3, "Time constant with which these errors are forgotten."));
    visit(self.max_expansions,
          plain("max_expansions", 1, 1e8, "Maximum number of expanded states of a search."));
    visit(self.max_cells, plain("max_cells", 100, 1e8, "Maximum number of cells."));
    visit(self.imminent, plain("imminent", "Exact check of the next seconds."));
    visit(self.outline, plain("outline", "Use of convex hulls of obstacles."));
  }
};

}  // namespace microswarm::navigation

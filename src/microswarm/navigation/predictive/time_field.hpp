// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "microswarm/navigation/prediction/convex_outline.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor.hpp"
#include "microswarm/navigation/predictive/predictive_params.hpp"

namespace microswarm::navigation {

/// Cost rate at a gap [µm] that is known up to `uncertainty` [µm].
inline float penetration_risk(const RiskParams& p, float gap, float uncertainty) {
  const float reach = static_cast<float>(p.reach) + uncertainty;
  const float contact =
      std::clamp(0.5F - 0.5F * gap / (static_cast<float>(p.softness) + uncertainty), 0.0F, 1.0F);
  const float near = std::clamp(1 - gap / reach, 0.0F, 1.0F);
  const float depth = std::clamp(-gap / static_cast<float>(p.reach), 0.0F, 1.0F);
  return static_cast<float>(p.contact) * contact +
         static_cast<float>(p.proximity_cost) * near * near +
         static_cast<float>(p.penetration_cost) * depth;
}

/// Time-expanded cost-to-go: minimum time to the goal, including risk, from every position around
/// the swarm at every time of the horizon, for a swarm that moves in any direction at once. Dynamic
/// programming backwards in time on a square grid around the swarm. The swarm moves about three
/// cells per time step, and the moves of a step are whole cells, so nothing is interpolated.
/// Allocates after construction only if there are more bodies than ever before.
class TimeField {
 public:
  /// `speed` [µm/s], `horizon` and `step` [s].
  TimeField(double speed, double horizon, double step);

  int steps() const { return steps_; }
  /// Duration of a step [s].
  double step() const { return step_; }
  /// Time of a sample [s], the midpoint of a half step; `sample` is 0 … 2 steps() − 1.
  double time_at(int sample) const { return 0.5 * step_ * (sample + 0.5); }

  /// Starts a field around `centre`. If the goal is smaller than a cell, the cells next to it count
  /// too, at the cost of the remaining distance. `standing` is the time-invariant risk at a
  /// position, `left` the time to go from it [s].
  void begin(Vec2 centre, Disc goal, const std::function<float(Vec2)>& standing,
             const std::function<float(Vec2)>& left);
  /// `ahead` holds the bodies of sample 0, then those of sample 1, …, in the order of `outlines`;
  /// `radius` is the swarm's [µm].
  void solve(std::span<const ConvexOutline> outlines, std::span<const PredictedBody> ahead,
             double radius, const RiskParams& risk);
  /// Cost-to-go [s] from `p` after `k` steps, 0 < k <= steps().
  double cost(int k, Vec2 p) const;
  /// Best neighbour of `p` for the next step.
  Vec2 next(int k, Vec2 p) const;

 private:
  static constexpr int stride_cells = 3;  // per step

  Vec2 place(int column, int row) const;
  int reach_at(int k) const;
  void paint(int reach, std::span<const ConvexOutline> outlines,
             std::span<const PredictedBody> ahead, double radius, const RiskParams& risk);
  void paint_one(int reach, const ConvexOutline& outline, const PredictedBody& ahead, double radius,
                 const RiskParams& risk);
  void step_back(int k, std::span<const ConvexOutline> outlines,
                 std::span<const PredictedBody> ahead, double radius, const RiskParams& risk);
  std::size_t cell_index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }

  int steps_;
  double step_;
  double cell_;  ///< [µm]
  int half_;     ///< cells from the centre to the border
  int width_;
  Vec2 centre_;
  struct Move {
    std::ptrdiff_t cells;  ///< difference of the indices
    Vec2 offset;           ///< [cells]
    float extra;           ///< time it takes beyond a step [s]
  };
  std::vector<Move> moves_;
  std::vector<float> standing_;
  std::vector<float> risk_;
  std::vector<float> after_;  ///< cost-to-go including the second half of a step
  std::vector<float> row_;
  std::vector<float> ended_;              ///< cost of a cell at the goal [s]; infinity elsewhere
  std::vector<std::vector<float>> cost_;  ///< after 0, 1, … steps
};

}  // namespace microswarm::navigation

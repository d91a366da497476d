// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "microswarm/navigation/prediction/convex_outline.hpp"
#include "microswarm/navigation/prediction/multi_model_predictor.hpp"
#include "microswarm/navigation/predictive/predictive_params.hpp"

namespace microswarm {

/// The cost of a gap [µm] that is known up to `uncertainty` [µm].
inline float risk_of(const RiskParams& p, float gap, float uncertainty) {
  const float reach = static_cast<float>(p.reach) + uncertainty;
  const float contact =
      std::clamp(0.5F - 0.5F * gap / (static_cast<float>(p.softness) + uncertainty), 0.0F, 1.0F);
  const float near = std::clamp(1 - gap / reach, 0.0F, 1.0F);
  const float depth = std::clamp(-gap / static_cast<float>(p.reach), 0.0F, 1.0F);
  return static_cast<float>(p.contact) * contact +
         static_cast<float>(p.proximity_cost) * near * near +
         static_cast<float>(p.penetration_cost) * depth;
}

/// The best that can be had from every place around the swarm at every time of the horizon: least
/// seconds to the goal, risks counted, of a swarm that moves into any direction at once. Dynamic
/// programming backwards in time on a square grid around the swarm. A step of time takes it about
/// three cells far, and the ways of a step are whole cells, so that nothing is interpolated.
/// Allocates nothing after it is made, but where there are more bodies than ever.
class TimeField {
 public:
  /// `speed` [µm/s], `horizon` and `step` [s].
  TimeField(double speed, double horizon, double step);

  int steps() const { return steps_; }
  double step() const { return step_; }
  /// Obstacles are asked for twice a step: `sample` counts from 0 to 2 steps() − 1.
  double time_of(int sample) const { return 0.5 * step_ * (sample + 0.5); }

  /// Begins a field around `centre`. At a goal smaller than a cell count the cells next to it, at
  /// the cost of the way that is left. `standing` is the risk of a place that never changes, `left`
  /// the time to go from it [s].
  void begin(Vec2 centre, Disc goal, const std::function<float(Vec2)>& standing,
             const std::function<float(Vec2)>& left);
  /// `ahead` holds the bodies of sample 0, then those of sample 1, …, in the order of `outlines`;
  /// `radius` is the swarm's [µm].
  void solve(std::span<const ConvexOutline> outlines, std::span<const PredictedBody> ahead,
             double radius, const RiskParams& risk);
  /// Cost [s] from `p` on when `k` steps are over, 0 < k <= steps().
  double cost(int k, Vec2 p) const;
  /// The best neighbour of `p` to be at one step later.
  Vec2 next(int k, Vec2 p) const;

 private:
  static constexpr int stride_cells = 3;  // of a step

  Vec2 place(int column, int row) const;
  int reach_at(int k) const;
  void paint(int reach, std::span<const ConvexOutline> outlines,
             std::span<const PredictedBody> ahead, double radius, const RiskParams& risk);
  void paint_one(int reach, const ConvexOutline& outline, const PredictedBody& ahead, double radius,
                 const RiskParams& risk);
  void step_back(int k, std::span<const ConvexOutline> outlines,
                 std::span<const PredictedBody> ahead, double radius, const RiskParams& risk);
  std::size_t cell_of(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }

  int steps_;
  double step_;
  double cell_;  ///< [µm]
  int half_;     ///< cells from the middle to the border
  int width_;
  Vec2 centre_;
  struct Move {
    std::ptrdiff_t cells;  ///< difference of the indices
    Vec2 way;              ///< [cells]
    float extra;           ///< what its length takes more time than a step has [s]
  };
  std::vector<Move> moves_;
  std::vector<float> standing_;
  std::vector<float> risk_;
  std::vector<float> after_;  ///< cost of being at a cell for the second half of a step, and on
  std::vector<float> row_;
  std::vector<float> ended_;              ///< cost of a cell at the goal [s]; infinity elsewhere
  std::vector<std::vector<float>> cost_;  ///< after 0, 1, … steps
};

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "microswarm/contracts/observation.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/navigation/steering/delay_compensator.hpp"
#include "microswarm/navigation/steering/response_fit.hpp"

namespace microswarm::navigation {

/// Position of a single-body swarm from frames with noise: where its commands take it from the last
/// estimate, corrected by a share of what the frame differs (Kalman filters of constant gain). Of
/// several gains it takes the one whose predictions have lately been nearest to the frames: a
/// small one where frames are noisy, 1 where the swarm strays from its commands. Each gain stands
/// twice: also with a fitted response. Without noise and flow the estimate is the observed
/// position. Does not allocate.
class SwarmEstimate {
 public:
  /// `memory` is the time constant with which past differences are forgotten [s].
  explicit SwarmEstimate(double memory, double max_flow = infinity)
      : memory_(memory), fit_(memory, max_flow) {}

  /// Takes the swarm of a frame at the time `t` [s], and returns it at the estimated position.
  /// A frame that is not newer than the last changes nothing.
  SwarmPose update(const SwarmPose& seen, double t, const DelayCompensator& commands);
  /// The swarm in a frame at the time `t` [s] that does not show it; not before the first that
  /// does.
  SwarmPose bridge(double t, const DelayCompensator& commands);
  /// Time of the last frame that showed it [s]; nothing before the first.
  const std::optional<double>& shown() const { return shown_; }
  /// Variance of a coordinate of the swarm about the estimate, before the frame counts [µm²].
  double variance() const { return gains[best_ % gains.size()] * squares_[best_]; }
  /// Response of the swarm to its commands.
  SwarmResponse response() const { return response_of(best_); }

 private:
  static constexpr std::array<double, 4> gains{1, 0.5, 0.25, 0.125};
  static constexpr std::size_t count = 2 * gains.size();  ///< the second half with the fit

  void correct(Vec2 seen, double share);
  SwarmResponse response_of(std::size_t i) const {
    return i < gains.size() ? SwarmResponse{} : fit_.response();
  }
  SwarmPose current() const { return {{positions_[best_], heading_}, radius_}; }

  double memory_;
  std::optional<double> shown_;
  double t_ = 0;  ///< of the positions [s]
  double heading_ = 0;
  double radius_ = 0;  ///< [µm]
  Vec2 commanded_{};   ///< where its commands alone would have taken it from the origin [µm]
  ResponseFit fit_;
  std::array<Vec2, count> positions_{};
  std::array<double, count> squares_{};  ///< mean squares of a coordinate's difference [µm²]
  std::size_t best_ = 0;
};

}  // namespace microswarm::navigation

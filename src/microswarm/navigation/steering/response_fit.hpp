// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/navigation/steering/swarm_response.hpp"

namespace microswarm::navigation {

/// Fits a SwarmResponse to the positions of the last seconds by least squares. On a straight course
/// a speed factor and a flow cannot be distinguished; then it takes a flow. Does not allocate.
class ResponseFit {
 public:
  /// `memory` is the time constant with which past positions are forgotten [s]. A flow above
  /// `max_flow` [µm/s] is taken for a swarm that is stuck, and not fitted.
  explicit ResponseFit(double memory, double max_flow = infinity)
      : memory_(memory), max_flow_(max_flow) {}

  /// A position [µm] at the time `t` [s] of a swarm that its commands alone would have taken to
  /// `commanded` [µm] from where it began.
  void add(double t, Vec2 position, Vec2 commanded);
  const SwarmResponse& response() const { return response_; }

 private:
  static constexpr std::size_t max_samples = 64;
  struct Sample {
    double t = 0;
    Vec2 position{};
    Vec2 commanded{};
  };

  void fit();

  double memory_;
  double max_flow_;
  std::array<Sample, max_samples> samples_{};  ///< a ring
  std::size_t added_ = 0;
  SwarmResponse response_;
};

}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/navigation/prediction/multi_model_predictor.hpp"

namespace microswarm::navigation {

/// Says which bodies have rested for a while: a body whose estimated motion is slow and certain.
/// Allocates only if there are more bodies than ever before.
class RestingBodies {
 public:
  /// `rest_time` [s], `rest_speed` [µm/s].
  RestingBodies(double rest_time, double rest_speed)
      : rest_time_(rest_time), rest_speed_(rest_speed) {}

  /// Processes the predictor's newest frame, of the time `t` [s]. A frame older than the last one
  /// resets it.
  void update(std::span<const Body> bodies, const MultiModelPredictor& predictor, double t);
  bool rests(std::size_t body) const { return rests_[body]; }

 private:
  struct Known {
    std::uint32_t obstacle = 0;
    std::uint32_t leaf = 0;
    double since = 0;  ///< last time it moved, or when it was first seen [s]
  };
  Known& known(std::uint32_t obstacle, std::uint32_t leaf);

  double rest_time_;
  double rest_speed_;
  double last_ = 0;
  std::vector<Known> known_;
  std::vector<bool> rests_;
};

}  // namespace microswarm::navigation

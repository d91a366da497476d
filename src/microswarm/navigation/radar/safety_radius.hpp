// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/navigation/radar/safety_radius_params.hpp"

namespace microswarm {

/// The controller with these parameters; see safety_radius.cpp for why it is exact.
class SafetyRadius {
 public:
  explicit SafetyRadius(const SafetyRadiusParams& params);

  /// |v_ropt| [µm/s], the first input that minimises Eq 23, of an obstacle whose edge is `gap` µm
  /// from the swarm's.
  double assumed_speed(double gap) const;
  /// r_f [µm], Eq 24: at most `greatest` (r_f0), at least `least` (the prediction circle). Of
  /// several obstacles the nearest one's gap gives the largest, hence theirs all.
  double radius(double greatest, double least, double gap) const;

 private:
  SafetyRadiusParams params_;
  double gain_ = 0;  // K_0 [1/s]
};

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/navigation/radar/safety_radius_params.hpp"

namespace microswarm::navigation {

/// Controller of the safety radius; safety_radius.cpp proves that it is exact.
class SafetyRadius {
 public:
  explicit SafetyRadius(const SafetyRadiusParams& params);

  /// |v_ropt| [µm/s], the first input that minimises Eq 23, for a gap of `gap` µm between the edges
  /// of obstacle and swarm.
  double assumed_speed(double gap) const;
  /// r_f [µm], Eq 24, at most `greatest` (r_f0) and at least `least` (the prediction circle). Of
  /// several obstacles, the nearest one gives the maximum, so its gap suffices.
  double radius(double greatest, double least, double gap) const;

 private:
  SafetyRadiusParams params_;
  double gain_ = 0;  // K_0 [1/s]
};

}  // namespace microswarm::navigation

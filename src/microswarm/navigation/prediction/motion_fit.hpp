// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/geometry/vec2.hpp"

namespace microswarm {

/// Where something was seen [µm], and when [s].
struct Sighting {
  double t = 0;
  Vec2 place;
};

/// How something moves, at the time of its newest sighting.
struct MotionFit {
  Vec2 place;         ///< [µm]
  Vec2 velocity;      ///< [µm/s]
  Vec2 acceleration;  ///< [µm/s²]; 0 while the sightings go straight as far as their noise tells
  double noise = 0;   ///< standard deviation of a sighting's coordinate [µm]
  double velocity_error = 0;  ///< standard deviation of a coordinate of the velocity [µm/s]
  int sightings = 0;          ///< the newest ones, on which this stands
};

/// Fits a straight or a curved (constant acceleration) motion by least squares to the newest
/// sightings, at most `most` and as many as fit it within their noise, so that a turn or a leap
/// ends the window; of the two fits the one whose velocity is surer. The noise is told from the
/// median third difference of all of them, which few leaps do not touch. `sightings` ascend in
/// time; one alone rests, with an infinite velocity error. Allocates nothing.
MotionFit fit_motion(std::span<const Sighting> sightings, int most);

}  // namespace microswarm

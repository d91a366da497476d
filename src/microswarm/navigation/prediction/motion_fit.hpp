// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "microswarm/geometry/vec2.hpp"
#include "microswarm/navigation/prediction/motion_fit_tuning.hpp"

namespace microswarm::navigation {

/// Observed position [µm] and its time [s].
struct Sighting {
  double t = 0;
  Vec2 position{};
};

/// Estimated motion at the time of the newest sighting.
struct MotionFit {
  Vec2 position{};            ///< [µm]
  Vec2 velocity{};            ///< [µm/s]
  Vec2 acceleration{};        ///< [µm/s²]; 0 while the sightings are straight within their noise
  double noise = 0;           ///< standard deviation of a sighting's coordinate [µm]
  double velocity_error = 0;  ///< standard deviation of a coordinate of the velocity [µm/s]
  int sightings = 0;          ///< number of newest sightings used
};

/// Fits a straight or a curved (constant-acceleration) motion to the newest sightings by least
/// squares. The window holds at most `most` sightings and only those that fit within their noise,
/// so a turn or a jump ends it. Of the two fits the one with the more certain velocity is taken.
/// The noise is estimated from the median third difference of all sightings, which is robust
/// against a few jumps. `sightings` ascend in time; a single one is at rest with infinite velocity
/// error. Does not allocate.
MotionFit fit_motion(std::span<const Sighting> sightings, int most,
                     const MotionFitTuning& tuning = {});

}  // namespace microswarm::navigation

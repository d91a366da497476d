// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm::rig {

/// Response of a simulated swarm to the field: the inverse of FieldGenerator. A field weaker than
/// `min_amplitude` [mT] has no effect.
struct FieldResponseParams {
  actuation::FieldKind kind = actuation::FieldKind::rotating;
  double frequency = 16;                     ///< of the field [Hz]
  double speed_per_pitch = 20 / radians(1);  ///< [µm/s] per rad, c of Eq 2 [radar]
  double length_per_turn = 20;               ///< distance per turn of a rolling field [µm]
  double min_amplitude = 0.5;                ///< [mT]
};

}  // namespace microswarm::rig

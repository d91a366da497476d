// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/actuation/field/field_generator.hpp"
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
  double heading_offset = 0;                 ///< of the motion against the field's heading [rad]
  double delay = 0;                          ///< of the motion [s]
  std::optional<double> step_out{};          ///< largest frequency that is followed [Hz]
};

}  // namespace microswarm::rig

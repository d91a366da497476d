// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/actuation/coils/coil_system.hpp"

namespace microswarm {

/// Currents for a field, of all those that make it the ones with the least sum of squares. Where
/// the coils cannot make every field (rank below 3) they make the nearest one.
struct CurrentsForField {
  Eigen::VectorXd currents;  ///< [A]
  Eigen::Vector3d field;     ///< that they make [mT]
  int rank = 0;              ///< of the actuation matrix; 3: every field can be made
  Eigen::Matrix3Xd missing;  ///< unit vectors, one a column, along which no field can be made
  double short_by = 0;       ///< |field − wanted| [mT]
  bool reached = false;      ///< the field is the one wanted
};

/// I = Aᵀ (A Aᵀ)⁻¹ B, Eq 4 [global] as one would expect it; the field without current is taken off
/// before.
CurrentsForField currents_for(const Actuation& at, const Eigen::Vector3d& field);

}  // namespace microswarm

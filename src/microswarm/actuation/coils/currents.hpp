// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/field/field_generator.hpp"

namespace microswarm::actuation {

/// Minimum-norm currents for a field. If the rank is below 3 and the field cannot be produced, they
/// produce the nearest field.
struct CurrentsForField {
  Eigen::VectorXd currents{};  ///< [A]
  Eigen::Vector3d field{};     ///< produced field [mT]
  int rank = 0;                ///< rank of the actuation matrix; 3: every field can be produced
  Eigen::Matrix3Xd
      missing{};         ///< unit vectors, one per column, along which no field can be produced
  double short_by = 0;   ///< |field − wanted| [mT]
  bool reached = false;  ///< the produced field is the wanted one
};

/// Solves I = Aᵀ (A Aᵀ)⁻¹ B after subtracting the field at zero current from B. This is our reading
/// of Eq 4 [global].
CurrentsForField currents_for(const Actuation& at, const Eigen::Vector3d& field);

/// Currents of a generator's field at every phase: minimum-norm currents are linear in the field.
/// `reached` becomes whether the coils can produce it.
TurningCurrents turning_currents(const Actuation& at, const FieldGenerator& generator,
                                 bool& reached);

}  // namespace microswarm::actuation

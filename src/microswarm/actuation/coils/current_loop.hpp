// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/actuation/field/field.hpp"

namespace microswarm::actuation {

/// Magnetic constant µ0 [mT µm/A].
inline constexpr double mu_0 = 1256.63706212;

/// Thin circular current loop with any number of turns.
struct CurrentLoop {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [µm]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< current flows counter-clockwise around it
  double radius = 1;                                 ///< [µm]
  double turns = 1;                                  ///< may be a fraction
};

/// Field of a loop for one ampere: Biot–Savart law with complete elliptic integrals. Exact except
/// within a millionth of the radius of the wire, where the distance is clamped.
FieldGradient loop_field(const CurrentLoop& loop, const Eigen::Vector3d& position);

}  // namespace microswarm::actuation

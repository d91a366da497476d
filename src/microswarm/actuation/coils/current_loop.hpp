// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/actuation/field/field.hpp"

namespace microswarm {

/// Magnetic constant µ0 [mT µm/A].
inline constexpr double mu_0 = 1256.63706212;

/// Thin circular turns of wire around one circle.
struct CurrentLoop {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [µm]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< unit vector; current runs round it
  double radius = 1;                                 ///< [µm]
  double turns = 1;                                  ///< may be a share of a turn
};

/// Field of a loop for one ampere: the law of Biot–Savart with complete elliptic integrals, exact
/// everywhere but on the wire; nearer to it than a millionth of the radius it is as there.
FieldGradient loop_field(const CurrentLoop& loop, const Eigen::Vector3d& place);

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace microswarm::actuation {

/// Flux density at a position and its gradient; for a coil, both per ampere. In current-free space
/// the gradient is symmetric and its trace is 0.
struct FieldGradient {
  Eigen::Vector3d field = Eigen::Vector3d::Zero();     ///< [mT] or [mT/A]
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  ///< ∂B_i/∂x_j [mT/µm] or [mT/µm/A]

  FieldGradient& operator+=(const FieldGradient& other) {
    field += other.field;
    gradient += other.gradient;
    return *this;
  }
};

/// The five independent entries of a gradient in free space: dBx/dx, dBx/dy, dBx/dz, dBy/dy,
/// dBy/dz.
using FiveGradients = Eigen::Matrix<double, 5, 1>;

/// The five independent entries of a gradient.
inline FiveGradients five_gradients(const Eigen::Matrix3d& g) {
  FiveGradients five;
  five << g(0, 0), g(0, 1), g(0, 2), g(1, 1), g(1, 2);
  return five;
}

/// The gradient with these entries; curl and divergence are 0.
inline Eigen::Matrix3d gradient_matrix(const FiveGradients& five) {
  Eigen::Matrix3d g;
  g << five[0], five[1], five[2], five[1], five[3], five[4], five[2], five[4], -five[0] - five[3];
  return g;
}

/// 1 T/m in mT/µm.
inline constexpr double mt_per_um_of_t_per_m = 1e-3;

}  // namespace microswarm::actuation

// SPDX-License-Identifier: Apache-2.0
// Random places and differences for the tests of this floor.
#pragma once

#include <Eigen/Core>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm::test {

/// Numbers in [-1, 1) and vectors of them.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : rng_(seed, Purpose::test) {}
  double number() { return rng_.uniform(-1, 1); }
  Eigen::Vector3d vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
  Eigen::Vector3d direction() {
    for (;;)
      if (const Eigen::Vector3d v = vector(); v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }

 private:
  Rng rng_;
};

/// ∂B_i/∂x_j of a field by central differences of the fourth order.
template <class Field>
Eigen::Matrix3d difference_gradient(const Field& field, const Eigen::Vector3d& p, double step) {
  Eigen::Matrix3d g;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d h = step * Eigen::Vector3d::Unit(axis);
    g.col(axis) =
        (8 * (field(p + h) - field(p - h)) - (field(p + 2 * h) - field(p - 2 * h))) / (12 * step);
  }
  return g;
}

}  // namespace microswarm::test

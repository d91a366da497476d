// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

namespace microswarm::actuation {

/// A measured field of coils beside the expected one.
struct FieldComparison {
  double ratio = 1;  ///< of the strengths, measured over expected
  double angle = 0;  ///< between the directions [rad]
  /// Whether winding tolerances and the place of a probe explain the difference: 0.7 to 1.4 times
  /// the strength and at most 15°.
  bool is_plausible() const;
};

/// Comparison of two fields [mT], both without the field at zero current; the expected one is not
/// zero.
FieldComparison compare_fields(const Eigen::Vector3d& measured, const Eigen::Vector3d& expected);

/// Implausible difference of two fields [mT] in words, with its likely cause: "10 times the
/// expected field: gauss instead of mT?". Empty for a plausible one.
std::string field_doubt(const Eigen::Vector3d& measured, const Eigen::Vector3d& expected);

}  // namespace microswarm::actuation

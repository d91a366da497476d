// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/currents.hpp"

#include <Eigen/SVD>

namespace microswarm::actuation {
namespace {

// Singular values below this fraction of the largest are rounding errors.
constexpr double weakest_direction = 1e-9;
constexpr double current_rounding = 1e-9;

}  // namespace

CurrentsForField currents_for(const Actuation& at, const Eigen::Vector3d& field) {
  // With A = U S Vᵀ the minimum-norm currents Aᵀ(AAᵀ)⁻¹B are V S⁻¹ Uᵀ B. Zeros of S mark the
  // directions that no coil drives.
  const Eigen::MatrixXd A = at.field;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeThinV);
  const Eigen::VectorXd& strength = svd.singularValues();
  CurrentsForField result;
  while (result.rank < strength.size() && strength[result.rank] > weakest_direction * strength[0])
    ++result.rank;
  const Eigen::Vector3d wanted = field - at.offset.field;
  result.currents = Eigen::VectorXd::Zero(A.cols());
  for (int k = 0; k < result.rank; ++k)
    result.currents += svd.matrixU().col(k).dot(wanted) / strength[k] * svd.matrixV().col(k);
  result.missing = svd.matrixU().rightCols(3 - result.rank);
  result.field = at.total_field(result.currents);
  result.short_by = (result.field - field).norm();
  result.reached = result.short_by <= current_rounding * (field.norm() + at.offset.field.norm());
  return result;
}

TurningCurrents turning_currents(const Actuation& at, const FieldGenerator& generator,
                                 bool& reached) {
  const auto [cosine, sine] = generator.turning();
  const CurrentsForField none = currents_for(at, Eigen::Vector3d::Zero());
  const CurrentsForField along = currents_for(at, cosine), across = currents_for(at, sine);
  reached = along.reached && across.reached;
  return {.frequency = generator.frequency(),
          .max_frequency = generator.max_frequency(),
          .phase = generator.phase(),
          .constant = none.currents,
          .cosine = along.currents - none.currents,
          .sine = across.currents - none.currents};
}

}  // namespace microswarm::actuation

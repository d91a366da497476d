// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/coils/field_measurements.hpp"

namespace microswarm::actuation {

/// Quantities to fit besides the actuation matrix.
struct FitOptions {
  bool offset = false;     ///< the field at zero current, with `gradients` also its gradients
  bool gradients = false;  ///< the five independent gradients of each coil in free space
  /// Position of the matrix if gradients are fitted [µm]; default: the middle of the positions.
  std::optional<Eigen::Vector3d> centre{};
};

/// An actuation matrix fitted to measurements, with its residuals.
struct FittedMatrix {
  MatrixCoils coils{};
  Eigen::Vector3d rms = Eigen::Vector3d::Zero();  ///< of the residuals along x, y, z [mT]
  double total_rms = 0;                           ///< of |residual| [mT]
  double worst = 0;                               ///< largest |residual| [mT]
  std::size_t worst_row = 0;
  std::vector<Eigen::Vector3d> residuals{};  ///< measured − fitted, row by row [mT]
  std::size_t freedom = 0;                   ///< measured numbers less fitted ones
  /// Standard errors of the coils' fields [mT/A] and gradients [T/m/A], like `coils`; NaN without
  /// freedom.
  Eigen::MatrixXd field_errors{}, gradient_errors{};
};

/// Largest standard error of a fitted field, as a share of that coil's field; empty without
/// freedom, or without a field.
struct LargestError {
  std::size_t coil = 0;
  double share = 0;
};
std::optional<LargestError> largest_error(const FittedMatrix& fit);

/// Throws InputError that names the coils whose fitted field, and gradients if there are any, are
/// no more than rounding or three standard errors.
void require_effects(const FieldMeasurements& measured, const FittedMatrix& fit);

/// Fits the matrix A, with `offset` the field b at zero current, and with `gradients` the field's
/// gradients, whose divergence and curl are 0, by minimising Σ |B − B(p)|². Throws InputError if
/// the measurements do not determine the fit; the message names the coils whose currents were never
/// varied, or never varied independently of others, and the gradients for which positions are
/// missing.
FittedMatrix fit_matrix(const FieldMeasurements& measured, const FitOptions& options = {});

/// Whether the positions determine the gradients, too.
bool determines_gradients(const FieldMeasurements& measured, const FitOptions& options);

}  // namespace microswarm::actuation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"

namespace microswarm {

/// One measurement: the currents in the coils and the field of a probe.
struct FieldMeasurement {
  Eigen::VectorXd currents;  ///< [A]
  Eigen::Vector3d place;     ///< [µm]
  Eigen::Vector3d field;     ///< measured by the probe [mT]
  int line = 0;              ///< line in the file
};

/// Measurements of one system.
struct FieldMeasurements {
  std::string file;                ///< file name for error messages
  std::vector<std::string> coils;  ///< names
  std::vector<FieldMeasurement> rows;
};

/// Reads a CSV file with a header. Columns: `i_NAME_a` for the current of each coil; bx_mt, by_mt,
/// bz_mt; and optionally x_um, y_um, z_um, which default to 0. Throws InputError "NAME:LINE: WHY".
FieldMeasurements read_measurements(const std::filesystem::path& path);
/// Parses the same format from text.
FieldMeasurements parse_measurements(std::string_view text, std::string_view name);

/// An actuation matrix fitted to measurements, with its residuals.
struct FittedMatrix {
  MatrixCoils coils;
  Eigen::Vector3d rms = Eigen::Vector3d::Zero();  ///< of the residuals along x, y, z [mT]
  double total_rms = 0;                           ///< of |residual| [mT]
  double worst = 0;                               ///< largest |residual| [mT]
  std::size_t worst_row = 0;
  std::vector<Eigen::Vector3d> residuals;  ///< measured − fitted, row by row [mT]
};

/// Fits the matrix A and, with `with_offset`, the field b at zero current by minimising
/// Σ |B − A I − b|². Throws InputError if the measurements do not determine the fit; the message
/// names the coils whose currents were never varied, or never varied independently of others.
FittedMatrix fit_matrix(const FieldMeasurements& measured, bool with_offset);

}  // namespace microswarm

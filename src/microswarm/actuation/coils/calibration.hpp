// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"

namespace microswarm {

/// One measurement: what field a probe saw where under which currents.
struct FieldMeasurement {
  Eigen::VectorXd currents;  ///< [A]
  Eigen::Vector3d place;     ///< [µm]
  Eigen::Vector3d field;     ///< [mT]
  int line = 0;              ///< of the file
};

/// Measurements of one system.
struct FieldMeasurements {
  std::string file;                ///< as it is named in complaints
  std::vector<std::string> coils;  ///< names
  std::vector<FieldMeasurement> rows;
};

/// Reads a CSV with a header: a column `i_NAME_a` for the current of each coil, bx_mt, by_mt,
/// bz_mt, and x_um, y_um, z_um, 0 where they are missing. Throws InputError "NAME:LINE: WHY".
FieldMeasurements read_measurements(const std::filesystem::path& path);
/// The same from text.
FieldMeasurements parse_measurements(std::string_view text, std::string_view name);

/// An actuation matrix fitted to measurements, and how well it fits.
struct FittedMatrix {
  MatrixCoils coils;
  Eigen::Vector3d rms = Eigen::Vector3d::Zero();  ///< of the residuals along x, y, z [mT]
  double total_rms = 0;                           ///< of |residual| [mT]
  double worst = 0;                               ///< largest |residual| [mT]
  std::size_t worst_row = 0;
  std::vector<Eigen::Vector3d> residuals;  ///< measured − fitted, row by row [mT]
};

/// The matrix A and, if asked for, the field b without current that make Σ |B − A I − b|² least.
/// Throws InputError when the measurements do not tell it, with the coils whose currents were never
/// changed, or never apart from one another.
FittedMatrix fit_matrix(const FieldMeasurements& measured, bool with_offset);

}  // namespace microswarm

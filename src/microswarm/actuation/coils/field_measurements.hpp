// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::actuation {

/// One measurement: the currents in the coils and the field of a probe.
struct FieldMeasurement {
  Eigen::VectorXd currents{};  ///< [A]
  Eigen::Vector3d position{};  ///< [µm]
  Eigen::Vector3d field{};     ///< measured by the probe [mT]
  int line = 0;                ///< line in the file
  /// Commanded currents [A], which a device may have limited; empty if unknown.
  Eigen::VectorXd planned{};
};

/// Measurements of one system.
struct FieldMeasurements {
  std::string file{};                ///< file name for error messages
  std::vector<std::string> coils{};  ///< names
  std::vector<FieldMeasurement> rows{};
};

/// Reads a CSV file with a header. Columns: `i_NAME_a` for the current of each coil; bx_mt, by_mt,
/// bz_mt; and optionally x_um, y_um, z_um, which default to 0, and `planned_NAME_a` for each coil.
/// Throws InputError "NAME:LINE: WHY".
FieldMeasurements read_measurements(const std::filesystem::path& path);
/// Parses the same format from text.
FieldMeasurements parse_measurements(std::string_view text, std::string_view name);

}  // namespace microswarm::actuation

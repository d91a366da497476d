// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/actuation/coils/field_measurements.hpp"

namespace microswarm::actuation {

/// A field with the readings it is the mean of.
struct FieldReading {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();    ///< [mT]
  Eigen::Vector3d spread = Eigen::Vector3d::Zero();  ///< standard deviation of a reading [mT]
  int count = 1;
};
/// Mean and spread of readings, at least one.
FieldReading mean_reading(const std::vector<Eigen::Vector3d>& readings);

/// A growing file of measurements, complete after each one even if the program is killed. An
/// existing file is continued. `read_measurements` reads it.
class MeasurementLog {
 public:
  /// Reads the file if it is there. Throws InputError if it is damaged, or its columns are not
  /// those of these coils.
  MeasurementLog(std::filesystem::path file, const std::vector<std::string>& coils);

  const FieldMeasurements& measured() const { return measured_; }
  /// Writes one more, with the currents that the device had for those planned [A]; throws
  /// InputError if that fails.
  void add(const Eigen::VectorXd& currents, const Eigen::VectorXd& planned,
           const Eigen::Vector3d& position, const FieldReading& reading);
  /// Takes back the last one, if there is one.
  void remove_last();

 private:
  void write();

  std::filesystem::path file_;
  std::vector<std::string> lines_;
  FieldMeasurements measured_;
};

}  // namespace microswarm::actuation

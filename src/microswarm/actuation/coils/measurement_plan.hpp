// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/coils/field_measurements.hpp"

namespace microswarm::actuation {

/// One measurement that is to be made.
struct MeasurementStep {
  Eigen::VectorXd currents{};  ///< [A]
  Eigen::Vector3d position{};  ///< of the probe [µm]
};

/// Currents to measure at each position: none, each coil alone, optionally pairs.
struct MeasurementPlanOptions {
  std::vector<Eigen::Vector3d> positions{};  ///< of the probe [µm], at least one
  /// Largest current of each coil [A]; default: 80 % of the current that it can hold indefinitely,
  /// rounded down to two digits.
  std::optional<double> current{};
  int levels = 1;      ///< currents of each sign, equally spaced
  bool pairs = false;  ///< also each coil together with the next one
};

/// The measurements that determine a calibration, position by position. Throws InputError if a coil
/// cannot hold the current indefinitely, or has neither a limit nor a given current.
std::vector<MeasurementStep> measurement_plan(const CoilSystem& system,
                                              const MeasurementPlanOptions& options);

/// The steps without a row. A row belongs to a step if position and planned currents are equal,
/// even if the device limited the currents.
std::vector<MeasurementStep> missing_steps(const std::vector<MeasurementStep>& steps,
                                           const std::vector<FieldMeasurement>& rows);

}  // namespace microswarm::actuation

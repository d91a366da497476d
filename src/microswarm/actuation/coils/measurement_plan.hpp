// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/coils/field_measurements.hpp"

namespace microswarm {

/// One measurement that is to be made.
struct MeasurementStep {
  Eigen::VectorXd currents;  ///< [A]
  Eigen::Vector3d place;     ///< of the probe [µm]
};

/// What is to be measured at each position: no current, each coil alone, optionally pairs.
struct MeasurementPlanOptions {
  std::vector<Eigen::Vector3d> places;  ///< of the probe [µm], at least one
  /// Largest current of each coil [A]; empty: 80 % of what it can hold for ever, rounded down to
  /// two digits.
  std::optional<double> current{};
  int levels = 1;      ///< currents of each sign, equally spaced
  bool pairs = false;  ///< also each coil together with the next one
};

/// The measurements that determine a calibration, position by position. Throws InputError if a coil
/// cannot hold the current for ever, or nothing limits it and none is given.
std::vector<MeasurementStep> measurement_plan(const CoilSystem& system,
                                              const MeasurementPlanOptions& options);

/// The steps that have no row of their own. A row belongs to a step if their positions are equal
/// it was planned with this step's currents, whatever the device made of them.
std::vector<MeasurementStep> missing_steps(const std::vector<MeasurementStep>& steps,
                                           const std::vector<FieldMeasurement>& rows);

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "microswarm/actuation/coils/calibration.hpp"
#include "microswarm/actuation/coils/measurement_log.hpp"
#include "rig/real_coils.hpp"

namespace microswarm::cli {

/// Options of a guided measurement.
struct MeasureOptions {
  std::string rig;
  std::vector<std::string> settings;
  std::string positions;
  std::optional<double> current;
  int levels = 1;
  bool pairs = false;
  double hold = 60;
  double ramp = 0.5;
  double settle = 0.5;
  std::string probe;
  double dwell = 1;
  CoilOptions coils;
  std::string by;  ///< person in the commissioning record
};

/// Adds these options to `rig calibrate`.
void add_measure_options(Command cmd, MeasureOptions& o);

/// Makes the measurements missing in the file: drives each current and holds it until the operator
/// has typed the field or a probe's file has it. `fit` is refused before the first current if the
/// positions would not determine it. Returns an exit code, `ok` if all measurements are made.
int measure(const rig::Rig& rig, const MeasureOptions& o, const actuation::FitOptions& fit,
            const std::string& file, const Context& context);

}  // namespace microswarm::cli

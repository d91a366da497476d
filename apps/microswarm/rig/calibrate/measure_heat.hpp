// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rig/real_coils.hpp"

namespace microswarm::cli {

/// Options of a guided measurement of a coil's heat.
struct HeatMeasureOptions {
  std::string rig;
  std::vector<std::string> settings;
  std::optional<double> current;
  double heat = 1200;
  double cool = 1200;
  double every = 30;
  double hold = 60;
  std::optional<double> ambient;  ///< [°C]
  CoilOptions coils;
};

/// Adds these options to `rig heat`, apart from `ambient`.
void add_heat_measure_options(Command cmd, HeatMeasureOptions& o);

/// Heats a coil by its current, then lets it cool at a tenth of it, and asks for the voltage at its
/// terminals meanwhile. `file` has each answer at once. Ends the heating where the voltage shows
/// the coil's maximum temperature. Returns an exit code, `ok` after the whole time. Throws
/// InputError if the file exists.
int measure_heat(const rig::Rig& rig, std::size_t coil, const HeatMeasureOptions& o,
                 const std::string& file, const Context& context);

}  // namespace microswarm::cli

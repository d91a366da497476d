// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/actuation/amplifiers/amplifier_params.hpp"

namespace microswarm::actuation {

/// A moment of a coil that heats or cools. Its current flows until the next one.
struct HeatRow {
  double t = 0;                         ///< [s]
  double current = 0;                   ///< [A]
  std::optional<double> voltage{};      ///< at the coil's terminals [V]
  std::optional<double> temperature{};  ///< of a probe in the coil [°C]
  int line = 0;                         ///< line in the file
};

/// Log of one coil that was heated by its current and cooled again, from ambient temperature on.
struct HeatLog {
  std::string file{};  ///< file name for error messages
  std::vector<HeatRow> rows{};
};

/// Reads a CSV file with a header: t_s, i_a, and v_v or temperature_degc or both, in which a cell
/// may be empty. Throws InputError "NAME:LINE: WHY".
HeatLog read_heat_log(const std::filesystem::path& path);
/// Parses the same format from text.
HeatLog parse_heat_log(std::string_view text, std::string_view name);
/// Header of such a file without temperatures, and a row of it with its end of line.
inline constexpr std::string_view heat_header = "t_s,i_a,v_v";
std::string to_csv_row(const HeatRow& row);

/// A fitted value and its standard error.
struct FittedValue {
  double value = 0;
  double error = 0;
};

/// Thermal model of a coil, fitted to a log.
struct HeatFit {
  FittedValue resistance{};          ///< at 20 °C [Ω]; without error if no voltage was read
  FittedValue thermal_resistance{};  ///< [K/W]
  FittedValue thermal_time{};        ///< [s]
  double warmest = 0;                ///< temperature of the log, by the fit [°C]
  double rms = 0;                    ///< residual of the temperatures [K]
  double worst = 0;                  ///< largest residual [K]
  int worst_line = 0;                ///< its line
};

/// Temperature of the coil by its resistance, voltage over current [°C]. `cold`: resistance at
/// ambient temperature [Ω].
double temperature_by(double resistance, double cold, const AmplifierParams& coil);

/// Fits resistance, thermal resistance and time constant by least squares of the temperatures that
/// voltage over current and the probe show (Levenberg–Marquardt). `coil` gives the temperature
/// coefficient, the ambient temperature, and the resistance if no voltage was read. Throws
/// InputError if the log does not determine them.
HeatFit fit_heat(const HeatLog& log, const AmplifierParams& coil);

}  // namespace microswarm::actuation

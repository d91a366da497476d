// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm::actuation {

/// One coil as a load of its amplifier, a resistance and an inductance in series, with its limits.
/// Its resistance grows with its temperature. It heats as a first-order system: at constant power
/// the final temperature is ambient + thermal_resistance · power, approached with the time
/// constant. A limit that is not set is not applied.
struct AmplifierParams {
  double resistance = 1;
  double temperature_coefficient = 0.00393;
  double inductance = 1;
  double thermal_resistance = 1;
  double thermal_time = 300;
  double ambient = 22;
  std::optional<double> max_current{};
  std::optional<double> max_voltage{};
  std::optional<double> max_slew{};
  std::optional<double> max_temperature{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.resistance, ohm("resistance", 1e-6, 1e6, "Resistance of the coil at 20 °C."));
    visit(self.temperature_coefficient,
          per_k("temperature_coefficient", 0, 0.1,
                "Growth of the resistance per kelvin; that of copper."));
    visit(self.inductance, mh("inductance", 0, 1e6, "Inductance of the coil."));
    visit(self.thermal_resistance, k_per_w("thermal_resistance", 0, 1e6,
                                           "Temperature rise over the surroundings per watt."));
    visit(self.thermal_time, s("thermal_time", 1e-3, 1e7, "Time constant of the temperature."));
    visit(self.ambient, degc("ambient", -273, 1e3, "Temperature around the coil."));
    visit(self.max_current, a("max_current", 1e-6, 1e6, "Maximum current."));
    visit(self.max_voltage, v("max_voltage", 1e-6, 1e6, "Maximum voltage."));
    visit(self.max_slew, a_per_s("max_slew", 1e-6, 1e9, "Maximum rate of change of the current."));
    visit(self.max_temperature, degc("max_temperature", -273, 1e4, "Maximum temperature."));
  }
};

}  // namespace microswarm::actuation

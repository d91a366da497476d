// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

/// One coil as a load of its amplifier, a resistance and an inductance in series, with its limits.
/// Its resistance grows with its temperature. It heats as a first-order system: at constant power
/// the final temperature is ambient + thermal_resistance · power, approached with the time
/// constant. A limit that is not set is not applied.
struct DriveParams {
  double resistance = 1;
  double temperature_coefficient = 0.00393;
  double inductance = 1;
  double thermal_resistance = 1;
  double thermal_time = 300;
  double ambient = 22;
  std::optional<double> max_current;
  std::optional<double> max_voltage;
  std::optional<double> max_slew;
  std::optional<double> max_temperature;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.resistance,
          {"resistance", Unit::ohm, {1e-6, 1e6}, "Resistance of the coil at 20 °C."});
    visit(self.temperature_coefficient, {"temperature_coefficient",
                                         Unit::per_k,
                                         {0, 0.1},
                                         "Growth of the resistance per kelvin; that of copper."});
    visit(self.inductance, {"inductance", Unit::mh, {0, 1e6}, "Inductance of the coil."});
    visit(self.thermal_resistance, {"thermal_resistance",
                                    Unit::k_per_w,
                                    {0, 1e6},
                                    "Temperature rise over the surroundings per watt."});
    visit(self.thermal_time,
          {"thermal_time", Unit::s, {1e-3, 1e7}, "Time constant of the temperature."});
    visit(self.ambient, {"ambient", Unit::degc, {-273, 1e3}, "Temperature around the coil."});
    visit(self.max_current, {"max_current", Unit::a, {1e-6, 1e6}, "Maximum current."});
    visit(self.max_voltage, {"max_voltage", Unit::v, {1e-6, 1e6}, "Maximum voltage."});
    visit(self.max_slew,
          {"max_slew", Unit::a_per_s, {1e-6, 1e9}, "Maximum rate of change of the current."});
    visit(self.max_temperature,
          {"max_temperature", Unit::degc, {-273, 1e4}, "Maximum temperature."});
  }
};

}  // namespace microswarm

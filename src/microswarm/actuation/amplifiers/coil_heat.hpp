// SPDX-License-Identifier: Apache-2.0
// Thermal model of coils, see AmplifierParams.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "microswarm/actuation/amplifiers/amplifier_params.hpp"

namespace microswarm::actuation {

/// Resistance for the voltage limit: that at the maximum temperature [Ω].
double hot_resistance(const AmplifierParams& d);

/// Final temperature [°C] at this mean square current [A²]; infinity if there is none.
double steady_temperature(const AmplifierParams& d, double mean_square);

/// Temperature [°C] after `dt` seconds at this mean square current [A²], from `temperature`: the
/// exact solution of the thermal RC with a resistance that grows linearly.
double temperature_later(const AmplifierParams& d, double temperature, double mean_square,
                         double dt);

/// Time until the maximum temperature at this mean square current [A²], from `temperature` [s];
/// infinity if it is never reached or there is none.
double time_to_limit(const AmplifierParams& d, double temperature, double mean_square);

/// Time in which a coil without current cools from `temperature` to `to` [s]; 0 if it is not
/// warmer, infinity if it never gets that cold.
double time_to_cool(const AmplifierParams& d, double temperature, double to);

/// Current at which the final temperature is the maximum temperature [A].
double warmest_current(const AmplifierParams& d);

/// Mean square current [A²] that heats the coil from `temperature` to `margin` below its maximum in
/// `seconds`, at the resistance of the hottest coil allowed; negative if it is too hot already.
double mean_square_to_limit(const AmplifierParams& d, double temperature, double seconds,
                            double margin = 0);

/// Ambient temperatures [°C].
Eigen::VectorXd ambient(const std::vector<AmplifierParams>& amplifiers);

/// Maximum temperatures [°C]; the ambient one for coils without a maximum.
Eigen::VectorXd hottest(const std::vector<AmplifierParams>& amplifiers);

/// Temperatures [°C] after `seconds` of maximum current, at most the maximum temperatures.
Eigen::VectorXd heated(const std::vector<AmplifierParams>& amplifiers,
                       const Eigen::VectorXd& temperatures, double seconds);

/// Temperatures [°C] of coils without current, `seconds` after they had `temperatures`; unchanged
/// for a negative time.
Eigen::VectorXd cooled(const std::vector<AmplifierParams>& amplifiers,
                       const Eigen::VectorXd& temperatures, double seconds);

}  // namespace microswarm::actuation

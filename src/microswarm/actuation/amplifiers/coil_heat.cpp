// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/amplifiers/coil_heat.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::actuation {
namespace {

/// Resistance of a coil at a temperature [Ω].
double resistance_at(const AmplifierParams& d, double temperature) {
  constexpr double reference = 20;  // [°C]
  return d.resistance * std::max(0.0, 1 + d.temperature_coefficient * (temperature - reference));
}

/// Relative growth of the heating with temperature at this mean square current [A²]: from 1 on the
/// coil heats faster than it cools, and there is no final temperature.
double feedback(const AmplifierParams& d, double mean_square) {
  return d.temperature_coefficient * d.thermal_resistance * d.resistance * mean_square;
}

}  // namespace

double hot_resistance(const AmplifierParams& d) {
  return d.max_temperature ? resistance_at(d, *d.max_temperature) : d.resistance;
}

double steady_temperature(const AmplifierParams& d, double mean_square) {
  const double kept = 1 - feedback(d, mean_square);
  if (kept <= 0) return infinity;
  return (d.ambient + d.thermal_resistance * resistance_at(d, 0) * mean_square) / kept;
}

double temperature_later(const AmplifierParams& d, double temperature, double mean_square,
                         double dt) {
  const double heat = d.thermal_resistance * resistance_at(d, temperature) * mean_square;
  const double rate = (d.ambient + heat - temperature) / d.thermal_time;  // [K/s], at the start
  const double x = (1 - feedback(d, mean_square)) * dt / d.thermal_time;
  constexpr double small = 1e-9;
  return temperature + rate * dt * (std::abs(x) < small ? 1 - 0.5 * x : (1 - maths::exp(-x)) / x);
}

double time_to_limit(const AmplifierParams& d, double temperature, double mean_square) {
  if (!d.max_temperature || steady_temperature(d, mean_square) <= *d.max_temperature)
    return infinity;
  const auto is_below = [&](double t) {
    return temperature_later(d, temperature, mean_square, t) < *d.max_temperature;
  };
  if (!is_below(0)) return 0;
  double low = 0, high = d.thermal_time;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings && is_below(high); ++i) low = high, high *= 2;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (is_below(middle) ? low : high) = middle;
  }
  return low;
}

double time_to_cool(const AmplifierParams& d, double temperature, double to) {
  if (temperature <= to) return 0;
  if (to <= d.ambient) return infinity;
  return d.thermal_time * maths::log((temperature - d.ambient) / (to - d.ambient));
}

double warmest_current(const AmplifierParams& d) {
  const double warmer = std::max(0.0, *d.max_temperature - d.ambient);
  const double per_square = d.thermal_resistance * hot_resistance(d);
  return per_square > 0 ? std::sqrt(warmer / per_square) : infinity;
}

double mean_square_to_limit(const AmplifierParams& d, double temperature, double seconds,
                            double margin) {
  const double keeps = maths::exp(-seconds / d.thermal_time);
  const double end = (*d.max_temperature - margin - temperature * keeps) / (1 - keeps);
  return (end - d.ambient) / (d.thermal_resistance * hot_resistance(d));
}

Eigen::VectorXd ambient(const std::vector<AmplifierParams>& amplifiers) {
  Eigen::VectorXd least(static_cast<Eigen::Index>(amplifiers.size()));
  for (std::size_t k = 0; k < amplifiers.size(); ++k)
    least[static_cast<Eigen::Index>(k)] = amplifiers[k].ambient;
  return least;
}

Eigen::VectorXd hottest(const std::vector<AmplifierParams>& amplifiers) {
  Eigen::VectorXd most(static_cast<Eigen::Index>(amplifiers.size()));
  for (std::size_t k = 0; k < amplifiers.size(); ++k)
    most[static_cast<Eigen::Index>(k)] =
        amplifiers[k].max_temperature.value_or(amplifiers[k].ambient);
  return most;
}

Eigen::VectorXd heated(const std::vector<AmplifierParams>& amplifiers,
                       const Eigen::VectorXd& temperatures, double seconds) {
  Eigen::VectorXd now = temperatures;
  for (std::size_t k = 0; k < amplifiers.size(); ++k) {
    const AmplifierParams& d = amplifiers[k];
    double& temperature = now[static_cast<Eigen::Index>(k)];
    const double most = std::max(temperature, d.max_temperature.value_or(infinity));
    if (d.max_current)
      temperature = std::min(
          most, temperature_later(d, temperature, *d.max_current * *d.max_current, seconds));
    else if (d.max_temperature)
      temperature = most;
  }
  return now;
}

Eigen::VectorXd cooled(const std::vector<AmplifierParams>& amplifiers,
                       const Eigen::VectorXd& temperatures, double seconds) {
  Eigen::VectorXd now = temperatures;
  for (std::size_t k = 0; k < amplifiers.size(); ++k) {
    double& temperature = now[static_cast<Eigen::Index>(k)];
    temperature = temperature_later(amplifiers[k], temperature, 0, std::max(0.0, seconds));
  }
  return now;
}

}  // namespace microswarm::actuation

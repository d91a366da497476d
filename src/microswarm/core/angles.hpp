// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace microswarm {

inline constexpr double pi = std::numbers::pi;

/// Angle `a` [rad] wrapped to [-π, π]. Every difference of two headings goes through here.
inline double wrap(double a) {
  if (std::abs(a) <= pi) return a;  // the remainder's own answer, without the call
  return std::remainder(a, 2 * pi);
}

/// Absolute difference of two headings [rad], in [0, π].
inline double turn_between(double a, double b) { return std::abs(wrap(a - b)); }

/// Degrees are for people: files, the command line and pictures. Everything else is rad. Both turn
/// over in long double and round once, so that 30° in code and in a file are the same bits.
constexpr double radians(long double degrees) {
  return static_cast<double>(degrees * (std::numbers::pi_v<long double> / 180));
}
constexpr double degrees(double radians) {
  return static_cast<double>(radians * (180 / std::numbers::pi_v<long double>));
}

}  // namespace microswarm

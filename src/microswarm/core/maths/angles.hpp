// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

namespace microswarm {

inline constexpr double pi = std::numbers::pi;

/// Angle `a` [rad] wrapped to [-π, π]. Use it for every difference of two headings.
inline double wrap(double a) {
  if (std::abs(a) <= pi) return a;  // same result as remainder(), without the call
  return std::remainder(a, 2 * pi);
}

/// Absolute difference of two headings [rad], in [0, π].
inline double turn_between(double a, double b) { return std::abs(wrap(a - b)); }

/// Conversions between degrees and radians. Degrees appear only in files, on the command line and
/// in pictures; everything else is in rad. Both compute in long double and round once, so 30° in
/// code and in a file give the same bits.
constexpr double radians(long double degrees) {
  return static_cast<double>(degrees * (std::numbers::pi_v<long double> / 180));
}
constexpr double degrees(double radians) {
  return static_cast<double>(radians * (180 / std::numbers::pi_v<long double>));
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfloat>
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

/// π in all digits of long double; that of libc++ 19 in <numbers> has those of double only.
inline constexpr long double long_pi = 3.141592653589793238462643383279502884L;

/// `x` with the 64 bits of x86's long double where long double has more, so that a file gives the
/// same angles everywhere (Veltkamp's splitting).
constexpr long double in_64_bits(long double x) {
#if LDBL_MANT_DIG > 64
  const long double c = x * ((1ULL << (LDBL_MANT_DIG - 64)) + 1.0L);
  return c - (c - x);
#else
  return x;
#endif
}

/// Conversions between degrees and radians. Degrees appear only in files, on the command line and
/// in pictures; everything else is in rad. Both compute in long double and round once, so 30° in
/// code and in a file give the same bits.
constexpr double radians(long double degrees) {
  constexpr long double turn = in_64_bits(in_64_bits(long_pi) / 180);
  return static_cast<double>(in_64_bits(in_64_bits(degrees) * turn));
}
constexpr double degrees(double radians) {
  constexpr long double turn = in_64_bits(180 / in_64_bits(long_pi));
  return static_cast<double>(in_64_bits(radians * turn));
}

}  // namespace microswarm

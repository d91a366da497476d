// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/maths.hpp"

#include <sleef.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

// Plain sums, products and quotients have the same bits everywhere because nothing is contracted.
// Sine, cosine and atan2 are the most frequent, so they are computed here for ordinary arguments.
// Everything else calls SLEEF, in its plain C variants without fused multiply-add ("cinz … purec"),
// which are meant to give the same bits on every machine.
namespace microswarm::maths {
namespace {

// π/2 = quarter_high + quarter_low; quarter_high times an integer up to 2²⁰ is exact.
constexpr double quarter_high = 0x1.921fb544p+0;
constexpr double quarter_low = 0x1.0b4611a626331p-34;
constexpr double max_reduced = 1000;             // [rad]
constexpr double min_reduced = 0x1p-14;          // closer to a quarter turn, too few bits remain
constexpr double eighth = std::numbers::pi / 4;  // [rad]

/// Angle minus whole quarter turns, as a sum within ±π/4.
struct Reduced {
  double high = 0, low = 0;
  int quarter = 0;
};

/// Reduces `angle`; false if it is not ordinary.
inline bool reduce(double angle, Reduced& left) {
  const double size = std::abs(angle);
  if (size <= eighth) {
    left = {angle, 0, 0};
    return true;
  }
  if (!(size <= max_reduced)) return false;
  constexpr double whole = 0x1.8p52;  // adding and subtracting it rounds
  const double turns = (angle * (2 / std::numbers::pi) + whole) - whole;
  const double off = angle - turns * quarter_high;
  const double rest = turns * quarter_low;
  left.high = off - rest;
  left.low = (off - left.high) - rest;
  left.quarter = static_cast<int>(turns) & 3;
  return std::abs(left.high) >= min_reduced;
}

/// Minimax polynomials for angles within ±π/4.
inline double polynomial_sine(double high, double low) {
  const double z = high * high;
  const double cube = high * z;
  const double p =
      0x1.1111111110ba5p-7 +
      z * (-0x1.a01a019e80693p-13 +
           z * (0x1.71de379252004p-19 + z * (-0x1.ae60069e53ef1p-26 + z * 0x1.5e098556d302ep-33)));
  return high - ((z * (0.5 * low - cube * p) - low) + cube * 0x1.5555555555555p-3);
}
inline double polynomial_cosine(double high, double low) {
  const double z = high * high;
  const double q = 0x1.5555555555555p-5 +
                   z * (-0x1.6c16c16c1696p-10 +
                        z * (0x1.a01a019f4d0edp-16 +
                             z * (-0x1.27e4fa15bd814p-22 +
                                  z * (0x1.1eeb66b683028p-29 + z * -0x1.907c0e63adbb6p-37))));
  const double half = 0.5 * z;
  const double most = 1 - half;
  return most + (((1 - most) - half) + (z * (z * q) - high * low));
}

/// Sine of the angle plus `quarters` quarter turns.
inline double sine_after(const Reduced& left, int quarters) {
  const int quarter = (left.quarter + quarters) & 3;
  const double size = (quarter & 1) == 0 ? polynomial_sine(left.high, left.low)
                                         : polynomial_cosine(left.high, left.low);
  return (quarter & 2) == 0 ? size : -size;
}

/// atan(i / 16) as a sum.
struct Arc {
  double high = 0, low = 0;
};
constexpr double half_turn_low = 0x1.1a62633145c07p-53;  // π minus its double
constexpr int arcs_to_one = 16;
constexpr std::array<Arc, arcs_to_one + 1> arcs{{
    {0, 0},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
}};

}  // namespace

double sin(double angle) {
  Reduced left;
  return reduce(angle, left) ? sine_after(left, 0) : Sleef_cinz_sind1_u10purec(angle);
}

double cos(double angle) {
  Reduced left;
  return reduce(angle, left) ? sine_after(left, 1) : Sleef_cinz_cosd1_u10purec(angle);
}

SineCosine sincos(double angle) {
  Reduced left;
  if (!reduce(angle, left)) {
    const Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(angle);
    return {both.x, both.y};
  }
  double sine = polynomial_sine(left.high, left.low);
  double cosine = polynomial_cosine(left.high, left.low);
  if ((left.quarter & 1) != 0) {
    std::swap(sine, cosine);
    cosine = -cosine;
  }
  return (left.quarter & 2) == 0 ? SineCosine{sine, cosine} : SineCosine{-sine, -cosine};
}

double asin(double x) { return Sleef_cinz_asind1_u10purec(x); }
double acos(double x) { return Sleef_cinz_acosd1_u10purec(x); }

double atan2(double y, double x) {
  const double rise = std::abs(y), run = std::abs(x);
  const bool steep = rise > run;
  const double less = steep ? run : rise, more = steep ? rise : run;
  if (!(less <= more && more >= 1e-30 && more <= 1e30)) return Sleef_cinz_atan2d1_u10purec(y, x);
  // atan(q) = atan(c) + atan((q − c) / (1 + q c)), with c = i / 16 near q; either neighbour will
  // do.
  const float nearest = static_cast<float>(less) / static_cast<float>(more) * arcs_to_one + 0.5F;
  const auto i = static_cast<std::size_t>(nearest);
  const double c = static_cast<double>(i) / arcs_to_one;
  const double t = (less - c * more) / (more + c * less);
  const double z = t * t;
  const double bend = t * z * (-1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 - z / 11))));
  // The angle is this arc, or π/2 or π plus or minus it.
  const double from = steep ? std::numbers::pi / 2 : x < 0 ? std::numbers::pi : 0;
  const double from_low = steep ? half_turn_low / 2 : x < 0 ? half_turn_low : 0;
  const double sign = steep != (x < 0) ? -1 : 1;
  const double high = from + sign * arcs[i].high;
  const double low = (from - high) + sign * arcs[i].high;
  return std::copysign(high + (low + from_low + sign * (t + (bend + arcs[i].low))), y);
}

double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
double expm1(double x) { return Sleef_cinz_expm1d1_u10purec(x); }
double log(double x) { return Sleef_cinz_logd1_u10purec(x); }
double log1p(double x) { return Sleef_cinz_log1pd1_u10purec(x); }
double log10(double x) { return Sleef_cinz_log10d1_u10purec(x); }
double pow(double x, double y) { return Sleef_cinz_powd1_u10purec(x, y); }
double tanh(double x) { return Sleef_cinz_tanhd1_u10purec(x); }

}  // namespace microswarm::maths

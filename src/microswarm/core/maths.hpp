// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The functions of mathematics that results depend on. Those of the C library differ in their last
/// bits between its versions, and on CPUs with and without fused multiply-add; these give the same
/// bits on every CPU, within 1 unit in the last place of the true value where nothing else is said.
/// What IEEE 754 defines to the bit stays the standard library's: sqrt, fma, floor, remainder and
/// their like. A length in the plane is norm() of geometry/vec2.hpp.
namespace microswarm::maths {

/// A sine and a cosine of the same angle.
struct SineCosine {
  double sine = 0;
  double cosine = 1;
};

/// Of an angle [rad]. Both at once take little longer than one of them.
double sin(double angle);
double cos(double angle);
SineCosine sincos(double angle);

/// Angle whose sine or cosine is `x` [rad], in [-π/2, π/2] or [0, π]; not a number beyond [-1, 1].
double asin(double x);
double acos(double x);

/// Angle of the vector (x, y) to the x axis [rad], in [-π, π], within 1.5 units in the last place;
/// 0 for the zero vector.
double atan2(double y, double x);

/// eˣ, and eˣ − 1 where x is small.
double exp(double x);
double expm1(double x);

/// Natural logarithm of x, of 1 + x where x is small, and the decimal one, exact for powers of ten.
double log(double x);
double log1p(double x);
double log10(double x);

/// xʸ.
double pow(double x, double y);

/// xⁿ by repeated squaring: exact where all of the products are, within n units in the last place
/// elsewhere.
constexpr double power(double x, int n) {
  double result = 1;
  for (unsigned left = n < 0 ? 0U - static_cast<unsigned>(n) : static_cast<unsigned>(n); left > 0;
       left /= 2) {
    if (left % 2 == 1) result *= x;
    x *= x;
  }
  return n < 0 ? 1 / result : result;
}

/// Hyperbolic tangent.
double tanh(double x);

}  // namespace microswarm::maths

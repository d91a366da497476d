// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Mathematical functions that results depend on. Those of the C library differ in their last bits
/// between versions, and between CPUs with and without fused multiply-add. These give the same bits
/// on every CPU, within 1 unit in the last place of the true value unless stated otherwise.
/// Functions that IEEE 754 defines exactly stay the standard library's: sqrt, fma, floor, remainder
/// and the like. The length of a vector is norm() in geometry/vec2.hpp.
namespace microswarm::maths {

/// Sine and cosine of one angle.
struct SineCosine {
  double sine = 0;
  double cosine = 1;
};

/// Of an angle [rad]. `sincos` takes little longer than one of them.
double sin(double angle);
double cos(double angle);
SineCosine sincos(double angle);

/// Inverse sine [rad] in [-π/2, π/2] and inverse cosine [rad] in [0, π]; NaN outside [-1, 1].
double asin(double x);
double acos(double x);

/// Angle of the vector (x, y) to the x axis [rad], in [-π, π], within 1.5 units in the last place;
/// 0 for the zero vector.
double atan2(double y, double x);

/// eˣ, and eˣ − 1, accurate for small x.
double exp(double x);
double expm1(double x);

/// Natural logarithm of x, of 1 + x accurate for small x, and decimal logarithm, exact for powers
/// of ten.
double log(double x);
double log1p(double x);
double log10(double x);

/// xʸ.
double pow(double x, double y);

/// xⁿ by repeated squaring: exact if all products are, else within n units in the last place.
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

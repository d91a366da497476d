// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace microswarm::maths::plain {

/// The functions of SLEEF 3.5.1 that maths.hpp calls ("cinz … u10purec"), for machines for which
/// Debian builds no SLEEF: the same steps, so the same bits, which a test compares. Angles above
/// 1e14 rad, for which SLEEF has a table of π, are left to the C library.
double sin(double angle);
double cos(double angle);
double asin(double x);
double acos(double x);
double atan2(double y, double x);
double exp(double x);
double expm1(double x);
double log(double x);
double log1p(double x);
double log10(double x);
double pow(double x, double y);
double tanh(double x);

/// Sine and cosine by SLEEF's sincos, whose last bits are others than those of its sin and cos.
void sincos(double angle, double& sine, double& cosine);

}  // namespace microswarm::maths::plain

/* SPDX-License-Identifier: Apache-2.0 */
/* What maths.cpp calls of SLEEF, where Debian has none: the plain functions with its bits. */
#pragma once

#include "microswarm/core/maths/plain_sleef.hpp"

struct Sleef_double_2 {
  double x, y;
};

#define MICROSWARM_PLAIN(name) \
  inline double Sleef_cinz_##name##d1_u10purec(double x) { return microswarm::maths::plain::name(x); }
#define MICROSWARM_PLAIN_2(name)                                       \
  inline double Sleef_cinz_##name##d1_u10purec(double x, double y) {   \
    return microswarm::maths::plain::name(x, y);                       \
  }
MICROSWARM_PLAIN(sin)
MICROSWARM_PLAIN(cos)
MICROSWARM_PLAIN(asin)
MICROSWARM_PLAIN(acos)
MICROSWARM_PLAIN(exp)
MICROSWARM_PLAIN(expm1)
MICROSWARM_PLAIN(log)
MICROSWARM_PLAIN(log1p)
MICROSWARM_PLAIN(log10)
MICROSWARM_PLAIN(tanh)
MICROSWARM_PLAIN_2(atan2)
MICROSWARM_PLAIN_2(pow)
#undef MICROSWARM_PLAIN
#undef MICROSWARM_PLAIN_2

inline Sleef_double_2 Sleef_cinz_sincosd1_u10purec(double x) {
  Sleef_double_2 both;
  microswarm::maths::plain::sincos(x, both.x, both.y);
  return both;
}

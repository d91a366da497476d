// SPDX-License-Identifier: Apache-2.0
#pragma once

// For plain_sleef.cpp alone. After SLEEF 3.5.1, © Naoki Shibata and contributors 2010-2020, Boost
// Software License 1.0.

#include <bit>
#include <cmath>
#include <cstdint>

namespace microswarm::maths::plain {

/// Sum of two numbers, the second far smaller.
struct Pair {
  double x = 0, y = 0;
  double sum() const { return x + y; }
  Pair operator-() const { return {-x, -y}; }
};
inline double upper(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0xfffffffff8000000);
}
inline Pair normalised(Pair t) {
  const double s = t.x + t.y;
  return {s, t.x - s + t.y};
}
inline Pair scaled(Pair d, double s) { return {d.x * s, d.y * s}; }
/// Sums of which the first term is the larger.
inline Pair add(double x, double y) {
  const double s = x + y;
  return {s, x - s + y};
}
inline Pair add(Pair x, double y) {
  const double s = x.x + y;
  return {s, x.x - s + y + x.y};
}
inline Pair add(double x, Pair y) {
  const double s = x + y.x;
  return {s, x - s + y.x + y.y};
}
inline Pair add(Pair x, Pair y) {
  const double s = x.x + y.x;
  return {s, x.x - s + y.x + x.y + y.y};
}
/// Sums of any terms.
inline Pair add_any(double x, double y) {
  const double s = x + y, v = s - x;
  return {s, x - (s - v) + (y - v)};
}
inline Pair add_any(Pair x, double y) {
  const Pair s = add_any(x.x, y);
  return {s.x, s.y + x.y};
}
inline Pair add_any(double x, Pair y) {
  const Pair s = add_any(x, y.x);
  return {s.x, s.y + y.y};
}
inline Pair add_any(Pair x, Pair y) {
  const Pair s = add_any(x.x, y.x);
  return {s.x, s.y + (x.y + y.y)};
}
inline Pair subtract(Pair x, double y) {
  const double s = x.x - y;
  return {s, x.x - s - y + x.y};
}
inline Pair subtract(Pair x, Pair y) {
  const double s = x.x - y.x;
  return {s, x.x - s - y.x + x.y - y.y};
}
inline Pair multiply(double x, double y) {
  const double xh = upper(x), xl = x - xh, yh = upper(y), yl = y - yh, s = x * y;
  return {s, xh * yh + -s + xl * yh + xh * yl + xl * yl};
}
inline Pair multiply(Pair x, double y) {
  const double xh = upper(x.x), xl = x.x - xh, yh = upper(y), yl = y - yh, s = x.x * y;
  return {s, xh * yh + -s + xl * yh + xh * yl + xl * yl + x.y * y};
}
inline Pair multiply(Pair x, Pair y) {
  const double xh = upper(x.x), xl = x.x - xh, yh = upper(y.x), yl = y.x - yh, s = x.x * y.x;
  return {s, xh * yh + -s + xl * yh + xh * yl + xl * yl + x.x * y.y + x.y * y.x};
}
inline double product(Pair x, Pair y) {
  const double xh = upper(x.x), xl = x.x - xh, yh = upper(y.x), yl = y.x - yh;
  return x.y * yh + xh * y.y + xl * yl + xh * yl + xl * yh + xh * yh;
}
inline Pair squared(Pair x) {
  const double xh = upper(x.x), xl = x.x - xh, s = x.x * x.x;
  return {s, xh * xh + -s + (xh + xh) * xl + xl * xl + x.x * (x.y + x.y)};
}
inline double square(Pair x) {
  const double xh = upper(x.x), xl = x.x - xh;
  return xh * x.y + xh * x.y + xl * xl + (xh * xl + xh * xl) + xh * xh;
}
inline Pair divide(Pair n, Pair d) {
  const double t = 1 / d.x, dh = upper(d.x), dl = d.x - dh, th = upper(t), tl = t - th;
  const double nh = upper(n.x), nl = n.x - nh, s = n.x * t;
  const double u =
      nh * th - s + nh * tl + nl * th + nl * tl + s * (1 - dh * th - dh * tl - dl * th - dl * tl);
  return {s, t * (n.y - s * d.y) + u};
}
inline Pair reciprocal(double d) {
  const double t = 1 / d, dh = upper(d), dl = d - dh, th = upper(t), tl = t - th;
  return {t, t * (1 - dh * th - dh * tl - dl * th - dl * tl)};
}
inline Pair reciprocal(Pair d) {
  const double t = 1 / d.x, dh = upper(d.x), dl = d.x - dh, th = upper(t), tl = t - th;
  return {t, t * (1 - dh * th - dh * tl - dl * th - dl * tl - d.y * t)};
}
inline Pair root(double d) {
  const double t = std::sqrt(d);
  return scaled(multiply(add_any(d, multiply(t, t)), reciprocal(t)), 0.5);
}

}  // namespace microswarm::maths::plain

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/predicates.hpp"

#include <array>

namespace microswarm {
namespace {

/// Exact value of a sum or product: `high` is the rounded result, `low` the remainder.
struct Exact {
  double high;
  double low;
};

Exact two_sum(double a, double b) {
  const double sum = a + b;
  const double virtual_b = sum - a;
  return {sum, (a - (sum - virtual_b)) + (b - virtual_b)};
}

Exact two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

/// Exact sum of doubles as a non-overlapping expansion, smallest component first, zeros dropped
/// (Shewchuk 1997, Grow-Expansion).
struct Expansion {
  std::array<double, 12> parts;
  int size = 0;

  void add(double value) {
    int kept = 0;
    for (int i = 0; i < size; ++i) {
      const Exact s = two_sum(value, parts[i]);
      if (s.low != 0) parts[kept++] = s.low;
      value = s.high;
    }
    if (value != 0) parts[kept++] = value;
    size = kept;
  }
  void add(Exact e) {
    add(e.low);
    add(e.high);
  }
  int sign() const { return size == 0 ? 0 : parts[size - 1] > 0 ? 1 : -1; }
};

/// Sign of a·b − c·d. Rounding is monotone, so the rounded products decide unless they are equal.
int compare_products(double a, double b, double c, double d) {
  const Exact left = two_product(a, b);
  const Exact right = two_product(c, d);
  if (left.high != right.high) return left.high > right.high ? 1 : -1;
  return left.low == right.low ? 0 : left.low > right.low ? 1 : -1;
}

/// Scales by a power of two (exact) so that no product of coordinates underflows.
void scale_up(Vec2& a, Vec2& b, Vec2& c) {
  const double largest = std::max(
      {std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y), std::abs(c.x), std::abs(c.y)});
  if (largest == 0) return;
  const double scale = std::ldexp(1.0, std::min(480 - std::ilogb(largest), 1000));
  a = scale * a;
  b = scale * b;
  c = scale * c;
}

}  // namespace

int exact_orientation(Vec2 a, Vec2 b, Vec2 c) {
  if ((a.x == c.x || b.y == c.y) && (a.y == c.y || b.x == c.x)) return 0;
  scale_up(a, b, c);
  const Exact ax = two_sum(a.x, -c.x);
  const Exact ay = two_sum(a.y, -c.y);
  const Exact bx = two_sum(b.x, -c.x);
  const Exact by = two_sum(b.y, -c.y);
  if (ax.low == 0 && ay.low == 0 && bx.low == 0 && by.low == 0) {
    return compare_products(ax.high, by.high, ay.high, bx.high);
  }
  Expansion det;
  det.add(two_product(a.x, b.y));
  det.add(two_product(-a.y, b.x));
  det.add(two_product(b.x, c.y));
  det.add(two_product(-b.y, c.x));
  det.add(two_product(c.x, a.y));
  det.add(two_product(-c.y, a.x));
  return det.sign();
}

bool intersects(Segment s, Segment t) {
  if (std::max(s.a.x, s.b.x) < std::min(t.a.x, t.b.x) ||
      std::max(t.a.x, t.b.x) < std::min(s.a.x, s.b.x) ||
      std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) ||
      std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y)) {
    return false;
  }
  return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) <= 0 &&
         orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) <= 0;
}

Side locate(const Polygon& polygon, Vec2 p) {
  bool inside = false;
  bool boundary = false;
  // Parity of the edges to the right of p. An edge includes its lower end, so a vertex counts once.
  for_each_edge(polygon, [&](Vec2 a, Vec2 b) {
    if ((a.y <= p.y) != (b.y <= p.y)) {
      if (p.x > std::max(a.x, b.x)) return;
      if (p.x < std::min(a.x, b.x)) {
        inside = !inside;
        return;
      }
      const int side = orientation(a, b, p);
      if (side == 0) boundary = true;
      if ((side > 0) == (b.y > a.y)) inside = !inside;
    } else if (p == b || (a.y == p.y && b.y == p.y && (a.x < p.x) != (b.x < p.x))) {
      boundary = true;
    }
  });
  return boundary ? Side::boundary : inside ? Side::inside : Side::outside;
}

}  // namespace microswarm

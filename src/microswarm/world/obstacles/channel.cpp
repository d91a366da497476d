// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/channel.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/geometry/predicates.hpp"

namespace microswarm {
namespace {

constexpr double sample_spacing = 25;
constexpr double max_samples = 4000;

/// Point on the centre line, with its arc length and direction.
struct Station {
  Vec2 position;
  Vec2 direction;
  double s;
};

std::vector<Vec2> without_repeats(std::vector<Vec2> points) {
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// Tangents at the points of the natural cubic spline over chord length, approximately the curve of
/// least bending through the points.
std::vector<Vec2> spline_tangents(const std::vector<Vec2>& p) {
  const std::size_t n = p.size();
  std::vector<Vec2> m(n);
  std::vector<double> diagonal(n, 0);
  auto chord = [&](std::size_t i) { return distance(p[i], p[i + 1]); };
  auto slope = [&](std::size_t i) { return 3 / (chord(i) * chord(i)) * (p[i + 1] - p[i]); };
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0) {
      diagonal[i] += 2 / chord(i - 1);
      m[i] += slope(i - 1);
    }
    if (i + 1 < n) {
      diagonal[i] += 2 / chord(i);
      m[i] += slope(i);
    }
  }
  for (std::size_t i = 1; i < n; ++i) {  // elimination, then substitution
    const double share = 1 / (chord(i - 1) * diagonal[i - 1]);
    diagonal[i] -= share / chord(i - 1);
    m[i] -= share * m[i - 1];
  }
  m[n - 1] = m[n - 1] / diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) m[i] = (m[i] - m[i + 1] / chord(i)) / diagonal[i];
  return m;
}

std::vector<Station> stations(const DeformingChannel& channel) {
  const std::vector<Vec2> p = without_repeats(channel.centre_line);
  std::vector<Station> out;
  if (p.size() < 2) return out;
  double total = 0;
  for (std::size_t i = 1; i < p.size(); ++i) total += distance(p[i - 1], p[i]);
  const double spacing = std::max(sample_spacing, total / max_samples);
  const std::vector<Vec2> tangents = spline_tangents(p);
  Vec2 forwards{1, 0};
  auto add = [&](Vec2 position, Vec2 direction) {
    const double s = out.empty() ? 0 : out.back().s + distance(out.back().position, position);
    if (const double speed = norm(direction); speed > 0) forwards = direction / speed;
    out.push_back({position, forwards, s});
  };
  add(p[0], tangents[0]);
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const Vec2 m0 = distance(p[i], p[i + 1]) * tangents[i];
    const Vec2 m1 = distance(p[i], p[i + 1]) * tangents[i + 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(distance(p[i], p[i + 1]) / spacing)));
    for (int k = 1; k <= steps; ++k) {
      const double u = static_cast<double>(k) / steps;
      const double v = 1 - u;
      const Vec2 at = (v * v * (1 + 2 * u)) * p[i] + (u * v * v) * m0 +
                      (u * u * (3 - 2 * u)) * p[i + 1] - (u * u * v) * m1;
      const Vec2 derivative =
          (6 * u * v) * (p[i + 1] - p[i]) + (v * (1 - 3 * u)) * m0 + (u * (3 * u - 2)) * m1;
      add(k == steps ? p[i + 1] : at, derivative);
    }
  }
  return out;
}

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// Half width at rest at `s` µm along a centre line of the given length.
double half_width_at(const DeformingChannel& channel, double s, double length) {
  const double to_end = std::min(s, length - s);
  const double share = channel.end_length > 0 ? 1 - to_end / channel.end_length : 0;
  return channel.half_width + (channel.end_half_width - channel.half_width) * smooth_step(share);
}

/// Half circle about `centre` starting at `from`, without its ends.
void add_cap(Vec2 centre, Vec2 from, double radius, std::vector<Vec2>& ring) {
  const int pieces = std::max(8, static_cast<int>(std::ceil(pi * radius / sample_spacing)));
  for (int k = 1; k < pieces; ++k) {
    ring.push_back(centre + radius * rotated(from, pi * k / pieces));
  }
}

/// Right side forwards, a cap, left side back, a cap; `width(s)` is the half width.
template <class Width>
std::vector<Vec2> outline(const std::vector<Station>& line, Width&& width) {
  std::vector<Vec2> ring;
  if (line.empty()) return ring;
  ring.reserve(2 * line.size() + 64);
  auto side = [&](const Station& at, double sign) {
    ring.push_back(at.position + (sign * width(at.s)) * perpendicular(at.direction));
  };
  for (const Station& at : line) side(at, -1);
  const Station& last = line.back();
  add_cap(last.position, -perpendicular(last.direction), width(last.s), ring);
  std::for_each(line.rbegin(), line.rend(), [&](const Station& at) { side(at, 1); });
  const Station& first = line.front();
  add_cap(first.position, perpendicular(first.direction), width(first.s), ring);
  return ring;
}

Box bounding_block(const DeformingChannel& channel) {
  const Vec2 half{0.5 * channel.block_width, 0.5 * channel.block_height};
  return {channel.block_centre - half, channel.block_centre + half};
}

std::string rounded_text(Vec2 v) {
  std::string out = "(";
  return out.append(number_text(std::round(v.x))) + ", " + number_text(std::round(v.y)) + ")";
}

/// The four corners of the walls between two stations must form a convex quadrilateral; then no
/// narrower wall can fold there either.
bool folds(const Station& a, const Station& b, double wa, double wb) {
  const Vec2 na = perpendicular(a.direction);
  const Vec2 nb = perpendicular(b.direction);
  const Vec2 c[4] = {a.position - wa * na, b.position - wb * nb, b.position + wb * nb,
                     a.position + wa * na};
  for (int k = 0; k < 4; ++k) {
    if (orientation(c[k], c[(k + 1) % 4], c[(k + 2) % 4]) <= 0) return true;
  }
  return false;
}

bool crosses_itself(const std::vector<Vec2>& ring) {
  const std::size_t n = ring.size();
  auto edge = [&](std::size_t i) { return Segment{ring[i], ring[(i + 1) % n]}; };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (intersects(edge(i), edge(j))) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Vec2> channel_outline(const DeformingChannel& channel, double t) {
  const std::vector<Station> line = stations(channel);
  const double length = line.empty() ? 0 : line.back().s;
  const double turns = t / channel.period;
  const double shift = turns - std::floor(turns);
  return outline(line, [&](double s) {
    return half_width_at(channel, s, length) +
           channel.amplitude * maths::sin(2 * pi * (s / channel.wavelength - shift));
  });
}

Polygon channel_block(const DeformingChannel& channel, double t) {
  const Box block = bounding_block(channel);
  std::vector<Vec2> hole = channel_outline(channel, t);
  std::reverse(hole.begin(), hole.end());
  return {{block.lo, {block.hi.x, block.lo.y}, block.hi, {block.lo.x, block.hi.y}},
          {std::move(hole)}};
}

// If the channel at its maximum width neither folds nor intersects itself, it is a mesh of convex
// pieces, in which every narrower outline is simple too.
Issues validate(const DeformingChannel& channel) {
  Issues issues;
  const auto is_wrong = [&](std::string_view key, std::string text) {
    issues.add(key, std::move(text));
    return issues;
  };
  const std::vector<Station> line = stations(channel);
  if (line.empty())
    return is_wrong("centre_line_um", "centre_line_um needs two different points at least");
  const double narrowest = std::min(channel.half_width, channel.end_half_width);
  if (channel.amplitude >= narrowest)
    return is_wrong("amplitude_um", "amplitude_um is " + number_text(channel.amplitude) +
                                        ", closes the channel, whose half width is " +
                                        number_text(narrowest) + " µm");
  const double length = line.back().s;
  auto widest = [&](double s) { return half_width_at(channel, s, length) + channel.amplitude; };
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (!folds(line[i - 1], line[i], widest(line[i - 1].s), widest(line[i].s))) continue;
    return is_wrong("centre_line_um", "the bend at " + rounded_text(line[i].position) +
                                          " is too tight for a half width of " +
                                          number_text(std::round(widest(line[i].s))) + " µm");
  }
  const std::vector<Vec2> ring = outline(line, widest);
  if (crosses_itself(ring)) return is_wrong("centre_line_um", "the channel runs into itself");
  const Box block = bounding_block(channel);
  for (const Vec2 v : ring) {
    if (v.x > block.lo.x && v.x < block.hi.x && v.y > block.lo.y && v.y < block.hi.y) continue;
    return is_wrong("centre_line_um", "the channel leaves its block at " + rounded_text(v));
  }
  return issues;
}

}  // namespace microswarm

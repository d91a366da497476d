// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/ring_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/statistics.hpp"

namespace microswarm::vision {
std::optional<Ring> circle_through(const std::vector<Vec2>& points) {
  if (points.size() < 3) return std::nullopt;
  const double n = static_cast<double>(points.size());
  Vec2 mean;
  for (const Vec2 p : points) mean += p / n;
  double xx = 0;
  double xy = 0;
  double yy = 0;
  double square = 0;
  Vec2 pull;
  for (const Vec2 p : points) {
    const Vec2 d = p - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
    square += squared_norm(d);
    pull += 0.5 * squared_norm(d) * d;
  }
  const double det = xx * yy - xy * xy;
  if (det <= 1e-9 * square * square) return std::nullopt;
  const Vec2 centre{(pull.x * yy - pull.y * xy) / det, (pull.y * xx - pull.x * xy) / det};
  return Ring{mean + centre, std::sqrt(squared_norm(centre) + square / n)};
}

std::optional<Ring> enclosing_circle(const std::vector<Vec2>& points) {
  if (points.empty()) return std::nullopt;
  std::vector<cv::Point2f> single;
  single.reserve(points.size());
  for (const Vec2 p : points) single.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
  cv::Point2f centre;
  float radius = 0;
  cv::minEnclosingCircle(single, centre, radius);
  return Ring{{centre.x, centre.y}, radius};
}

namespace {

constexpr int max_fit_rounds = 10;
constexpr double still = 1e-3;    // [px] smaller moves of the centre count as convergence
constexpr double ray_step = 0.5;  // [px]
constexpr double min_agreeing = 1.0 / 3;
constexpr double far_off = 3;  // median deviations; farther points are outliers

/// Bilinearly interpolated grey; empty outside the picture.
std::optional<double> grey_at(const formats::Image& grey, Vec2 p) {
  const double column = std::floor(p.x);
  const double row = std::floor(p.y);
  if (column < 0 || row < 0 || column + 1 >= grey.width || row + 1 >= grey.height)
    return std::nullopt;
  const std::uint8_t* upper =
      grey.pixels.data() + grey.index(static_cast<int>(column), static_cast<int>(row));
  const std::uint8_t* lower = upper + grey.width;
  const double u = p.x - column;
  const double v = p.y - row;
  return (1 - v) * ((1 - u) * upper[0] + u * upper[1]) + v * ((1 - u) * lower[0] + u * lower[1]);
}

/// Distance from the centre to the darkest point on a ray between `from` and `to`; empty if that is
/// an end of the range.
std::optional<double> darkest(const formats::Image& grey, Vec2 centre, Vec2 direction, double from,
                              double to, double sign) {
  std::vector<double> values;
  for (double r = from; r <= to; r += ray_step) {
    const auto value = grey_at(grey, centre + r * direction);
    if (!value) return std::nullopt;
    values.push_back(sign * *value);
  }
  const auto least = std::min_element(values.begin(), values.end());
  if (least == values.begin() || least + 1 >= values.end()) return std::nullopt;
  const double bend = least[-1] - 2 * least[0] + least[1];
  const double shift = bend > 0 ? 0.5 * (least[-1] - least[1]) / bend : 0;
  return from + ray_step * (static_cast<double>(least - values.begin()) + shift);
}

std::vector<Vec2> ring_points(const formats::Image& grey, const Ring& guess, double reach,
                              double sign, int rays) {
  std::vector<Vec2> points;
  for (int i = 0; i < rays; ++i) {
    const Vec2 direction = unit_vector(2 * pi * i / rays);
    const auto r = darkest(grey, guess.centre_px, direction, std::max(0.0, guess.radius_px - reach),
                           guess.radius_px + reach, sign);
    if (r) points.push_back(guess.centre_px + *r * direction);
  }
  return points;
}

/// Circle through points, refitted without outliers of the first fit.
std::optional<Ring> robust_circle(std::vector<Vec2> points) {
  auto ring = circle_through(points);
  if (!ring) return std::nullopt;
  std::vector<double> off;
  off.reserve(points.size());
  for (const Vec2 p : points)
    off.push_back(std::abs(distance(p, ring->centre_px) - ring->radius_px));
  const double allowed = std::max(ray_step, far_off * median(off));
  std::erase_if(points, [&](Vec2 p) {
    return std::abs(distance(p, ring->centre_px) - ring->radius_px) > allowed;
  });
  return circle_through(points);
}

}  // namespace

std::optional<Ring> fit_ring(const formats::Image& grey, Vec2 start, double radius, bool dark) {
  assert(grey.channels == 1);
  const int rays = std::max(12, static_cast<int>(2 * pi * radius));
  const double reach = 0.5 * radius;
  Ring ring{start, radius};
  for (int round = 0; round < max_fit_rounds; ++round) {
    const auto points = ring_points(grey, ring, reach, dark ? 1 : -1, rays);
    const auto next = robust_circle(points);
    if (!next || static_cast<double>(points.size()) < min_agreeing * rays ||
        std::abs(next->radius_px - radius) > reach || distance(next->centre_px, start) > radius)
      return std::nullopt;
    const double moved = distance(next->centre_px, ring.centre_px);
    ring = *next;
    if (moved < still) break;
  }
  return ring;
}

}  // namespace microswarm::vision

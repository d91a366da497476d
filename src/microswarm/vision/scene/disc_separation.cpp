// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/disc_separation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

namespace microswarm::vision {
namespace {

constexpr int fit_rounds = 8;
constexpr double first_reach = 4;      // [px] of a circle in the first round, beyond the tolerance
constexpr double min_arc = 1.0 / 8;    // of a circle that the outline must show to move it
constexpr double size_weight = 0.25;   // of the expected radius, in circumferences
constexpr double max_change = 0.25;    // of the radius
constexpr double place_weight = 1e-3;  // keeps the fit regular

double signed_gap(const Ring& ring, Vec2 p) { return distance(p, ring.centre_px) - ring.radius_px; }

/// One step of Gauss and Newton towards the circle through the points.
Ring step(const Ring& ring, double usual_radius, const std::vector<Vec2>& points) {
  const double circumference = 2 * std::numbers::pi * usual_radius;
  cv::Matx33d normal = place_weight * cv::Matx33d::eye();
  normal(2, 2) += size_weight * circumference;
  cv::Matx31d right(0, 0, size_weight * circumference * (usual_radius - ring.radius_px));
  for (const Vec2 p : points) {
    const Vec2 out = p - ring.centre_px;
    const double length = norm(out);
    if (length == 0) continue;
    const cv::Matx31d slope(out.x / length, out.y / length, 1);
    normal += slope * slope.t();
    right += (length - ring.radius_px) * slope;
  }
  const cv::Matx31d move = normal.solve(right, cv::DECOMP_LU);
  return {ring.centre_px + Vec2{move(0), move(1)}, ring.radius_px + move(2)};
}

/// The circle that the point is nearest to, if it is within `limit` of it.
std::size_t nearest(const std::vector<Ring>& rings, Vec2 p, double limit) {
  std::size_t best = rings.size();
  for (std::size_t k = 0; k < rings.size(); ++k)
    if (const double off = std::abs(signed_gap(rings[k], p)); off < limit) {
      limit = off;
      best = k;
    }
  return best;
}

/// Whether the point is where the images of two discs join.
bool is_bridge(const std::vector<Ring>& rings, Vec2 p, double limit) {
  int near = 0;
  for (const Ring& ring : rings) {
    const double off = signed_gap(ring, p);
    if (off < 0) return false;
    near += off <= limit;
  }
  return near >= 2;
}

}  // namespace

std::vector<Ring> separated_discs(std::span<const Vec2> outline, std::span<const Ring> expected,
                                  const DiscSeparation& limits) {
  std::vector<Ring> rings(expected.begin(), expected.end());
  if (rings.empty()) return {};
  std::vector<std::vector<Vec2>> own(rings.size());
  for (int round = 0; round < fit_rounds; ++round) {
    const double limit =
        limits.tolerance + first_reach * (1 - static_cast<double>(round) / fit_rounds);
    for (auto& points : own) points.clear();
    for (const Vec2 p : outline)
      if (const std::size_t k = nearest(rings, p, limit); k < rings.size()) own[k].push_back(p);
    for (std::size_t k = 0; k < rings.size(); ++k) {
      const double usual = expected[k].radius_px;
      if (static_cast<double>(own[k].size()) < min_arc * 2 * std::numbers::pi * usual)
        rings[k] = expected[k];
      else
        rings[k] = step(rings[k], usual, own[k]);
    }
  }
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const double usual = expected[k].radius_px;
    if (!(std::abs(rings[k].radius_px - usual) <= max_change * usual) ||
        !(distance(rings[k].centre_px, expected[k].centre_px) <= usual))
      return {};
  }
  const bool explained = std::all_of(outline.begin(), outline.end(), [&](Vec2 p) {
    return nearest(rings, p, limits.tolerance) < rings.size() || is_bridge(rings, p, limits.bridge);
  });
  return explained ? rings : std::vector<Ring>{};
}

}  // namespace microswarm::vision

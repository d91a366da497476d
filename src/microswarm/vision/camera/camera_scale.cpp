// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/camera_scale.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::vision {

/// Least squares of position = c · at + d in complex numbers, with the y axis of `at` pointing up.
FittedScale fit_scale(std::span<const ScalePoint> points, bool y_up) {
  const auto turned = [&](Vec2 p) { return Vec2{p.x, y_up ? -p.y : p.y}; };
  const auto n = static_cast<double>(points.size());
  Vec2 middle_px;
  Vec2 middle;
  for (const ScalePoint& p : points) {
    middle_px += p.at_px / n;
    middle += p.position / n;
  }
  double along = 0;
  double across = 0;
  double square = 0;
  for (const ScalePoint& p : points) {
    const Vec2 at = turned(p.at_px - middle_px);
    along += dot(at, p.position - middle);
    across += cross(at, p.position - middle);
    square += squared_norm(at);
  }
  const double um_per_px = norm({along, across}) / square;
  if (!(square > 0 && um_per_px > 0 && std::isfinite(um_per_px)))
    throw InputError("scale: two different points are needed");
  FittedScale fit{
      .scale = {.um_per_px = um_per_px, .rotation = heading_along({along, across}), .y_up = y_up}};
  // The origin follows from to_picture(middle) = middle_px.
  fit.scale.origin_px = middle_px - fit.scale.to_picture(middle);
  double squares = 0;
  fit.residuals.reserve(points.size());
  for (const ScalePoint& p : points) {
    const double off = distance(fit.scale.to_world(p.at_px), p.position);
    fit.residuals.push_back(off);
    fit.worst = std::max(fit.worst, off);
    squares += off * off;
  }
  fit.rms = std::sqrt(squares / n);
  return fit;
}

CameraScale scale_of_distance(Vec2 a_px, Vec2 b_px, double distance_um, int height,
                              std::optional<Vec2> origin_px, bool y_up) {
  const double length = distance(a_px, b_px);
  if (!(length > 0)) throw InputError("scale: the two points are one");
  if (!(distance_um > 0))
    throw InputError("distance_um: is " + number_text(distance_um) + ", must be above 0");
  CameraScale scale = upright_scale(height, distance_um / length);
  if (!(scale.um_per_px >= 1e-6 && scale.um_per_px <= 1e6))
    throw InputError("scale: " + number_text(scale.um_per_px) + " µm a pixel, allowed 1e-6..1e6");
  scale.y_up = y_up;
  if (!y_up) scale.origin_px.y = -0.5;  // y points down from the upper edge
  if (origin_px) scale.origin_px = *origin_px;
  return scale;
}

Polygon polygon_in_world(const Polygon& in_picture, const CameraScale& scale) {
  Polygon polygon = in_picture;
  const auto to_world = [&](std::vector<Vec2>& ring) {
    for (Vec2& p : ring) p = scale.to_world(p);
  };
  to_world(polygon.outer);
  for (auto& hole : polygon.holes) to_world(hole);
  return normalised(std::move(polygon));
}

}  // namespace microswarm::vision

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "microswarm/geometry/distance.hpp"

namespace microswarm {
namespace {

Body moved(const Body& body, double t) {
  Body out = body;
  const Vec2 by = t * body.velocity;
  if (auto* disc = std::get_if<Disc>(&out.shape)) {
    disc->centre += by;
    disc->radius += t * body.deformation_speed;
    return out;
  }
  auto& polygon = std::get<Polygon>(out.shape);
  for (Vec2& v : polygon.outer) v += by;
  for (auto& hole : polygon.holes)
    for (Vec2& v : hole) v += by;
  return out;
}

double extent(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body.shape)) return disc->radius;
  const Box box = bounding_box(std::get<Polygon>(body.shape));
  return 0.5 * std::min(box.width(), box.height());
}

}  // namespace

double forecast_clearance(const Snapshot& seen, Segment s, double t0, double t1, double limit) {
  const auto bodies = seen.moving().bodies();
  const bool all_rest =
      std::all_of(bodies.begin(), bodies.end(), [](const Body& b) { return b.velocity == Vec2{}; });
  if (all_rest) {
    double growth = 0;
    for (const Body& b : bodies) growth = std::max(growth, b.deformation_speed);
    return std::min(limit, seen.moving().clearance(s, limit + growth * t1) - growth * t1);
  }
  double least = limit;
  for (const Body& body : bodies) {
    const Segment own_frame{s.a - t0 * body.velocity, s.b - t1 * body.velocity};
    const double d =
        std::visit([&](const auto& shape) { return distance(own_frame, shape); }, body.shape);
    least = std::min(least, d - body.deformation_speed * t1);
  }
  return least;
}

Snapshot drawn_out(const Snapshot& seen, double horizon, double r) {
  constexpr double enough_copies = 8;
  constexpr double most_copies = 100;
  std::vector<Body> bodies;
  for (const Body& body : seen.moving().bodies()) {
    const double way = norm(body.velocity) * horizon;
    const double size = std::max(1.0, extent(body));
    // Copies that close up; of a small and fast body fewer, but no path fits between two of them.
    const double without_gap = std::max(enough_copies, std::ceil(way / (size + r)));
    const int copies =
        static_cast<int>(std::min({std::ceil(way / size), without_gap, most_copies}));
    for (int k = 0; k <= copies; ++k)
      bodies.push_back(copies == 0 ? body : moved(body, horizon * k / copies));
  }
  return Snapshot(seen.shared_map(), seen.time(), std::move(bodies));
}

}  // namespace microswarm

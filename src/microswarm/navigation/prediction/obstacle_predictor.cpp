// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/obstacle_predictor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::navigation {
namespace {

constexpr double rest_speed = 1e-6;  // smaller values are rounding [µm/s]

double inradius_bound(const Body& body) {
  return std::visit(Overloaded{[](const Disc& disc) { return disc.radius; },
                               [](const Polygon& polygon) {
                                 const Box box = bounding_box(polygon);
                                 return 0.5 * std::min(box.width(), box.height());
                               }},
                    body.shape);
}

/// Grows a disc; a polygon keeps its size.
void grow(Body& body, double by) {
  std::visit(Overloaded{[&](Disc& disc) { disc.radius += by; }, [](const Polygon&) {}}, body.shape);
}

}  // namespace

void ObstaclePredictor::update(const Observation& observation) {
  if (!observation.world) return;
  tracker_.update(observation);
  const auto bodies = observation.world->moving().bodies();
  motions_.assign(bodies.size(), {});
  all_rest_ = true;
  for (std::size_t i = 0; i < bodies.size() && i < tracker_.size(); ++i) {
    const TrackedBody tracked = tracker_.body(i);
    const bool moves = norm(tracked.velocity) >
                       std::max(rest_speed, tuning_.min_significance * tracked.velocity_error);
    motions_[i] = {moves ? tracked.velocity : Vec2{}, outward_speed(bodies[i], tracked)};
    all_rest_ = all_rest_ && !moves;
  }
}

double ObstaclePredictor::clearance(const Snapshot& frame, Segment s, double t0, double t1,
                                    double limit) const {
  const auto bodies = frame.moving().bodies();
  assert(bodies.size() == motions_.size());
  if (all_rest_) {  // the indexed query is sufficient
    double growth = 0;
    for (const Motion& m : motions_) growth = std::max(growth, m.growth);
    growth *= std::min(t1, tuning_.growth_time);
    return std::min(limit, frame.moving().clearance(s, limit + growth) - growth);
  }
  double least = limit;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Motion& motion = motions_[i];
    const Segment own_frame{s.a - t0 * motion.velocity, s.b - t1 * motion.velocity};
    const double d = distance(own_frame, bodies[i]);
    least = std::min(least, d - motion.growth * std::min(t1, tuning_.growth_time));
  }
  return least;
}

Snapshot ObstaclePredictor::swept_obstacles(const Snapshot& frame, double horizon, double r) const {
  // Resolution of the sweep and limit of its cost.
  constexpr double enough_copies = 8;
  constexpr double max_copies = 100;
  const auto bodies = frame.moving().bodies();
  assert(bodies.size() == motions_.size());
  std::vector<Body> swept;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Motion& motion = motions_[i];
    const double travel = norm(motion.velocity) * horizon;
    const double size = std::max(1.0, inradius_bound(bodies[i]));
    // Copies without gaps between them; fewer for a small fast body, but no path fits between two
    // of them.
    const double without_gap = std::max(enough_copies, std::ceil(travel / (size + r)));
    const int copies =
        static_cast<int>(std::min({std::ceil(travel / size), without_gap, max_copies}));
    for (int k = 0; k <= copies; ++k) {
      swept.push_back(bodies[i]);
      if (copies == 0) continue;
      const double t = horizon * k / copies;
      shift(swept.back(), t * motion.velocity);
      grow(swept.back(), t * motion.growth);
    }
  }
  return Snapshot(frame.shared_map(), frame.time(), std::move(swept));
}

}  // namespace microswarm::navigation

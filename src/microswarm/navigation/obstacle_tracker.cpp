// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/obstacle_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace microswarm {
namespace {

Vec2 centroid(std::span<const Vec2> ring) {
  const Vec2 origin = ring.front();
  Vec2 sum;
  double twice_area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - origin;
    const Vec2 b = ring[(i + 1) % ring.size()] - origin;
    sum += cross(a, b) * (a + b);
    twice_area += cross(a, b);
  }
  if (twice_area == 0) return bounding_box(ring).centre();
  return origin + sum / (3 * twice_area);
}

const std::vector<Vec2>* outline_of(const Body& body) {
  const auto* polygon = std::get_if<Polygon>(&body.shape);
  return polygon ? &polygon->outer : nullptr;
}

/// Sightings from which the noise is told, in windows of a fit.
constexpr std::size_t windows = 4;

/// Keeps the newest `most` that are at most `memory` old.
void remember(std::vector<Sighting>& trail, Sighting newest, std::size_t most, double memory) {
  const auto outdated = [&](const Sighting& s) { return s.t < newest.t - memory; };
  std::erase_if(trail, outdated);
  if (trail.size() >= most) trail.erase(trail.begin());
  trail.push_back(newest);
}

}  // namespace

double outward_speed(const Body& body, const TrackedBody& motion) {
  return std::holds_alternative<Disc>(body.shape) ? std::max(0.0, motion.radius_rate)
                                                  : motion.outline_speed;
}

Disc extent_of(const Body& body) {
  if (const auto* disc = std::get_if<Disc>(&body.shape)) return *disc;
  const std::vector<Vec2>& outline = *outline_of(body);
  Disc extent{centroid(outline), 0};
  for (const Vec2 v : outline) extent.radius = std::max(extent.radius, distance(extent.centre, v));
  return extent;
}

void ObstacleTracker::see(const Observation& observation) {
  if (!observation.world || !std::isfinite(observation.seen)) return;
  const bool same_count = observation.world->moving().bodies().size() == bodies_.size();
  if (observation.seen == seen_ && same_count) return;
  if (observation.seen <= seen_) trails_.clear();
  seen_ = observation.seen;
  take(*observation.world);
}

void ObstacleTracker::take(const Snapshot& frame) {
  std::erase_if(trails_,
                [&](const Trail& t) { return t.places.back().t < seen_ - params_.memory; });
  bodies_.clear();
  const auto bodies = frame.moving().bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto same = [&](const Body& b) { return b.obstacle == bodies[i].obstacle; };
    const auto leaf = std::count_if(bodies.begin(), bodies.begin() + static_cast<long>(i), same);
    Trail& trail = trail_of(bodies[i].obstacle, static_cast<std::uint32_t>(leaf));
    extend(trail, bodies[i]);
    bodies_.push_back(told_by(trail));
  }
}

ObstacleTracker::Trail& ObstacleTracker::trail_of(std::uint32_t obstacle, std::uint32_t leaf) {
  const auto key = [](const Trail& t) { return std::pair(t.obstacle, t.leaf); };
  const auto at = std::lower_bound(trails_.begin(), trails_.end(), std::pair(obstacle, leaf),
                                   [&](const Trail& t, const auto& k) { return key(t) < k; });
  if (at != trails_.end() && key(*at) == std::pair(obstacle, leaf)) return *at;
  Trail fresh;
  fresh.obstacle = obstacle;
  fresh.leaf = leaf;
  const std::size_t most = windows * static_cast<std::size_t>(params_.frames);
  fresh.places.reserve(most);
  fresh.radii.reserve(most);
  return *trails_.insert(at, std::move(fresh));
}

void ObstacleTracker::extend(Trail& trail, const Body& body) const {
  const Disc extent = extent_of(body);
  const bool again = !trail.places.empty();
  const double dt = again ? seen_ - trail.places.back().t : 1;
  trail.outline_speed = again ? std::abs(extent.radius - trail.radii.back().place.x) / dt : 0;
  if (const auto* outline = outline_of(body)) {
    const bool comparable = again && trail.outline.size() == outline->size();
    trail.outline.resize(outline->size());
    for (std::size_t i = 0; i < outline->size(); ++i) {
      const Vec2 v = (*outline)[i] - extent.centre;
      if (comparable)
        trail.outline_speed = std::max(trail.outline_speed, distance(v, trail.outline[i]) / dt);
      trail.outline[i] = v;
    }
  }
  const std::size_t most = windows * static_cast<std::size_t>(params_.frames);
  remember(trail.places, {seen_, extent.centre}, most, params_.memory);
  remember(trail.radii, {seen_, {extent.radius, 0}}, most, params_.memory);
}

TrackedBody ObstacleTracker::told_by(const Trail& trail) const {
  const MotionFit place = fit_motion(trail.places, params_.frames);
  const MotionFit radius = fit_motion(trail.radii, params_.frames);
  return {.centre = place.place,
          .velocity = place.velocity,
          .acceleration = place.acceleration,
          .velocity_error = place.velocity_error,
          .noise = place.noise,
          .radius = radius.place.x,
          .radius_rate = radius.velocity.x,
          .outline_speed = trail.outline_speed,
          .frames = place.sightings};
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/obstacle_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::navigation {
namespace {

/// Number of sightings from which the noise is estimated.
std::size_t max_sightings(const ObstacleTrackerParams& params) {
  return static_cast<std::size_t>(params.tuning.noise_windows) *
         static_cast<std::size_t>(params.frames);
}

/// Upper bound of the squared distance from `v` to the solid within the ring: from vertex `i` and
/// the edges beside it.
double squared_bound(Vec2 v, std::span<const Vec2> ring, std::size_t i) {
  const std::size_t n = ring.size();
  return std::min(squared_distance(v, {ring[(i + n - 1) % n], ring[i]}),
                  squared_distance(v, {ring[i], ring[(i + 1) % n]}));
}

/// Outlines with at most so many vertices are searched edge by edge.
constexpr std::size_t few_vertices = 32;

constexpr auto every_vertex = [](std::span<const Vec2>, std::size_t) { return true; };

/// Keeps the newest `most` sightings.
void remember(std::vector<Sighting>& trail, Sighting newest, std::size_t most) {
  if (trail.size() >= most) trail.erase(trail.begin());
  trail.push_back(newest);
}

bool has_constant_radius(std::span<const Sighting> radii) {
  return std::all_of(radii.begin(), radii.end(),
                     [&](const Sighting& s) { return s.position == radii.back().position; });
}

}  // namespace

/// Maximum distance by which vertices of `polygon` protrude from the solid `before`, given relative
/// to its centre; only those for which `counts(ring, i)` holds.
template <class Counts>
double ObstacleTracker::outward_distance(const Polygon& polygon, Vec2 centre, const Outline& before,
                                         Counts&& counts) {
  const auto squared_distance_to = [&](Vec2 v) {
    if (before.edges.empty()) {
      const double d = distance(v, before.shape);
      return d * d;
    }
    if (before.edges.in_solid(v)) return 0.0;
    return squared_distance(v, before.edges.edge(before.edges.nearest(v, infinity)));
  };
  double most = 0;  // squared
  const auto compare = [&](std::span<const Vec2> ring, std::span<const Vec2> then) {
    const bool alike = ring.size() == then.size();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 v = ring[i] - centre;
      if (alike && squared_bound(v, then, i) <= most) continue;  // without a search
      if (counts(ring, i)) most = std::max(most, squared_distance_to(v));
    }
  };
  const Polygon& shape = before.shape;
  compare(polygon.outer, shape.outer);
  for (std::size_t k = 0; k < polygon.holes.size(); ++k)
    compare(polygon.holes[k], k < shape.holes.size() ? std::span<const Vec2>(shape.holes[k])
                                                     : std::span<const Vec2>{});
  return std::sqrt(most);
}

double outward_speed(const Body& body, const TrackedBody& motion) {
  return std::visit(Overloaded{[&](const Disc&) { return std::max(0.0, motion.radius_rate); },
                               [&](const Polygon&) { return motion.outline_speed; }},
                    body.shape);
}

void ObstacleTracker::update(const Observation& observation, double range) {
  if (!observation.world || !std::isfinite(observation.seen)) return;
  const auto bodies = observation.world->moving().bodies();
  if (observation.seen == seen_ && bodies.size() == trail_of_.size()) return;
  if (observation.seen <= seen_) trails_.clear();
  seen_ = observation.seen;
  find_trails(bodies);
  const Vec2 centre = observation.swarm ? observation.swarm->pose.position : Vec2{};
  const Disc within{centre, observation.swarm ? range : infinity};
  for (std::size_t i = 0; i < bodies.size(); ++i) extend(trails_[trail_of_[i]], bodies[i], within);
}

std::vector<ObstacleTracker::Trail>::iterator ObstacleTracker::lower_bound(const Key& key) {
  return std::lower_bound(trails_.begin(), trails_.end(), key,
                          [](const Trail& t, const Key& k) { return t.key < k; });
}

// Most frames show the same bodies in the same order.
void ObstacleTracker::find_trails(std::span<const Body> bodies) {
  std::erase_if(trails_, [&](const Trail& t) { return t.present < seen_ - params_.memory; });
  const auto for_each_key = [&](auto&& visit) {
    Key key{0, 0};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const bool next = i > 0 && bodies[i].obstacle == bodies[i - 1].obstacle;
      key = {bodies[i].obstacle, next ? key.second + 1 : 0};
      visit(i, key);
    }
  };
  for_each_key([&](std::size_t i, const Key& key) {
    if (i < trail_of_.size() && trail_of_[i] < trails_.size() && trails_[trail_of_[i]].key == key)
      return;
    const auto at = lower_bound(key);
    if (at != trails_.end() && at->key == key) return;
    Trail& fresh = *trails_.insert(at, Trail{});
    fresh.key = key;
    const std::size_t most = max_sightings(params_);
    fresh.positions.reserve(most);
    fresh.radii.reserve(most);
  });
  trail_of_.resize(bodies.size(), 0);
  for_each_key([&](std::size_t i, const Key& key) {
    if (trail_of_[i] < trails_.size() && trails_[trail_of_[i]].key == key) return;
    trail_of_[i] = static_cast<std::size_t>(lower_bound(key) - trails_.begin());
  });
}

void ObstacleTracker::extend(Trail& trail, const Body& body, Disc within) const {
  trail.present = seen_;
  const Disc extent = enclosing_disc(body);
  if (distance(extent.centre, within.centre) - extent.radius > within.radius) {
    trail.positions.clear();
    trail.radii.clear();
    return;
  }
  const auto outdated = [&](const Sighting& s) { return s.t < seen_ - params_.memory; };
  std::erase_if(trail.positions, outdated);
  std::erase_if(trail.radii, outdated);
  std::visit(
      Overloaded{[](const Disc&) {},
                 [&](const Polygon& polygon) { compare_outline(trail, polygon, extent.centre); }},
      body.shape);
  const std::size_t most = max_sightings(params_);
  remember(trail.positions, {seen_, extent.centre}, most);
  remember(trail.radii, {seen_, {extent.radius, 0}}, most);
}

// Compares with an outline a few frames old, since one frame's noise would be a large speed.
// Outlines are traced again in every image, with different vertices, so a vertex is compared
// with the old solid, not with an old vertex.
void ObstacleTracker::compare_outline(Trail& trail, const Polygon& polygon, Vec2 centre) const {
  auto& [older, newer] = trail.past;
  const bool known = !trail.positions.empty() && !older.shape.outer.empty();
  trail.outline_speed =
      known ? outward_distance(polygon, centre, older, every_vertex) / (seen_ - older.t) : 0;
  if (known && seen_ - newer.t < params_.tuning.outline_spacing) return;
  std::swap(older, newer);
  newer.t = seen_;
  newer.shape = polygon;
  for (Vec2& v : newer.shape.outer) v -= centre;
  for (auto& hole : newer.shape.holes)
    for (Vec2& v : hole) v -= centre;
  if (!known) older = newer;
  index(older);
}

void ObstacleTracker::index(Outline& outline) {
  std::size_t vertices = outline.shape.outer.size();
  for (const auto& hole : outline.shape.holes) vertices += hole.size();
  std::vector<Segment> edges;
  if (vertices <= few_vertices) return outline.edges.assign({}, {});
  edges.reserve(vertices);
  for_each_edge(outline.shape, [&](Vec2 a, Vec2 b) { edges.push_back({a, b}); });
  const std::vector<std::uint32_t> bodies(edges.size(), 0);
  outline.edges.assign(edges, bodies);
}

double ObstacleTracker::outline_speed_within(std::size_t body, const Body& shape,
                                             Disc within) const {
  const Trail& trail = trails_[trail_of_[body]];
  const Outline& before = trail.past[0];
  if (trail.positions.empty() || before.shape.outer.empty() || before.t >= seen_) return 0;
  const auto edge_reaches = [&](Vec2 a, Vec2 b) {
    return distance(within.centre, Segment{a, b}) <= within.radius;
  };
  const auto near = [&](std::span<const Vec2> ring, std::size_t i) {
    const std::size_t n = ring.size();
    return edge_reaches(ring[i], ring[(i + 1) % n]) || edge_reaches(ring[i], ring[(i + n - 1) % n]);
  };
  return std::visit(Overloaded{[](const Disc&) { return 0.0; },
                               [&](const Polygon& polygon) {
                                 return outward_distance(polygon, enclosing_disc(shape).centre,
                                                         before, near) /
                                        (seen_ - before.t);
                               }},
                    shape.shape);
}

TrackedBody ObstacleTracker::estimate(const Trail& trail) const {
  if (trail.positions.empty()) return {.velocity_error = std::numeric_limits<double>::infinity()};
  const MotionFit position = fit_motion(trail.positions, params_.frames, params_.tuning.fit);
  const MotionFit radius = has_constant_radius(trail.radii)
                               ? MotionFit{.position = trail.radii.back().position}
                               : fit_motion(trail.radii, params_.frames, params_.tuning.fit);
  return {.centre = position.position,
          .velocity = position.velocity,
          .acceleration = position.acceleration,
          .velocity_error = position.velocity_error,
          .noise = position.noise,
          .radius = radius.position.x,
          .radius_rate = radius.velocity.x,
          .outline_speed = std::max(trail.outline_speed, std::abs(radius.velocity.x)),
          .frames = position.sightings};
}

}  // namespace microswarm::navigation

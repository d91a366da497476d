// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/predictive/obstacle_horizon.hpp"

#include <algorithm>

namespace microswarm::navigation {

void ObstacleHorizon::update(const Snapshot& world, const MultiModelPredictor& predictor,
                             const TimeField& field, double effect,
                             std::span<const Vec2> positions) {
  effect_ = effect;
  body_of_.clear();
  nonconvex_bodies_.clear();
  closing_ = 0;
  const auto bodies = world.moving().bodies();
  for (std::size_t i = 0; i < bodies.size() && i < predictor.size(); ++i) {
    if (outlines_.size() == size()) outlines_.emplace_back();
    ConvexOutline& outline = outlines_[size()];
    outliner_.take(bodies[i], outline);
    const TrackedBody& motion = predictor.tracked(i);
    if (norm(motion.velocity) <= slow_speed_ && outliner_.misleads(outline, positions)) {
      nonconvex_bodies_.push_back(bodies[i]);
      closing_ = std::max(closing_, closing_time_ * motion.outline_speed);
      continue;
    }
    body_of_.push_back(i);
  }
  nonconvex_.assign(nonconvex_bodies_);
  ahead_.clear();
  leg_ahead_.clear();
  for (int s = 0; s < 2 * field.steps(); ++s)
    for (const std::size_t body : body_of_)
      ahead_.push_back(predictor.at(body, effect + field.time_at(s)));
  for (int s = 0; s <= leg_pieces; ++s)
    for (const std::size_t body : body_of_)
      leg_ahead_.push_back(predictor.at(body, effect + field.step() * s / leg_pieces));
}

ObstacleHorizon::Meeting ObstacleHorizon::meeting(int piece, Segment move, double radius) const {
  Meeting out;
  const auto begin = part(leg_ahead_, piece);
  const auto end = part(leg_ahead_, piece + 1);
  for (std::size_t i = 0; i < size(); ++i) {
    const PredictedBody& a = begin[i];
    const PredictedBody& b = end[i];
    const double grown = radius + std::max(a.growth, b.growth);
    const double near = grown + risk_.reach + b.uncertainty;
    const Vec2 p = move.a - a.centre;
    const Vec2 q = move.b - b.centre;
    const double away = outlines_[i].radius + near + distance(p, q);
    if (squared_norm(p) > away * away) continue;
    const double gap =
        outlines_[i].distance_along(rotated(p, -a.turn), rotated(q, -b.turn), near) - grown;
    const auto risk =
        penetration_risk(risk_, static_cast<float>(gap), static_cast<float>(b.uncertainty));
    out.gap = std::min(out.gap, gap);
    out.risk = std::max(out.risk, static_cast<double>(risk));
  }
  return out;
}

PredictiveDiagnostics ObstacleHorizon::diagnostics(const TimeField& field, double radius) const {
  PredictiveDiagnostics out{.effect = effect_, .radius = radius};
  for (int s = 0; s < 2 * field.steps(); s += 2)  // one a step
    for (std::size_t i = 0; i < size(); ++i) {
      const PredictedBody& body = sample(s)[i];
      out.bodies.push_back({.body = static_cast<std::uint32_t>(body_of_[i]),
                            .t = effect_ + field.time_at(s),
                            .centre = body.centre,
                            .turn = body.turn,
                            .radius = outlines_[i].radius + body.growth,
                            .growth = body.growth,
                            .uncertainty = body.uncertainty});
    }
  for (std::size_t i = 0; i < size(); ++i)
    for (const ConvexOutline::Edge& edge : outlines_[i].edges)
      out.corners.push_back({static_cast<std::uint32_t>(body_of_[i]),
                             edge.offset * edge.normal + edge.begin * perpendicular(edge.normal)});
  return out;
}

}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/safe_interval/obstacle_forecast.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm::navigation {
namespace {

/// Calls use(row, left, right) for the rows of the grid that a disc reaches, with its extent [µm].
template <class Use>
void for_each_row_of(const planning::SpaceTimeGrid& grid, Disc disc, Use&& use) {
  const double r = disc.radius;
  if (!(r >= 0) || !is_finite(disc.centre)) return;
  const auto rows = grid.rows_between(disc.centre.y - r, disc.centre.y + r);
  for (int row = rows.begin; row <= rows.end; ++row) {
    const double y = grid.y_of(row) - disc.centre.y;
    const double half = std::sqrt(std::max(0.0, r * r - y * y));
    use(row, disc.centre.x - half, disc.centre.x + half);
  }
}

/// The same for an outline that is grown by `keep` [µm] on all sides: its border consists of edges
/// that are moved outwards and of arcs around the corners. `extents` is a buffer.
template <class Use>
void for_each_row_of(const planning::SpaceTimeGrid& grid, const ConvexOutline& outline,
                     const PredictedBody& body, double keep, std::vector<RowExtent>& extents,
                     Use&& use) {
  if (outline.edges.empty() || keep < 0)
    return for_each_row_of(grid, {body.centre, outline.radius + keep}, use);
  const double reach = outline.radius + keep;
  const Vec2 turned = unit_vector(body.turn);
  const auto rows = grid.rows_between(body.centre.y - reach, body.centre.y + reach);
  if (rows.begin > rows.end) return;
  extents.assign(static_cast<std::size_t>(rows.end - rows.begin + 1), {});
  // Calls with_row(y, extent) for the rows from `low` to `high` [µm] from the centre, and perhaps
  // for their neighbours.
  const auto for_rows = [&](double low, double high, auto&& with_row) {
    const auto some = grid.rows_between(body.centre.y + low, body.centre.y + high);
    const int end = std::min(rows.end, some.end + 1);
    for (int row = std::max(rows.begin, some.begin - 1); row <= end; ++row)
      with_row(grid.y_of(row) - body.centre.y, extents[static_cast<std::size_t>(row - rows.begin)]);
  };
  for (const ConvexOutline::Edge& edge : outline.edges) {
    const Vec2 normal{turned.x * edge.normal.x - turned.y * edge.normal.y,
                      turned.y * edge.normal.x + turned.x * edge.normal.y};
    const Vec2 along = perpendicular(normal);
    const Vec2 corner = edge.offset * normal + edge.begin * along;
    const Vec2 a = corner + keep * normal;
    const Vec2 b = a + (edge.end - edge.begin) * along;
    for_rows(corner.y - keep, corner.y + keep, [&](double y, RowExtent& extent) {
      const double up = y - corner.y;
      if (std::abs(up) > keep) return;
      const double half = std::sqrt(keep * keep - up * up);
      extent.add(corner.x - half);
      extent.add(corner.x + half);
    });
    for_rows(std::min(a.y, b.y), std::max(a.y, b.y), [&](double y, RowExtent& extent) {
      if ((a.y <= y) != (b.y <= y)) extent.add(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    });
  }
  for (int row = rows.begin; row <= rows.end; ++row) {
    const RowExtent& extent = extents[static_cast<std::size_t>(row - rows.begin)];
    if (extent.left <= extent.right)
      use(row, body.centre.x + extent.left, body.centre.x + extent.right);
  }
}

PredictedBody between(const PredictedBody& a, const PredictedBody& b, double share) {
  PredictedBody out = share < 0.5 ? a : b;
  out.centre = a.centre + share * (b.centre - a.centre);
  return out;
}

}  // namespace

ObstacleForecast::ObstacleForecast(const SafeIntervalParams& params, double speed)
    : params_(params),
      slow_speed_(params.tuning.slow_share * speed),
      step_(0.5 * params.horizon / slots),
      last_sample_(2 * slots),
      near_samples_(std::min(
          last_sample_,
          static_cast<int>(std::ceil(
              std::max(params.tuning.checked_time, params.tuning.imminent.horizon) / step_)) +
              1)),
      outliner_(params.tuning.outline),
      resting_(params.tuning.rest_time, params.tuning.rest_speed) {}

void ObstacleForecast::update(const Snapshot& world, const MultiModelPredictor& predictor,
                              double effect, std::span<const Vec2> positions) {
  effect_ = effect;
  late_ = effect - world.time();
  bodies_.clear();
  std::size_t hollow = 0;
  standing_.clear();
  closing_ = 0;
  predicted_ = 0;
  const auto bodies = world.moving().bodies();
  resting_.update(bodies, predictor, world.time());
  for (std::size_t i = 0; i < bodies.size() && i < predictor.size(); ++i) {
    if (outlines_.size() == size()) outlines_.emplace_back();
    ConvexOutline& outline = outlines_[size()];
    outliner_.take(bodies[i], outline);
    const TrackedBody& motion = predictor.tracked(i);
    if (norm(motion.velocity) <= slow_speed_ && outliner_.misleads(outline, positions)) {
      // Its outline is copied into memory that is there.
      if (hollow == hollow_bodies_.size()) hollow_bodies_.emplace_back();
      hollow_bodies_[hollow++] = bodies[i];
      closing_ = std::max(closing_, params_.tuning.closing_time * motion.outline_speed);
      continue;
    }
    const bool rests = resting_.rests(i);
    if (rests) standing_.push_back({outline.centre, outline.radius});
    const double late = late_ + params_.tuning.reaction_time;
    const double reach = late * norm(motion.velocity) + params_.tuning.noisy_turn * motion.noise;
    bodies_.push_back({i, motion.noise, rests, rests ? 0 : predictor.surprise(i) * reach,
                       outline.centre, motion.velocity});
  }
  for (std::size_t i = 0; i < predictor.hidden(); ++i) {
    if (outlines_.size() == size()) outlines_.emplace_back();
    ConvexOutline& outline = outlines_[size()];
    const Disc disc = predictor.hidden_at(i, world.time());
    outline.centre = disc.centre;
    outline.radius = disc.radius;
    outline.edges.clear();
    bodies_.push_back({.index = i, .noise = predictor.hidden_noise(i), .hidden = true});
  }
  hollow_.assign(std::span(hollow_bodies_).first(hollow));
  predict_until(predictor, near_samples_);
}

PredictedBody ObstacleForecast::predicted(const MultiModelPredictor& predictor, std::size_t i,
                                          double t) const {
  if (!bodies_[i].hidden) return predictor.at(bodies_[i].index, t);
  const Disc disc = predictor.hidden_at(bodies_[i].index, t);
  return {.centre = disc.centre, .growth = disc.radius - outlines_[i].radius};
}

void ObstacleForecast::predict_until(const MultiModelPredictor& predictor, int sample) {
  const auto count = static_cast<std::size_t>(last_sample_ + 1) * size();
  if (ahead_.size() < count) ahead_.resize(count);
  for (; predicted_ <= sample; ++predicted_)
    for (std::size_t i = 0; i < size(); ++i) {
      PredictedBody& body = ahead_[static_cast<std::size_t>(predicted_) * size() + i];
      if (bodies_[i].rests && predicted_ > 0) {
        body = ahead_[i];
        continue;
      }
      body = predicted(predictor, i, effect_ + predicted_ * step_);
    }
}

void ObstacleForecast::measure_from(Vec2 position, double radius) {
  present_gaps_.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    const PredictedBody& body = at(0, i);
    const Vec2 offset = rotated(position - body.centre, -body.turn);
    present_gaps_.push_back(outlines_[i].distance_at(offset) - body.growth - radius);
  }
}

double ObstacleForecast::min_current_gap() const {
  const auto least = std::min_element(present_gaps_.begin(), present_gaps_.end());
  return least == present_gaps_.end() ? infinity : *least;
}

double ObstacleForecast::gap(int sample, std::size_t i) const {
  const double noise = bodies_[i].noise;
  if (rests(i)) return params_.gap + noise;
  const double grown = params_.gap + params_.gap_rate * sample * step_;
  return std::min(std::max(params_.gap, params_.max_gap), grown) + noise +
         at(sample, i).uncertainty + params_.tuning.turn_gain * turn_reach(i);
}

PredictedBody ObstacleForecast::turned_round(int sample, std::size_t i) const {
  PredictedBody body = at(sample, i);
  body.centre = bodies_[i].centre - (late_ + sample * step_) * bodies_[i].velocity;
  return body;
}

double ObstacleForecast::gap_along(Segment move, const PredictedBody& a, const PredictedBody& b,
                                   std::size_t i, double radius, double near) const {
  const double grown = radius + std::max(a.growth, b.growth);
  const Vec2 p = move.a - a.centre;
  const Vec2 q = move.b - b.centre;
  const double reach = outlines_[i].radius + grown + near + distance(p, q);
  if (squared_norm(p) > reach * reach) return infinity;
  const double away =
      outlines_[i].edges.empty()
          ? outlines_[i].distance_along(p, q, near)
          : outlines_[i].distance_along(rotated(p, -a.turn), rotated(q, -b.turn), near + grown);
  return away - grown;
}

void ObstacleForecast::occupy(planning::SpaceTimeGrid& grid, double radius, double share,
                              bool without_resting) const {
  for (std::size_t i = 0; i < size(); ++i) {
    if (rests(i) && without_resting) continue;
    for (int slot = 0; slot < grid.slots(); ++slot)
      occupy_slot(grid, i, slot, radius + share * gap(2 * slot + 1, i));
    grid.finish_body();
  }
}

// Where a body moves by more than a cell within the slot, at several times of it.
void ObstacleForecast::occupy_slot(planning::SpaceTimeGrid& grid, std::size_t i, int slot,
                                   double keep) const {
  const PredictedBody& begin = at(2 * slot, i);
  const PredictedBody& middle = at(2 * slot + 1, i);
  const PredictedBody& end = at(2 * slot + 2, i);
  const auto occupy_at = [&](const PredictedBody& body) {
    for_each_row_of(grid, outlines_[i], body, keep + body.growth, extents_,
                    [&](int row, double left, double right) {
                      grid.occupy_row_of_body(row, left, right, slot);
                    });
  };
  const double moved = distance(begin.centre, middle.centre) + distance(middle.centre, end.centre);
  constexpr double max_pieces = 16;
  const int pieces = static_cast<int>(std::clamp(std::ceil(moved / grid.cell()), 1.0, max_pieces));
  for (int k = 0; k < pieces; ++k) {
    const double share = (k + 0.5) / pieces;
    occupy_at(share < 0.5   ? between(begin, middle, 2 * share)
              : share > 0.5 ? between(middle, end, 2 * share - 1)
                            : middle);
  }
}

void ObstacleForecast::let_resting_stand(planning::SpaceTimeGrid& grid, double radius,
                                         double gap) const {
  for (std::size_t i = 0; i < size(); ++i) {
    if (!rests(i)) continue;
    for_each_row_of(
        grid, outlines_[i], at(0, i), radius + gap, extents_,
        [&](int row, double left, double right) { grid.let_row_stand(row, left, right); });
  }
}

PredictiveDiagnostics ObstacleForecast::diagnostics(double radius) const {
  constexpr int samples_a_moment = 4;
  PredictiveDiagnostics out{.effect = effect_, .radius = radius};
  for (int s = 0; s < predicted_; s += samples_a_moment)
    for (std::size_t i = 0; i < size(); ++i) {
      if (bodies_[i].hidden) continue;
      const PredictedBody& body = at(s, i);
      out.bodies.push_back({.body = static_cast<std::uint32_t>(bodies_[i].index),
                            .t = effect_ + s * step_,
                            .centre = body.centre,
                            .turn = body.turn,
                            .radius = outlines_[i].radius + body.growth,
                            .growth = body.growth,
                            .uncertainty = body.uncertainty});
    }
  for (std::size_t i = 0; i < size(); ++i)
    for (const ConvexOutline::Edge& edge : outlines_[i].edges)
      out.corners.push_back({static_cast<std::uint32_t>(bodies_[i].index),
                             edge.offset * edge.normal + edge.begin * perpendicular(edge.normal)});
  return out;
}

}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/safe_interval/space_time_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/geometry/distance.hpp"

namespace microswarm::navigation {
namespace {

/// Distance within which the start and the goal are joined to the grid [cells].
constexpr int join_cells = 3;
/// Shares of the gap to walls on successively finer grids.
constexpr std::array<double, 4> wall_gap_shares{1, 0.5, 0.2, 0.1};
constexpr double start_rounding = 1e-9;

/// Distance to the nearest of the bodies [µm], negative in one.
double signed_distance(std::span<const Body> bodies, Vec2 p) {
  double least = infinity;
  for (const Body& body : bodies) least = std::min(least, -depth_in(body, p));
  return least;
}

}  // namespace

SpaceTimePlanner::SpaceTimePlanner(const SafeIntervalParams& params, double radius, double speed,
                                   const planning::TurnFirst& turning)
    : params_(params), radius_(radius), speed_(speed), turning_(turning) {}

void SpaceTimePlanner::prepare(const Map& map, Disc reached, double clearance) {
  reached_ = reached;
  goal_clearance_ = clearance;
  make_grid(map, 0);
}

// The first level is made at any rate, if need be with larger cells.
bool SpaceTimePlanner::make_grid(const Map& map, int level) {
  const Box& bounds = map.bounds();
  const double least = std::sqrt(bounds.width() * bounds.height() / params_.tuning.max_cells);
  const double wanted = std::ldexp(params_.cell_share * std::max(radius_, start_rounding), -level);
  if (level > 0 && wanted < least) return false;
  level_ = level;
  is_coarse_ = wanted < least;
  const double cell = std::max(wanted, least);
  grid_ = planning::SpaceTimeGrid(bounds, cell, params_.horizon / ObstacleForecast::slots,
                                  ObstacleForecast::slots);
  const double keep = radius_ + wall_gap_shares[static_cast<std::size_t>(level)] * params_.wall_gap;
  walls_.resize(grid_.size());
  std::vector<Vec2> row(static_cast<std::size_t>(grid_.columns()));
  for (int j = 0; j < grid_.rows(); ++j) {
    for (int i = 0; i < grid_.columns(); ++i)
      row[static_cast<std::size_t>(i)] = grid_.position(grid_.at(i, j));
    map.are_free(row, keep, std::span(walls_).subspan(grid_.at(0, j), row.size()));
  }
  let_walls_stand();
  seeds_.clear();
  arrived_ = 0;
  const double near = std::max(reached_.radius, join_cells * cell + params_.wall_gap);
  const auto rows = grid_.rows_between(reached_.centre.y - near, reached_.centre.y + near);
  for (int j = rows.begin; j <= rows.end; ++j)
    for (int i = 0; i < grid_.columns(); ++i) {
      const auto c = grid_.at(i, j);
      const Vec2 p = grid_.position(c);
      const double away = distance(p, reached_.centre);
      if (away > near || grid_.stands(c)) continue;
      if (!map.is_free(Segment{p, reached_.centre}, goal_clearance_)) continue;
      const double left = std::max(0.0, away - reached_.radius);
      seeds_.push_back({c, left});
      arrived_ = std::max(arrived_, left);
    }
  distances_.compute(grid_, seeds_);
  search_.reserve(grid_, 8 * static_cast<std::size_t>(params_.tuning.max_expansions));
  entries_.reserve((2 * join_cells + 1) * (2 * join_cells + 1));
  drawn_.reset();
  return true;
}

void SpaceTimePlanner::let_walls_stand() {
  grid_.clear_standing();
  for (planning::SpaceTimeGrid::Cell c = 0; c < grid_.size(); ++c)
    if (walls_[c] == 0) grid_.let_stand(c);
}

// All cells of a rectangle at once where one distance decides.
void SpaceTimePlanner::let_hollow_stand(const ObstacleForecast& forecast, double keep, int column,
                                        int row, int columns, int rows) {
  if (columns <= 0 || rows <= 0) return;
  const Vec2 low = grid_.position(grid_.at(column, row));
  const Vec2 high = grid_.position(grid_.at(column + columns - 1, row + rows - 1));
  const double half = 0.5 * distance(low, high);
  const double away = signed_distance(forecast.hollow().bodies(), 0.5 * (low + high));
  if (away >= keep + half) return;
  if (away < keep - half || (columns == 1 && rows == 1)) {
    for (int j = 0; j < rows; ++j) grid_.let_row_stand(row + j, low.x, high.x);
    return;
  }
  const int left = (columns + 1) / 2;
  const int below = (rows + 1) / 2;
  let_hollow_stand(forecast, keep, column, row, left, below);
  let_hollow_stand(forecast, keep, column + left, row, columns - left, below);
  let_hollow_stand(forecast, keep, column, row + below, left, rows - below);
  let_hollow_stand(forecast, keep, column + left, row + below, columns - left, rows - below);
}

void SpaceTimePlanner::find_entries(const Map& map, Vec2 from, double clearance) {
  entries_.clear();
  const auto here = grid_.nearest(from);
  for (int j = -join_cells; j <= join_cells; ++j)
    for (int i = -join_cells; i <= join_cells; ++i) {
      const int column = grid_.column_of(here) + i;
      const int row = grid_.row_of(here) + j;
      if (!grid_.holds(column, row) || grid_.stands(grid_.at(column, row))) continue;
      const auto c = grid_.at(column, row);
      if (map.is_free(Segment{from, grid_.position(c)}, clearance)) entries_.push_back(c);
    }
}

bool SpaceTimePlanner::is_connected() const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [this](auto c) { return std::isfinite(distances_[c]); });
}

bool SpaceTimePlanner::changed(const ObstacleForecast& forecast, double now) const {
  constexpr double moved = 1;  // [µm]
  const auto standing = forecast.standing();
  const bool same = std::equal(standing.begin(), standing.end(), standing_.begin(), standing_.end(),
                               [](const Disc& a, const Disc& b) {
                                 return distance(a.centre, b.centre) < moved &&
                                        std::abs(a.radius - b.radius) < moved;
                               });
  if (!drawn_) return true;
  if (!same || has_hollow_ != !forecast.hollow().empty()) return true;
  return has_hollow_ && (now - *drawn_ >= params_.tuning.refresh_period || now < *drawn_);
}

void SpaceTimePlanner::refresh(const Map& map, const ObstacleForecast& forecast, Vec2 from,
                               double now) {
  if (!changed(forecast, now)) return;
  const double clearance = std::min(radius_, (1 - start_rounding) * map.clearance(from));
  find_entries(map, from, clearance);
  while (!drawn_ && !is_connected())
    if (!make_grid(map, level_ + 1))
      break;
    else
      find_entries(map, from, clearance);
  standing_.assign(forecast.standing().begin(), forecast.standing().end());
  has_hollow_ = !forecast.hollow().empty();
  draws_standing_ = !standing_.empty() || has_hollow_;
  drawn_ = now;
  for (const double share : {1.0, 0.25}) {
    let_walls_stand();
    if (!draws_standing_) break;
    forecast.let_resting_stand(grid_, radius_, share * params_.gap);
    if (has_hollow_)
      let_hollow_stand(forecast, radius_ + share * (params_.gap + forecast.closing()), 0, 0,
                       grid_.columns(), grid_.rows());
    distances_.compute(grid_, seeds_);
    find_entries(map, from, clearance);
    if (is_connected()) return;
  }
  if (draws_standing_) let_walls_stand();
  draws_standing_ = false;
  distances_.compute(grid_, seeds_);
}

Status SpaceTimePlanner::plan(const Map& map, const ObstacleForecast& forecast, const Pose2& pose,
                              double radius, double clearance, double share, const Stop& stop) {
  find_entries(map, pose.position, clearance);
  grid_.clear();
  forecast.occupy(grid_, radius, share, draws_standing_);
  const auto here = grid_.nearest(pose.position);
  double stay = 0;
  for (const auto c : entries_) {
    if (c != here && !grid_.stands(here)) continue;
    const auto safe = grid_.safe_interval(c, 0);
    if (safe.begin == 0)
      stay = std::max(
          stay, safe.end == planning::SpaceTimeGrid::forever ? infinity : safe.end * grid_.slot());
  }
  const Status status = search_.find(grid_,
                                     {.from = pose.position,
                                      .stay_until = stay,
                                      .entries = entries_,
                                      .speed = speed_,
                                      .heading = pose.heading,
                                      .turn_cost = params_.tuning.turn_cost,
                                      .turning = turning_,
                                      .lengths = distances_.lengths(),
                                      .arrived = arrived_,
                                      .max_expansions = params_.tuning.max_expansions},
                                     stop);
  if (search_.path().empty()) return status;
  const auto last = search_.path().back();
  const float length = distances_[grid_.nearest(last.position)];
  ends_at_goal_ = search_.path().size() > 1 && static_cast<double>(length) <= arrived_;
  left_ = static_cast<double>(length) / speed_;
  return status;
}

}  // namespace microswarm::navigation

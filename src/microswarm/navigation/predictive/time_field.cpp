// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/predictive/time_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace microswarm::navigation {
namespace {

// The stencil of moves, in cells. The values belong together: the long moves are those from
// long_way to longest_path, cells_a_step is their mean length and stride_cells their greatest
// extent. `predictive.step` sets the resolution.
constexpr double longest_path = 3.25;
constexpr double long_move = 2.4;
constexpr double short_move = 1.5;
constexpr double cells_a_step = 3.1;
constexpr float not_ended = std::numeric_limits<float>::infinity();

}  // namespace

TimeField::TimeField(double speed, double horizon, double step)
    : steps_(std::max(2, static_cast<int>(std::lround(horizon / step)))),
      step_(step),
      cell_(speed * step / cells_a_step),
      half_(stride_cells * steps_ + 2),
      width_(2 * half_ + 1) {
  for (int j = -stride_cells; j <= stride_cells; ++j)
    for (int i = -stride_cells; i <= stride_cells; ++i) {
      const double length = std::sqrt(i * i + j * j);
      const bool is_long = length >= long_move && length <= longest_path;
      const bool is_short = length <= short_move && (i == 0) == (j == 0);
      if (!is_long && !is_short) continue;
      // An integer number of cells is slightly more or less than a step. Slow moves wait.
      const double extra = is_long ? (length / cells_a_step - 1) * step_ : 0;
      moves_.push_back({j * width_ + i,
                        {static_cast<double>(i), static_cast<double>(j)},
                        static_cast<float>(extra)});
    }
  const auto cells = static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_);
  standing_.resize(cells);
  risk_.resize(cells);
  after_.resize(cells);
  ended_.resize(cells);
  row_.resize(static_cast<std::size_t>(width_));
  cost_.assign(static_cast<std::size_t>(steps_) + 1, std::vector<float>(cells));
}

Vec2 TimeField::place(int column, int row) const {
  return centre_ +
         cell_ * Vec2{static_cast<double>(column - half_), static_cast<double>(row - half_)};
}

int TimeField::reach_at(int k) const { return std::min(half_, stride_cells * k + 2); }

void TimeField::begin(Vec2 centre, Disc goal, const std::function<float(Vec2)>& standing,
                      const std::function<float(Vec2)>& left) {
  centre_ = centre;
  auto& last = cost_.back();
  constexpr double half_diagonal = 0.75;  // of a cell, rounded up
  const double at_goal = std::max(goal.radius, half_diagonal * cell_);
  const double speed = cells_a_step * cell_ / step_;
  for (int row = 0; row < width_; ++row)
    for (int column = 0; column < width_; ++column) {
      const std::size_t c = cell_index(column, row);
      const Vec2 p = place(column, row);
      standing_[c] = standing(p);
      const double away = distance(p, goal.centre);
      const bool ends = away < at_goal;
      ended_[c] = ends ? static_cast<float>(std::max(0.0, away - goal.radius) / speed) : not_ended;
      last[c] = ends ? ended_[c] : left(p);
    }
}

void TimeField::solve(std::span<const ConvexOutline> outlines, std::span<const PredictedBody> ahead,
                      double radius, const RiskParams& risk) {
  for (int k = steps_ - 1; k > 0; --k) step_back(k, outlines, ahead, radius, risk);
}

// The first half of a step is charged at its start cell, the second half at its end cell.
void TimeField::step_back(int k, std::span<const ConvexOutline> outlines,
                          std::span<const PredictedBody> ahead, double radius,
                          const RiskParams& risk) {
  const auto bodies = outlines.size();
  const auto sample = [&](int s) {
    return ahead.subspan(static_cast<std::size_t>(s) * bodies, bodies);
  };
  const auto half_step = static_cast<float>(0.5 * step_);
  const int wide = reach_at(k + 1);
  const int reach = reach_at(k);
  const auto& next = cost_[static_cast<std::size_t>(k) + 1];
  auto& here = cost_[static_cast<std::size_t>(k)];
  paint(wide, outlines, sample(2 * k + 1), radius, risk);
  for (int row = half_ - wide; row <= half_ + wide; ++row)
    for (int column = half_ - wide; column <= half_ + wide; ++column) {
      const std::size_t c = cell_index(column, row);
      after_[c] = next[c] + half_step * risk_[c];
    }
  paint(reach, outlines, sample(2 * k), radius, risk);
  const int count = 2 * reach + 1;
  for (int row = half_ - reach; row <= half_ + reach; ++row) {
    const std::size_t first = cell_index(half_ - reach, row);
    float* const least = row_.data();
    std::copy_n(&after_[first], count, least);
    for (const Move& move : moves_) {
      const float* const there = after_.data() + (static_cast<std::ptrdiff_t>(first) + move.cells);
      for (int i = 0; i < count; ++i) least[i] = std::min(least[i], there[i] + move.extra);
    }
    const float* const near = &risk_[first];
    const float* const ended = &ended_[first];
    float* const out = &here[first];
    for (int i = 0; i < count; ++i)
      out[i] = ended[i] < not_ended ? ended[i] : least[i] + half_step * (2 + near[i]);
  }
}

void TimeField::paint(int reach, std::span<const ConvexOutline> outlines,
                      std::span<const PredictedBody> ahead, double radius, const RiskParams& risk) {
  for (int row = half_ - reach; row <= half_ + reach; ++row) {
    const std::size_t first = cell_index(half_ - reach, row);
    std::copy_n(&standing_[first], 2 * reach + 1, &risk_[first]);
  }
  for (std::size_t i = 0; i < outlines.size(); ++i)
    paint_one(reach, outlines[i], ahead[i], radius, risk);
}

void TimeField::paint_one(int reach, const ConvexOutline& outline, const PredictedBody& ahead,
                          double radius, const RiskParams& risk) {
  const double grown = radius + ahead.growth;
  const double felt = outline.radius + grown + risk.reach + ahead.uncertainty;
  const Vec2 middle = (ahead.centre - centre_) / cell_ +
                      Vec2{static_cast<double>(half_), static_cast<double>(half_)};
  const double cells = felt / cell_;
  if (!(cells > 0) || !is_finite(middle)) return;
  const auto first = [&](double m) {
    return static_cast<int>(std::ceil(std::max(m - cells, static_cast<double>(half_ - reach))));
  };
  const auto last = [&](double m) {
    return static_cast<int>(std::floor(std::min(m + cells, static_cast<double>(half_ + reach))));
  };
  const int left = first(middle.x);
  const int count = last(middle.x) - left + 1;
  if (count <= 0) return;
  const auto cell = static_cast<float>(cell_);
  const auto x0 = static_cast<float>((left - middle.x) * cell_);
  const auto rim = static_cast<float>(outline.radius + grown);
  float* const gap = row_.data();
  const Vec2 turned = unit_vector(ahead.turn);
  for (int row = first(middle.y); row <= last(middle.y); ++row) {
    const auto y = static_cast<float>((row - middle.y) * cell_);
    for (int i = 0; i < count; ++i) {
      const float x = x0 + static_cast<float>(i) * cell;
      gap[i] = std::sqrt(x * x + y * y) - rim;
    }
    for (const ConvexOutline::Edge& edge : outline.edges) {
      const auto nx = static_cast<float>(turned.x * edge.normal.x - turned.y * edge.normal.y);
      const auto ny = static_cast<float>(turned.y * edge.normal.x + turned.x * edge.normal.y);
      const float base = nx * x0 + ny * y - static_cast<float>(edge.offset + grown);
      const float slope = nx * cell;
      for (int i = 0; i < count; ++i)
        gap[i] = std::max(gap[i], base + static_cast<float>(i) * slope);
    }
    float* const worst = &risk_[cell_index(left, row)];
    const auto uncertainty = static_cast<float>(ahead.uncertainty);
    for (int i = 0; i < count; ++i)
      worst[i] = std::max(worst[i], penetration_risk(risk, gap[i], uncertainty));
  }
}

double TimeField::cost(int k, Vec2 p) const {
  const Vec2 at =
      (p - centre_) / cell_ + Vec2{static_cast<double>(half_), static_cast<double>(half_)};
  const auto index = [&](double v) {
    return static_cast<int>(std::clamp(std::floor(v), 0.0, static_cast<double>(width_ - 2)));
  };
  const int column = index(at.x);
  const int row = index(at.y);
  const double fx = std::clamp(at.x - column, 0.0, 1.0);
  const double fy = std::clamp(at.y - row, 0.0, 1.0);
  const auto& cost = cost_[static_cast<std::size_t>(k)];
  const auto value = [&](int i, int j) {
    return static_cast<double>(cost[cell_index(column + i, row + j)]);
  };
  return (1 - fy) * ((1 - fx) * value(0, 0) + fx * value(1, 0)) +
         fy * ((1 - fx) * value(0, 1) + fx * value(1, 1));
}

Vec2 TimeField::next(int k, Vec2 p) const {
  Vec2 best = p;
  double least = cost(k + 1, p);
  for (const Move& move : moves_) {
    const Vec2 there = p + cell_ * move.offset;
    const double c = cost(k + 1, there) + static_cast<double>(move.extra);
    if (c >= least) continue;
    least = c;
    best = there;
  }
  return best;
}

}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/vision/vessels/rings.hpp"

namespace microswarm::vision {
namespace {

constexpr double max_smoothing = 0.5;  // cells; maximum move of a vertex

struct Cell {
  int column = 0;
  int row = 0;
  friend Cell operator+(Cell a, Cell b) { return {a.column + b.column, a.row + b.row}; }
};

/// Directions east, north, west, south as picture steps with rows down. Side k of a cell runs along
/// direction k with the cell on its left; direction k − 1 points outwards.
constexpr std::array<Cell, 4> side_directions{{{1, 0}, {0, -1}, {-1, 0}, {0, 1}}};

bool is_set(const formats::Mask& mask, Cell c) {
  return c.column >= 0 && c.row >= 0 && c.column < mask.width && c.row < mask.height &&
         mask.at(c.column, c.row) != 0;
}

struct PixelSide {
  Cell cell;
  int k = 0;
};

/// The next side with set cells on the left. Cells that touch only at a corner are separate.
PixelSide next(const formats::Mask& mask, PixelSide side) {
  const Cell ahead = side.cell + side_directions[side.k];
  if (!is_set(mask, ahead)) return {side.cell, (side.k + 1) % 4};
  const int outwards = (side.k + 3) % 4;
  const Cell beside = ahead + side_directions[outwards];
  if (!is_set(mask, beside)) return {ahead, side.k};
  return {beside, outwards};
}

/// Piece index of each set cell, from 0 in the order of the pieces' first cells; −1 where unset.
std::pair<std::vector<int>, int> pieces_by_edges(const formats::Mask& mask) {
  std::vector<int> piece(mask.cells.size(), -1);
  std::vector<Cell> open;
  int count = 0;
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column) {
      if (!mask.at(column, row) || piece[mask.index(column, row)] >= 0) continue;
      piece[mask.index(column, row)] = count;
      open.push_back({column, row});
      while (!open.empty()) {
        const Cell c = open.back();
        open.pop_back();
        for (const Cell d : side_directions) {
          const Cell n = c + d;
          if (!is_set(mask, n) || piece[mask.index(n.column, n.row)] >= 0) continue;
          piece[mask.index(n.column, n.row)] = count;
          open.push_back(n);
        }
      }
      ++count;
    }
  return {std::move(piece), count};
}

/// Traces all rings; each exposed side belongs to exactly one.
class Tracer {
 public:
  Tracer(const formats::Mask& mask, double cell, Vec2 lo)
      : mask_(mask), cell_(cell), lo_(lo), traced_(mask.cells.size(), 0) {}

  bool is_start(PixelSide side) const {
    return !is_set(mask_, side.cell + side_directions[(side.k + 3) % 4]) &&
           !(traced(side) & bit(side));
  }

  std::vector<Vec2> trace(PixelSide start) {
    std::vector<Vec2> ring;
    PixelSide side = start;
    do {
      traced_[mask_.index(side.cell.column, side.cell.row)] |= bit(side);
      ring.push_back(middle(side));
      side = next(mask_, side);
    } while (!(traced(side) & bit(side)));
    return ring;
  }

 private:
  static std::uint8_t bit(PixelSide side) { return static_cast<std::uint8_t>(1 << side.k); }
  std::uint8_t traced(PixelSide side) const {
    return traced_[mask_.index(side.cell.column, side.cell.row)];
  }
  Vec2 middle(PixelSide side) const {
    const Cell out = side_directions[(side.k + 3) % 4];
    return lo_ + cell_ * Vec2{side.cell.column + 0.5 + 0.5 * out.column,
                              mask_.height - side.cell.row - 0.5 - 0.5 * out.row};
  }

  const formats::Mask& mask_;
  double cell_;
  Vec2 lo_;
  std::vector<std::uint8_t> traced_;
};

void require_sizes(double cell, double tolerance, Vec2 lo) {
  if (!(cell > 0) || !std::isfinite(cell))
    throw InputError("outline: cell " + number_text(cell) + " µm, expected above 0");
  if (!(tolerance >= 0) || !std::isfinite(tolerance))
    throw InputError("outline: tolerance " + number_text(tolerance) + " µm, expected at least 0");
  if (!is_finite(lo)) throw InputError("outline: the lower left corner is not finite");
}

}  // namespace

std::vector<Polygon> outline(const formats::Mask& mask, double cell, double tolerance, Vec2 lo,
                             const Stop& stop) {
  require_sizes(cell, tolerance, lo);
  const auto [piece, count] = pieces_by_edges(mask);
  std::vector<std::vector<Vec2>> rings;
  std::vector<int> ring_piece;
  Tracer tracer(mask, cell, lo);
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column) {
      if (!mask.at(column, row)) continue;
      for (int k = 0; k < 4; ++k) {
        const PixelSide side{{column, row}, k};
        if (!tracer.is_start(side)) continue;
        rings.push_back(tracer.trace(side));
        ring_piece.push_back(piece[mask.index(column, row)]);
      }
    }
  if (!stop()) smooth_rings(rings, cell, std::min(tolerance / 2, max_smoothing * cell));
  if (!stop()) thin_rings(rings, cell, tolerance / 2, stop);

  std::vector<Polygon> polygons(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < rings.size(); ++i) {
    Polygon& polygon = polygons[static_cast<std::size_t>(ring_piece[i])];
    if (signed_area(rings[i]) > 0)
      polygon.outer = std::move(rings[i]);
    else
      polygon.holes.push_back(std::move(rings[i]));
  }
  return polygons;
}

std::vector<Polygon> walls_around(const formats::Mask& network, double cell, double tolerance,
                                  Vec2 lo, const Stop& stop) {
  formats::Mask walls(network.width + 2, network.height + 2);
  for (int row = 0; row < walls.height; ++row)
    for (int column = 0; column < walls.width; ++column)
      walls.cells[walls.index(column, row)] = !is_set(network, {column - 1, row - 1});
  return outline(walls, cell, tolerance, lo - Vec2{cell, cell}, stop);
}

}  // namespace microswarm::vision

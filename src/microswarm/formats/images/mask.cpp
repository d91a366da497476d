// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/mask.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/geometry/distance.hpp"

namespace microswarm::formats {
namespace {

/// Corner of cells: column 0..width from the left, row 0..height from the top.
struct Corner {
  int column;
  int row;
  friend bool operator==(Corner, Corner) = default;
};

enum Direction : unsigned { east, north, west, south };
constexpr unsigned turned_left(unsigned d) { return (d + 1) & 3U; }
constexpr unsigned turned_right(unsigned d) { return (d + 3) & 3U; }

/// Traces the borders of the set cells with the cells on the left, and records which ring used
/// which vertical edge. Cells outside the mask are not set.
class Tracer {
 public:
  explicit Tracer(const Mask& mask)
      : stride_(mask.width + 2), set_(padded(mask)), ring_of_(set_.size(), no_ring) {}

  static constexpr std::uint32_t no_ring = ~0U;

  bool is_set(int column, int row) const { return set_[at(column, row)] != 0; }
  /// Ring that used the left edge of the cell; no_ring if none yet.
  std::uint32_t ring_of_left_edge(int column, int row) const { return ring_of_[at(column, row)]; }

  /// Corners where the ring turns, starting with the edge that leaves `start` in direction `first`.
  std::vector<Corner> trace(Corner start, unsigned first, std::uint32_t ring) {
    std::vector<Corner> turns;
    Corner corner = start;
    unsigned direction = first;
    do {
      step(corner, direction, ring);
      const unsigned next = next_direction(corner, direction);
      if (next != direction) turns.push_back(corner);
      direction = next;
    } while (corner != start || direction != first);
    return turns;
  }

 private:
  std::vector<std::uint8_t> padded(const Mask& mask) const {
    std::vector<std::uint8_t> cells(static_cast<std::size_t>(stride_) *
                                    static_cast<std::size_t>(mask.height + 2));
    for (int row = 0; row < mask.height; ++row) {
      std::copy_n(mask.cells.begin() + static_cast<std::ptrdiff_t>(mask.index(0, row)), mask.width,
                  cells.begin() + static_cast<std::ptrdiff_t>(at(0, row)));
    }
    return cells;
  }

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row + 1) * static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(column + 1);
  }

  void step(Corner& corner, unsigned direction, std::uint32_t ring) {
    switch (direction) {
      case east:
        ++corner.column;
        break;
      case west:
        --corner.column;
        break;
      case north:
        ring_of_[at(corner.column, --corner.row)] = ring;
        break;
      default:
        ring_of_[at(corner.column, corner.row++)] = ring;
    }
  }

  /// Direction after a corner, from the two cells ahead. If the right one is set, turn right, which
  /// keeps cells together that touch only by a corner. If only the left one is set, go straight on.
  /// If neither is, turn left.
  unsigned next_direction(Corner corner, unsigned direction) const {
    // North-east, north-west, south-west and south-east of the corner.
    static constexpr std::array<std::pair<int, int>, 4> around{
        {{0, -1}, {-1, -1}, {-1, 0}, {0, 0}}};
    const auto ahead = [&](unsigned quadrant) {
      const auto [dc, dr] = around[quadrant];
      return is_set(corner.column + dc, corner.row + dr);
    };
    if (ahead(turned_right(direction))) return turned_right(direction);
    return ahead(direction) ? direction : turned_left(direction);
  }

  int stride_;
  std::vector<std::uint8_t> set_;
  std::vector<std::uint32_t> ring_of_;
};

void check_cell(const Mask& mask, double cell, Vec2 lo) {
  const Box box = cell_bounds(mask, cell, lo);
  if (!(cell > 0) || !is_finite(box.lo) || !is_finite(box.hi))
    throw InputError("cells of " + number_text(cell) + " µm from (" + number_text(lo.x) + ", " +
                     number_text(lo.y) + "): must be above 0 and finite");
}

}  // namespace

Mask threshold(const Image& image, int level, bool dark_is_set) {
  const Image grey = to_grey(image);
  Mask mask(image.width, image.height);
  for (std::size_t i = 0; i < mask.cells.size(); ++i)
    mask.cells[i] = (grey.pixels[i] < level) == dark_is_set;
  return mask;
}

Box cell_bounds(const Mask& mask, double cell, Vec2 lo) {
  return {lo, {lo.x + mask.width * cell, lo.y + mask.height * cell}};
}

Vec2 cell_centre(const Mask& mask, int column, int row, double cell, Vec2 lo) {
  return {lo.x + (column + 0.5) * cell, lo.y + (mask.height - row - 0.5) * cell};
}

std::vector<Polygon> mask_walls(const Mask& set, double cell, Vec2 lo) {
  check_cell(set, cell, lo);
  Tracer tracer(set);
  std::vector<Polygon> walls;
  std::vector<std::uint32_t> ring_walls;  // for each ring
  const auto ring = [&](Corner start, unsigned direction) {
    const auto number = static_cast<std::uint32_t>(ring_walls.size());
    const std::vector<Corner> corners = tracer.trace(start, direction, number);
    std::vector<Vec2> points;
    points.reserve(corners.size());
    for (const Corner c : corners)
      points.push_back({lo.x + c.column * cell, lo.y + (set.height - c.row) * cell});
    return points;
  };
  // Row by row, a component is first met at its outer ring. A hole is met at the right end of a run
  // of cells whose left end belongs to a known ring of the same component.
  for (int row = 0; row < set.height; ++row) {
    std::uint32_t left_ring = Tracer::no_ring;
    bool was_set = false;
    for (int column = 0; column <= set.width; ++column) {
      const bool is_set = tracer.is_set(column, row);
      if (is_set == was_set) continue;
      was_set = is_set;
      if (tracer.ring_of_left_edge(column, row) == Tracer::no_ring) {
        if (is_set) {
          walls.push_back({ring({column, row}, south), {}});
          ring_walls.push_back(static_cast<std::uint32_t>(walls.size() - 1));
        } else {
          const std::uint32_t wall = ring_walls[left_ring];
          walls[wall].holes.push_back(ring({column, row + 1}, north));
          ring_walls.push_back(wall);
        }
      }
      left_ring = tracer.ring_of_left_edge(column, row);
    }
  }
  return walls;
}

namespace {

/// Marks in `kept` the vertices between `first` and `last` (counted around the ring) that
/// Douglas–Peucker keeps.
void keep_far_ones(const std::vector<Vec2>& ring, std::size_t first, std::size_t last,
                   double tolerance, std::vector<bool>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> todo{{first, last}};
  while (!todo.empty()) {
    const auto [i, j] = todo.back();
    todo.pop_back();
    const Segment chord{ring[i % ring.size()], ring[j % ring.size()]};
    double farthest = tolerance;
    std::size_t worst = i;
    for (std::size_t k = i + 1; k < j; ++k) {
      const double d = distance(ring[k % ring.size()], chord);
      if (d > farthest) farthest = d, worst = k;
    }
    if (worst == i) continue;
    kept[worst % ring.size()] = true;
    todo.push_back({i, worst});
    todo.push_back({worst, j});
  }
}

std::size_t farthest_from(const std::vector<Vec2>& ring, std::size_t from) {
  std::size_t far = from;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (distance(ring[i], ring[from]) > distance(ring[far], ring[from])) far = i;
  return far;
}

void simplify_ring(std::vector<Vec2>& ring, double tolerance) {
  if (ring.size() < 4) return;
  // Two distant vertices are kept, independent of the ring's first vertex.
  const std::size_t a = farthest_from(ring, 0);
  const std::size_t b = farthest_from(ring, a);
  if (a == b) return;
  std::vector<bool> kept(ring.size(), false);
  kept[a] = kept[b] = true;
  const auto [first, second] = std::minmax(a, b);
  keep_far_ones(ring, first, second, tolerance, kept);
  keep_far_ones(ring, second, first + ring.size(), tolerance, kept);
  std::vector<Vec2> simple;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (kept[i]) simple.push_back(ring[i]);
  if (simple.size() >= 3) ring = std::move(simple);
}

}  // namespace

void simplify(std::vector<Polygon>& polygons, double tolerance) {
  if (!(tolerance > 0)) return;
  for (Polygon& polygon : polygons) {
    simplify_ring(polygon.outer, tolerance);
    for (auto& hole : polygon.holes) simplify_ring(hole, tolerance);
  }
}

}  // namespace microswarm::formats

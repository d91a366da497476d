// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/gathering/node_lookup.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

namespace microswarm::planning {
namespace {

constexpr double cells_per_node = 4;
constexpr double max_lookup_cells = 4e6;
/// Number of times the search for a visible node doubles its radius.
constexpr int max_doublings = 3;
/// A cell this many diagonals from all nodes was not reached by the tree.
constexpr double farthest = 8;
/// Maximum distance, in cells, at which a robot looks for a visible node.
constexpr int max_rings = 12;

/// Lists the candidate nodes of one cell.
class CellSearch {
 public:
  CellSearch(const Map& map, const PointGrid& grid, Vec2 cell)
      : map_(map), grid_(grid), half_(0.5 * cell), diagonal_(norm(cell) * (1 + 1e-9)) {}

  std::span<const std::uint32_t> nodes_around(Vec2 centre) {
    const std::uint32_t nearest = grid_.nearest(centre);
    const double least = distance(centre, grid_[nearest]);
    const bool is_wall =
        map_.field().lower(centre) + map_.field().spread() < -diagonal_ / 2;  // never queried
    if (is_wall || least > farthest * diagonal_) {
      listed_.assign(1, nearest);
      return listed_;
    }
    list_within(centre, least + diagonal_);
    if (!map_.is_free(centre, least + diagonal_)) {
      find_viewpoints(centre);
      if (const std::optional<double> seen = distance_to_seen(centre, least + diagonal_)) {
        list_within(centre, *seen + diagonal_);
        std::erase_if(listed_, [&](std::uint32_t node) { return !is_seen(node); });
      }
    }
    drop_dominated(centre);
    return listed_;
  }

 private:
  void list_within(Vec2 centre, double radius) {
    listed_.clear();
    grid_.within(centre, radius, listed_);
  }
  void find_viewpoints(Vec2 centre) {
    viewpoints_.clear();
    for (const Vec2 side : {Vec2{0, 0}, Vec2{-1, -1}, Vec2{1, -1}, Vec2{-1, 1}, Vec2{1, 1}}) {
      const Vec2 p = centre + 0.99 * Vec2{side.x * half_.x, side.y * half_.y};
      if (map_.is_free(Segment{p, p}, 0)) viewpoints_.push_back(p);
    }
  }
  bool is_seen(std::uint32_t node) const {
    return std::any_of(viewpoints_.begin(), viewpoints_.end(), [&](Vec2 p) {
      return map_.is_free(Segment{p, grid_[node]}, 0);
    });
  }
  /// Distance from the centre to the nearest node visible from the cell.
  std::optional<double> distance_to_seen(Vec2 centre, double radius) {
    if (viewpoints_.empty()) return std::nullopt;
    for (int i = 0; i < max_doublings; ++i, radius *= 2) {
      list_within(centre, radius);
      double least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t node : listed_) {
        const double d = distance(centre, grid_[node]);
        if (d < least && is_seen(node)) least = d;
      }
      if (std::isfinite(least)) return least;
    }
    return std::nullopt;
  }

  /// Drops a node if another is nearer to all four corners, and hence to the whole cell.
  void drop_dominated(Vec2 centre) {
    std::sort(listed_.begin(), listed_.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double d_a = squared_norm(grid_[a] - centre);
      const double d_b = squared_norm(grid_[b] - centre);
      return d_a != d_b ? d_a < d_b : a < b;
    });
    std::size_t kept = 0;
    for (const std::uint32_t node : listed_) {
      const auto dominates = [&](std::uint32_t other) { return is_beyond(node, other, centre); };
      const auto end = listed_.begin() + static_cast<std::ptrdiff_t>(kept);
      if (std::none_of(listed_.begin(), end, dominates)) listed_[kept++] = node;
    }
    listed_.resize(kept);
    std::sort(listed_.begin(), listed_.end());
  }
  /// Whether every point of the cell is nearer to `other` than to `node`, with a margin for
  /// rounding.
  bool is_beyond(std::uint32_t node, std::uint32_t other, Vec2 centre) const {
    const Vec2 apart = grid_[node] - grid_[other];
    const Vec2 middle = 0.5 * (grid_[node] + grid_[other]);
    const double reach = std::abs(apart.x) * half_.x + std::abs(apart.y) * half_.y;
    return dot(centre - middle, apart) + reach < -1e-9 * squared_norm(half_);
  }

  const Map& map_;
  const PointGrid& grid_;
  Vec2 half_;
  double diagonal_;
  std::vector<Vec2> viewpoints_;
  std::vector<std::uint32_t> listed_;
};

}  // namespace

NodeLookup::NodeLookup(const Map& map, const PointGrid& grid, const Stop& stop) {
  assert(!grid.empty());
  const Box& bounds = map.bounds();
  const double wanted =
      std::min(cells_per_node * static_cast<double>(grid.size()) + 1000, max_lookup_cells);
  const double side = std::sqrt(bounds.width() * bounds.height() / wanted);
  grid_ = {bounds, static_cast<int>(std::clamp(bounds.width() / side, 1.0, wanted)),
           static_cast<int>(std::clamp(bounds.height() / side, 1.0, wanted))};
  CellSearch search(map, grid, grid_.cell());
  for (int row = 0; row < grid_.rows(); ++row) {
    for (int column = 0; column < grid_.columns(); ++column) {
      first_.push_back(static_cast<std::uint32_t>(listed_.size()));
      if (stop()) {
        listed_.push_back(0);
        continue;
      }
      const auto nodes = search.nodes_around(grid_.cell_centre(column, row));
      listed_.insert(listed_.end(), nodes.begin(), nodes.end());
    }
  }
  first_.push_back(static_cast<std::uint32_t>(listed_.size()));
}

std::optional<std::uint32_t> NodeLookup::nearest_visible(const Map& map, Vec2 p,
                                                         std::span<const Vec2> nodes) const {
  const int column = grid_.find_column(p.x), row = grid_.find_row(p.y);
  const double side = std::min(grid_.cell().x, grid_.cell().y);
  std::optional<std::uint32_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (int ring = 0; ring <= max_rings && (ring - 1) * side < least; ++ring) {
    for (int j = std::max(0, row - ring); j <= std::min(grid_.rows() - 1, row + ring); ++j) {
      const int stride = std::abs(j - row) == ring ? 1 : std::max(1, 2 * ring);
      for (int i = column - ring; i <= column + ring; i += stride) {
        if (i < 0 || i >= grid_.columns()) continue;
        for (const std::uint32_t node : listed(grid_.number(i, j))) {
          const double d = distance(p, nodes[node]);
          if (d >= least || !map.is_free(Segment{p, nodes[node]}, 0)) continue;
          least = d;
          best = node;
        }
      }
    }
  }
  return best;
}

}  // namespace microswarm::planning

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/global_input/coverage.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::planning {
namespace {

constexpr double max_space_cells = 1 << 24;
constexpr int samples_along = 16;

class Cells {
 public:
  Cells(const Map& map, double cell) : map_(map), cell_(cell) {
    const Box& bounds = map.bounds();
    const double columns = std::ceil(bounds.width() / cell);
    const double rows = std::ceil(bounds.height() / cell);
    if (!(cell > 0) || !(columns * rows <= max_space_cells))
      throw InputError("coverage cell: " + std::to_string(cell) +
                       " um, must be above 0 and leave at most 2^24 cells");
    columns_ = static_cast<std::uint32_t>(columns);
    rows_ = static_cast<std::uint32_t>(rows);
  }

  std::size_t count() const { return std::size_t{columns_} * rows_; }

  std::uint32_t at(Vec2 p) const {
    const Vec2 q = (p - map_.bounds().lo) / cell_;
    const auto clamp = [](double v, std::uint32_t cells) {
      return static_cast<std::uint32_t>(std::clamp(v, 0.0, cells - 1.0));
    };
    return clamp(q.y, rows_) * columns_ + clamp(q.x, columns_);
  }

  bool is_free(std::uint32_t index) const {
    const auto column = index % columns_;
    const auto row = index / columns_;
    const Vec2 low =
        map_.bounds().lo + cell_ * Vec2{static_cast<double>(column), static_cast<double>(row)};
    for (int j = 0; j < samples_along; ++j)
      for (int i = 0; i < samples_along; ++i)
        if (map_.is_free(low + cell_ / samples_along * Vec2{i + 0.5, j + 0.5}, 0)) return true;
    return false;
  }

 private:
  const Map& map_;
  double cell_;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
};

/// Number of distinct hypercubes that contain nodes.
std::size_t count_hypercubes(const std::vector<std::uint32_t>& cells, std::size_t robots) {
  const auto cube = [&](std::uint32_t node) { return cells.begin() + robots * node; };
  const auto hash = [&](std::uint32_t node) {
    std::uint64_t h = 0;
    for (std::size_t i = 0; i < robots; ++i)
      h = (h ^ cube(node)[i]) * 0x9e3779b97f4a7c15ULL, h ^= h >> 29;
    return static_cast<std::size_t>(h);
  };
  const auto equal = [&](std::uint32_t a, std::uint32_t b) {
    return std::equal(cube(a), cube(a) + robots, cube(b));
  };
  std::unordered_set<std::uint32_t, decltype(hash), decltype(equal)> occupied(64, hash, equal);
  for (std::uint32_t node = 0; node < cells.size() / robots; ++node) occupied.insert(node);
  return occupied.size();
}

}  // namespace

Coverage coverage(const Map& map, const GlobalTree& tree, double cell) {
  const Cells plane(map, cell);
  std::vector<std::uint32_t> cells;
  std::vector<std::uint8_t> was_seen(plane.count(), 0);
  for (std::uint32_t node = 0; node < tree.size(); ++node) {
    for (std::size_t i = 0; i < tree.robots; ++i) {
      cells.push_back(plane.at(tree.position(node, i)));
      was_seen[cells.back()] = 1;
    }
  }
  Coverage result;
  if (!cells.empty()) result.occupied = count_hypercubes(cells, tree.robots);
  for (std::uint32_t i = 0; i < plane.count(); ++i)
    result.free_cells += was_seen[i] != 0 || plane.is_free(i);
  const double all =
      maths::power(static_cast<double>(result.free_cells), static_cast<int>(tree.robots));
  if (result.free_cells > 0) result.share = static_cast<double>(result.occupied) / all;
  return result;
}

}  // namespace microswarm::planning

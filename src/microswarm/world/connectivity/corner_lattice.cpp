// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/connectivity/corner_lattice.hpp"
#include "microswarm/core/fields/overloaded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace microswarm {
namespace {

/// The coordinates of corners along one axis [µm], and how many corners have each.
using Histogram = std::unordered_map<double, std::uint32_t>;

struct Axis {
  Histogram corners;
  double anchor = 0;  ///< the coordinate of most corners
};

void find_anchor(Axis& axis) {
  std::uint32_t most = 0;
  for (const auto& [at, count] : axis.corners) {
    if (count < most || (count == most && at > axis.anchor)) continue;
    axis.anchor = at;
    most = count;
  }
}

std::array<Axis, 2> lattice_axes(const Map& map) {
  std::array<Axis, 2> axes;
  for (const Body& body : map.walls().bodies()) {
    std::visit(Overloaded{[](const Disc&) {},
                          [&](const Polygon& polygon) {
                            for_each_edge(polygon, [&](Vec2, Vec2 corner) {
                              ++axes[0].corners[corner.x];
                              ++axes[1].corners[corner.y];
                            });
                          }},
               body.shape);
  }
  for (Axis& axis : axes) find_anchor(axis);
  return axes;
}

/// Distances from the anchors [µm], ascending.
std::vector<double> distances(const std::array<Axis, 2>& axes) {
  std::vector<double> all;
  all.reserve(axes[0].corners.size() + axes[1].corners.size());
  for (const Axis& axis : axes)
    for (const auto& [at, count] : axis.corners) all.push_back(std::abs(at - axis.anchor));
  std::sort(all.begin(), all.end());
  return all;
}

/// Distance to the nearest multiple of the pitch.
double off(double distance, double pitch) { return std::abs(std::remainder(distance, pitch)); }

/// Greatest common divisor of lengths [µm] that are known to within `error`; those that would make
/// it less than `least` are left out. Long multiples make it more accurate; 0 if there is none.
double common_divisor(const std::vector<double>& ascending, double least, double error) {
  double divisor = 0;
  for (const double length : ascending) {
    if (length < least) continue;
    double common = divisor > 0 ? divisor : length;
    for (double rest = off(length, common); rest > error;) {
      const double next = off(common, rest);
      common = rest;
      rest = next;
    }
    if (common >= least) divisor = length / std::round(length / common);
  }
  return divisor;
}

/// Whether 99 of 100 corners are on a lattice through the anchor.
bool is_on(const Axis& axis, double pitch, double error) {
  std::size_t all = 0, elsewhere = 0;
  for (const auto& [at, count] : axis.corners) {
    all += count;
    if (off(at - axis.anchor, pitch) > error) elsewhere += count;
  }
  return 100 * elsewhere <= all;
}

}  // namespace

std::optional<CornerLattice> corner_lattice(const Map& map, double min_pitch) {
  const std::array<Axis, 2> axes = lattice_axes(map);
  const double error = 1e-3 * min_pitch;
  const double pitch = common_divisor(distances(axes), min_pitch, error);
  if (pitch == 0 || !is_on(axes[0], pitch, error) || !is_on(axes[1], pitch, error))
    return std::nullopt;
  return CornerLattice{{axes[0].anchor, axes[1].anchor}, pitch};
}

CornerLattice through_narrowest_passage(const CornerLattice& corners, double clearance) {
  // Passages that leave a millionth of a cell less are taken for wide enough, against rounding.
  const double cells = std::max(1.0, std::ceil(2 * clearance / corners.pitch - 1e-6));
  const double middle = std::remainder(cells, 2.0) == 0 ? 0 : 0.5 * corners.pitch;
  return {corners.origin + Vec2{middle, middle}, corners.pitch};
}

int shortest_free_run(const Map& map, const CornerLattice& positions, double clearance, int most) {
  const Box& bounds = map.bounds();
  const Vec2 lowest = (bounds.lo - positions.origin) / positions.pitch;
  const Vec2 first =
      positions.origin + positions.pitch * Vec2{std::ceil(lowest.x), std::ceil(lowest.y)};
  const auto columns = static_cast<std::size_t>((bounds.hi.x - first.x) / positions.pitch + 1);
  std::vector<Vec2> row(columns);
  std::vector<std::uint8_t> free(columns);
  std::vector<int> runs(columns, 0);  // up the columns
  int shortest = most;
  const auto extend = [&](int& run, bool goes_on) {
    if (!goes_on && run > 0) shortest = std::min(shortest, run);
    run = goes_on ? run + 1 : 0;
  };
  for (double y = first.y; shortest > 1; y += positions.pitch) {
    for (std::size_t i = 0; i < columns; ++i)
      row[i] = {first.x + static_cast<double>(i) * positions.pitch, y};
    map.are_free(row, clearance, free);
    int run = 0;
    for (std::size_t i = 0; i < columns; ++i) {
      extend(run, free[i] != 0);
      extend(runs[i], free[i] != 0);
    }
    extend(run, false);
    if (y > bounds.hi.y) break;  // where nothing is free
  }
  return shortest;
}

}  // namespace microswarm

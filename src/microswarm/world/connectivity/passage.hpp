// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Approximate number of lattice nodes if no resolution is given.
inline constexpr double nodes_by_default = 100e3;

/// Narrow passage between two rooms.
struct Passage {
  Vec2 position{};
  double width = 0;  ///< [µm], twice the clearance at its middle
};

/// Analysis of a map, for users who check one before a run.
/// Free regions are the connected components of the bounds minus the walls, exact for polygons; a
/// disc counts as a polygon of 180 vertices with the same area. Regions that touch only in single
/// points are separate.
/// A passage of width 2w separates two rooms: the set of points with clearance >= w', connected for
/// every w' < w, splits at w. A room must have a point of clearance at least 1.25·w (and w +
/// resolution) and contain 0.1 % of the region's nodes; otherwise it is only a dent. Passages are
/// searched in the largest region, on nodes with spacing `resolution` joined by edges of exact
/// clearance. A width is never too large and at most 1.5·resolution too small; between two walls it
/// is exact.
struct MapReport {
  int wall_pieces = 0;
  double free_area = 0;                ///< [µm²]
  int free_pieces = 0;                 ///< connected free regions
  std::vector<double> region_areas{};  ///< [µm²], largest first
  double widest = 0;                   ///< diameter [µm] of the largest disc that fits
  Vec2 widest_place{};                 ///< centre of that disc, to 0.001 µm of clearance
  double narrowest_passage = 0;        ///< width [µm]; `widest` if the largest region is one room
  std::vector<Passage> passages{};     ///< narrowest first
  double resolution = 0;               ///< [µm]
};

/// `cell` [µm] is the resolution; 0 chooses about 100,000 nodes.
MapReport check_map(const Map& map, double cell = 0);

/// Whether two free points are in the same connected region of the free space. Exact for polygons;
/// discs as in MapReport.
bool connected(const Map& map, Vec2 a, Vec2 b);

/// Path between two points with the maximum clearance from walls and border.
struct WidestPath {
  bool found = false;        ///< false: no path with positive clearance at this resolution
  double clearance = 0;      ///< [µm], exact for `path`: the maximum swarm radius that fits
  Vec2 tightest{};           ///< point of minimum clearance
  std::vector<Vec2> path{};  ///< from a to b
  double resolution = 0;     ///< [µm]; the optimum has at most 1.5·resolution more clearance
};

/// Path from a to b that maximises the minimum clearance, by Dijkstra on a grid with exactly
/// measured edges. Clearance beyond `enough` is not distinguished. `cell` [µm] as in check_map.
WidestPath widest_path(const Map& map, Vec2 a, Vec2 b,
                       double enough = std::numeric_limits<double>::infinity(), double cell = 0);

}  // namespace microswarm

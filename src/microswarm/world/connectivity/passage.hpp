// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm {

/// Nodes of a lattice, about, where no resolution is given.
inline constexpr double nodes_by_default = 100e3;

/// A narrow place between two rooms.
struct Passage {
  Vec2 place;
  double width = 0;  ///< [µm], twice the clearance in its middle
};

/// What a map offers to a swarm, for people who check one before a run.
///
/// Free regions are the connected pieces of the bounds less the walls, found exactly for polygons;
/// a disc counts as a polygon of 180 corners and its area. Regions that touch in single points are
/// apart.
///
/// A passage is a place where the centres of a growing disc fall apart: at its width 2w the set of
/// points with clearance >= w, in one piece for any smaller w, parts into two rooms. A room must
/// have a place of clearance at least 1.25·w (and w + resolution), and hold 0.1 % of the region's
/// nodes, or else it is but a dent. Passages are looked for in the largest region, on nodes at the
/// spacing `resolution` joined by edges of exact clearance: a width found so is never too great,
/// and too small by 1.5·resolution at most; where the passage lies between two walls, it is exact.
struct MapReport {
  int wall_pieces = 0;
  double free_area = 0;              ///< [µm²]
  int free_pieces = 0;               ///< connected free regions
  std::vector<double> region_areas;  ///< [µm²], largest first
  double widest = 0;                 ///< diameter [µm] of the largest disc that fits
  Vec2 widest_place{};               ///< its centre, found to 0.001 µm of clearance
  double narrowest_passage = 0;      ///< width [µm]; `widest` when the largest region is one room
  std::vector<Passage> passages;     ///< narrowest first
  double resolution = 0;             ///< [µm]
};

/// `cell` [µm] is the resolution; 0 chooses about 100,000 nodes.
MapReport check_map(const Map& map, double cell = 0);

/// Are two free points in the same connected region of the free space? Exact for polygons; a disc
/// counts as above.
bool connected(const Map& map, Vec2 a, Vec2 b);

/// A way between two points that keeps as far from walls and border as possible.
struct WidestPath {
  bool found = false;      ///< false: no way with a clearance above 0 at this resolution
  double clearance = 0;    ///< [µm], exact for `path`: the largest swarm radius that gets through
  Vec2 tightest{};         ///< where it is that near
  std::vector<Vec2> path;  ///< from a to b
  double resolution = 0;   ///< [µm]; a better way has at most 1.5·resolution more clearance
};

/// Greatest least clearance from a to b on a grid whose edges are measured exactly (Dijkstra).
/// Clearance beyond `enough` is not looked for. `cell` [µm] as above.
WidestPath widest_path(const Map& map, Vec2 a, Vec2 b,
                       double enough = std::numeric_limits<double>::infinity(), double cell = 0);

}  // namespace microswarm

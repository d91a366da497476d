// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/clip.hpp"

#include <algorithm>
#include <clipper.hpp>
#include <cmath>
#include <string>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/geometry/edge_grid.hpp"
#include "microswarm/geometry/edge_meetings.hpp"

namespace microswarm {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

/// Bits that coordinates occupy on the clipper's integer grid.
constexpr int bits_of_extent = 40;

/// Maps the plane to the clipper's grid and back; remembers the vertex of each grid point.
class Lattice {
 public:
  explicit Lattice(const Box& box) : origin_(box.centre()) {
    const double extent = std::max({box.width(), box.height(), 1e-300});
    per_unit_ = std::ldexp(1.0, bits_of_extent - std::ilogb(extent));
  }

  Path to_path(std::span<const Vec2> ring) {
    Path path;
    path.reserve(ring.size());
    for (const Vec2 v : ring) {
      path.emplace_back(std::llround((v.x - origin_.x) * per_unit_),
                        std::llround((v.y - origin_.y) * per_unit_));
      known_.push_back({path.back(), v});
    }
    return path;
  }

  Paths to_paths(std::span<const Polygon> polygons) {
    Paths paths;
    for (const Polygon& polygon : polygons) {
      paths.push_back(to_path(polygon.outer));
      for (const auto& hole : polygon.holes) paths.push_back(to_path(hole));
    }
    return paths;
  }

  std::vector<Polygon> to_polygons(const ClipperLib::PolyTree& tree) {
    std::stable_sort(known_.begin(), known_.end(), before);
    std::vector<Polygon> out;
    for (const ClipperLib::PolyNode* node = tree.GetFirst(); node; node = node->GetNext()) {
      if (node->IsHole()) continue;
      Polygon polygon{to_ring(node->Contour), {}};
      for (const ClipperLib::PolyNode* hole : node->Childs) {
        polygon.holes.push_back(to_ring(hole->Contour));
      }
      polygon = normalised(std::move(polygon));
      if (!polygon.outer.empty()) out.push_back(std::move(polygon));
    }
    return out;
  }

 private:
  struct Known {
    IntPoint at;
    Vec2 vertex;
  };
  static bool before(const Known& a, const Known& b) {
    return std::pair(a.at.X, a.at.Y) < std::pair(b.at.X, b.at.Y);
  }

  std::vector<Vec2> to_ring(const Path& path) const {
    std::vector<Vec2> ring;
    ring.reserve(path.size());
    for (const IntPoint& p : path) {
      const auto found = std::lower_bound(known_.begin(), known_.end(), Known{p, {}}, before);
      const bool is_known = found != known_.end() && found->at == p;
      ring.push_back(is_known ? found->vertex
                              : origin_ + Vec2{static_cast<double>(p.X) / per_unit_,
                                               static_cast<double>(p.Y) / per_unit_});
    }
    return ring;
  }

  Vec2 origin_;
  double per_unit_;
  std::vector<Known> known_;
};

Box enclosing_disc(std::span<const Polygon> polygons) {
  Box box;
  for (const Polygon& polygon : polygons) {
    for (const Vec2 v : polygon.outer) box.include(v);
  }
  return box;
}

/// Edges beside the vertices of all rings, which the clipper goes through one by one.
double union_steps(const std::vector<Segment>& edges) {
  std::vector<double> heights;
  heights.reserve(edges.size());
  for (const Segment& e : edges) heights.push_back(e.a.y);
  std::ranges::sort(heights);
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  double steps = 0;
  for (const Segment& e : edges) {
    const auto [low, high] = std::minmax(e.a.y, e.b.y);
    steps += static_cast<double>(std::ranges::lower_bound(heights, high) -
                                 std::ranges::lower_bound(heights, low));
  }
  return steps;
}

/// Throws InputError for polygons whose union would take minutes.
void require_union(std::span<const Polygon> polygons) {
  std::vector<Segment> edges;
  for (const Polygon& polygon : polygons)
    for_each_edge(polygon, [&](Vec2 a, Vec2 b) { edges.push_back({a, b}); });
  if (const double steps = union_steps(edges); steps > max_union_steps)
    throw InputError("the walls have " + std::to_string(edges.size()) +
                     " edges to be united that are beside each other too often, " +
                     std::to_string(std::llround(steps)) + " times, at most " +
                     std::to_string(std::llround(max_union_steps)));
  const EdgeGrid grid(edges, std::vector<std::uint32_t>(edges.size(), 0));
  if (!for_each_meeting(grid, [](std::size_t, std::size_t) { return true; }))
    fail_too_many_meetings(edges.size());
}

}  // namespace

std::vector<Polygon> united(std::span<const Polygon> polygons) {
  require_union(polygons);
  Lattice lattice(enclosing_disc(polygons));
  ClipperLib::Clipper clipper;
  clipper.AddPaths(lattice.to_paths(polygons), ClipperLib::ptSubject, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return lattice.to_polygons(tree);
}

std::vector<Polygon> difference(const Box& box, std::span<const Polygon> polygons) {
  Box extent = enclosing_disc(polygons);
  extent.include(box.lo);
  extent.include(box.hi);
  Lattice lattice(extent);
  const std::vector<Vec2> frame{box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}};
  ClipperLib::Clipper clipper;
  clipper.AddPath(lattice.to_path(frame), ClipperLib::ptSubject, true);
  clipper.AddPaths(lattice.to_paths(polygons), ClipperLib::ptClip, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctDifference, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return lattice.to_polygons(tree);
}

}  // namespace microswarm

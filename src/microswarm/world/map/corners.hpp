// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "microswarm/geometry/trapezoid_sight.hpp"
#include "microswarm/world/obstacles/body_set.hpp"

namespace microswarm {

/// Possible bend of a shortest path: a convex corner of a wall, or a disc. A path with
/// clearance c bends along the circle of radius `radius` + c around `centre`.
struct Corner {
  Vec2 centre{};
  double radius = 0;  ///< of the disc [µm]; 0 for the corner of a polygon
  double from = 0;    ///< direction from the corner in which the cone of its normals begins [rad]
  double width = 0;   ///< angle of that cone, counter-clockwise [rad]; 2π for a disc
  Vec2 first{}, last{};  ///< unit vectors where the cone begins and ends; unused for a disc
  bool is_disc = false;
};

/// Adds the corners of a body that are in the bounds. A disc is not numbered.
void add_corners(const Body& body, const Box& bounds, std::vector<Corner>& corners);

/// The corners of walls, and from which of them paths lead straight to which.
///
/// A shortest path with clearance c consists of arcs around corners and of tangents between them.
/// The strip within c of a tangent is free. It holds the straight line between what the tangent
/// touches around, so this line passes the ends of all walls on the same sides as the tangent,
/// which keeps c from them. Immutable, shared by threads.
class Corners {
 public:
  Corners(const BodySet& walls, const Box& bounds);

  std::span<const Corner> all() const { return corners_; }
  const Trapezoids& cells() const { return cells_; }

  /// Calls visit(number, sides) for the corners that a path from corner `i` may lead to straight,
  /// and for some more, for some repeatedly; sides() returns on which side the path may have them.
  /// It keeps `clearance` [µm], touches a circle of radius `radius` around the corner, a little
  /// more than that from its disc, and has it on its left.
  template <class Visit>
  void seen_from(std::uint32_t i, double radius, double clearance, bool left, Visit&& visit) const;
  /// The same from a place, step by step, what is near the way to a goal first: see
  /// TrapezoidLook.
  template <class Visit>
  void look_on(TrapezoidLook& look, double length, Visit&& visit) const;

 private:
  static constexpr std::uint32_t none = Trapezoids::none;
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  /// Lists of numbers, by number.
  struct Lists {
    std::vector<std::uint32_t> first, all;
    std::span<const std::uint32_t> of(std::uint32_t i) const {
      if (first.empty()) return {};
      return std::span(all).subspan(first[i], first[i + 1] - first[i]);
    }
    /// Of pairs (number of the list, number in it), which keep their order.
    static Lists made(std::size_t lists, const Pairs& pairs);
  };

  void index_polygons();
  void index_discs(std::span<const std::uint32_t> standing,
                   std::span<const std::uint32_t> overlapping);
  template <class Visit>
  void for_each_cell_at(std::span<const std::uint32_t> discs, Visit&& visit) const;

  template <class Visit>
  auto point_visitor(Visit& visit) const {
    return [this, &visit](std::uint32_t point, Sides sides) {
      for (const std::uint32_t corner : at_.of(point)) visit(corner, [sides] { return sides; });
    };
  }
  template <class Visit>
  auto cell_visitor(Visit& visit) const {
    return [this, &visit](std::uint32_t cell, auto&& find_sides) {
      const auto see = [&](std::uint32_t i) {
        visit(i, [&] { return find_sides(Disc{corners_[i].centre, corners_[i].radius}); });
      };
      const Trapezoids::Cell& here = cells_.cells()[cell];
      for (const std::uint32_t segment : {here.bottom, here.top})
        if (segment != none && disc_of_[segment] != none) see(disc_of_[segment]);
      for (const std::uint32_t disc : overlapping_.of(cell)) see(disc);
    };
  }

  std::vector<Corner> corners_;
  Trapezoids cells_;
  Lists at_;                            ///< corners at each point of the cells
  std::vector<std::uint32_t> disc_of_;  ///< corner of each segment; none for a wall's
  Lists around_;                        ///< cells at each corner that is a disc
  Lists overlapping_;                   ///< discs that overlap others, in each cell
};

template <class Visit>
void Corners::seen_from(std::uint32_t i, double radius, double clearance, bool left,
                        Visit&& visit) const {
  const Corner& corner = corners_[i];
  const Rays rays{corner.centre, left ? radius : -radius, clearance};
  if (corner.is_disc)
    TrapezoidSight(cells_).look_around(rays, around_.of(i), point_visitor(visit),
                                       cell_visitor(visit));
  else
    TrapezoidSight(cells_).look_around(rays, point_visitor(visit), cell_visitor(visit));
}

template <class Visit>
void Corners::look_on(TrapezoidLook& look, double length, Visit&& visit) const {
  look.go_on(length, point_visitor(visit), cell_visitor(visit));
}

}  // namespace microswarm

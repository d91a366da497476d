// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "microswarm/geometry/trapezoids.hpp"
#include "microswarm/world/obstacles/body_set.hpp"

namespace microswarm {

/// Where a shortest path can bend: at a convex corner of a wall, or around a disc. A path with
/// clearance c bends along the circle of radius `radius` + c around `centre`.
struct Corner {
  Vec2 centre;
  double radius = 0;  ///< of the disc [µm]; 0 for the corner of a polygon
  double from = 0;    ///< direction from the corner in which the cone of its normals begins [rad]
  double width = 0;   ///< angle of that cone, counter-clockwise [rad]; 2π for a disc
  Vec2 first, last;   ///< unit vectors where the cone begins and ends; unused for a disc
  bool is_disc = false;
};

/// Adds the corners of a body that are in the bounds. A disc is not numbered.
void add_corners(const Body& body, const Box& bounds, std::vector<Corner>& corners);

/// The corners of walls and which of them see each other.
///
/// A shortest path with clearance consists of arcs around corners and of tangents between them. The
/// strip within the clearance of a tangent is free. It holds all that lies between the tangent and
/// the straight line that joins the two corners, so these see each other among the bare walls,
/// whatever the clearance. What is seen among bare walls is therefore enough for every clearance.
/// Immutable, shared by threads.
class Corners {
 public:
  Corners(const BodySet& walls, const Box& bounds);

  std::span<const Corner> all() const { return corners_; }
  const Trapezoids& cells() const { return cells_; }

  /// Calls visit(number) for the corners that `p` sees and for some more, for some repeatedly.
  template <class Visit>
  void seen_from(Vec2 p, Visit&& visit) const;
  /// The same step by step, what is near the way to a goal first: see Trapezoids::Look.
  template <class Visit>
  void look_on(Trapezoids::Look& look, double length, Visit&& visit) const;
  /// Calls visit(number) for the corners that seen_from() visits from everywhere.
  template <class Visit>
  void seen_from_everywhere(Visit&& visit) const {
    for (const std::uint32_t disc : loose_) visit(disc);
  }
  /// The same for all that sees a part of corner `i`, itself included.
  template <class Visit>
  void seen_from_corner(std::uint32_t i, Visit&& visit) const;

 private:
  static constexpr std::uint32_t none = Trapezoids::none;
  using Inscribed = std::array<std::uint32_t, 4>;  // points, from left to right

  void index(std::vector<Segment> segments, std::span<const std::uint32_t> standing);

  template <class Visit>
  auto point_visitor(Visit& visit) const {
    return [this, &visit](std::uint32_t point) {
      for (std::uint32_t k = first_at_[point]; k < first_at_[point + 1]; ++k) visit(at_[k]);
    };
  }
  template <class Visit>
  auto segment_visitor(Visit& visit) const {
    return [this, &visit](std::uint32_t bottom, std::uint32_t top) {
      if (bottom != none && disc_of_[bottom] != none) visit(disc_of_[bottom]);
      if (top != none && disc_of_[top] != none) visit(disc_of_[top]);
    };
  }

  std::vector<Corner> corners_;
  Trapezoids cells_;
  std::vector<std::uint32_t> first_at_, at_;  ///< corners at each point of the cells
  std::vector<std::uint32_t> disc_of_;        ///< corner of each segment; none for a wall's
  std::vector<Inscribed> inscribed_;          ///< of each corner that is a disc and apart
  std::vector<std::uint32_t> loose_;          ///< corners of discs that overlap others
};

template <class Visit>
void Corners::seen_from(Vec2 p, Visit&& visit) const {
  for (const std::uint32_t disc : loose_) visit(disc);
  cells_.look_around(p, point_visitor(visit), segment_visitor(visit));
}

template <class Visit>
void Corners::look_on(Trapezoids::Look& look, double length, Visit&& visit) const {
  look.go_on(length, point_visitor(visit), segment_visitor(visit));
}

template <class Visit>
void Corners::seen_from_corner(std::uint32_t i, Visit&& visit) const {
  const Corner& corner = corners_[i];
  if (!corner.is_disc) return seen_from(corner.centre, visit);
  const Inscribed& inscribed = inscribed_[i];
  if (inscribed.front() == none) {
    for (std::uint32_t k = 0; k < corners_.size(); ++k) visit(k);
    return;
  }
  for (const std::uint32_t disc : loose_) visit(disc);
  cells_.look_around(Disc{corner.centre, corner.radius}, inscribed, point_visitor(visit),
                     segment_visitor(visit));
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "microswarm/planning/exact/turning_circle.hpp"

namespace microswarm::planning {

/// Tangents of the circles around a map's corners, for one clearance, computed at first use and
/// kept for later queries, which changes no result. A wheel is a circle with a sense:
/// counter-clockwise (even number) or clockwise (odd), and circle `i` has the wheels 2 i and
/// 2 i + 1. Not thread-safe.
class TangentGraph {
 public:
  static constexpr std::uint32_t none = ~0u;

  /// Whether a tangent is free of walls.
  enum class Walls : std::uint8_t { unknown, free, blocked };

  /// A tangent of two circles, with the angles of the normals at which it leaves and arrives,
  /// measured from the start of the corner's cone [rad].
  struct Hop {
    TangentLine line{};
    double leave = 0;
    double arrive = 0;        ///< if free
    double best = 0;          ///< for the query that uses it: length of a path over it [µm]
    std::uint32_t query = 0;  ///< for which `best` holds
    std::uint32_t to = none;  ///< wheel
    std::uint16_t leave_arc = 0;
    std::uint16_t arrive_arc = 0;  ///< if free
    Walls walls = Walls::unknown;
  };
  /// Free parts of a circle, as a range in a list of arcs.
  struct ArcRange {
    std::uint32_t first = 0;
    std::uint16_t count = 0;
    std::span<const Arc> of(const std::vector<Arc>& all) const {
      return std::span(all).subspan(first, count);
    }
  };

  /// Marks that the query of that number has left at a wheel. They stay from query to query, so
  /// that a short one does not pay for all wheels.
  struct Mark {
    std::uint32_t opened = 0;  ///< query that opened the line from its start
    std::uint32_t query = 0;   ///< for which `last_label` holds
    std::uint32_t last_label = none;
  };

  /// `map` must outlive the graph. `clearance` [µm].
  TangentGraph(const Map& map, double clearance);
  /// Continues with an equal copy of the map.
  void use(const Map& map) { map_ = &map; }

  const Map& map() const { return *map_; }
  const Corners& corners() const { return *corners_; }
  double clearance() const { return clearance_; }
  /// Rounding of lengths [µm], which the circles' radii have beyond the clearance.
  double margin() const { return margin_; }
  /// Approximate memory in use [B].
  std::size_t bytes() const { return bytes_; }

  /// Number of a new query. Replaces the circles of moving bodies, which follow those of the map's
  /// corners and have no hops; null without any.
  std::uint32_t begin_query(const BodySet* moving);
  /// Marks of the latest query, by wheel.
  std::vector<Mark>& marks() { return marks_; }
  const std::vector<Mark>& marks() const { return marks_; }
  std::uint32_t circle_count() const { return static_cast<std::uint32_t>(circles_.size()); }
  /// Number of circles around the map's corners.
  std::uint32_t still_count() const { return static_cast<std::uint32_t>(seen_.size() / 2); }
  const TurningCircle& circle(std::uint32_t number) const { return circles_[number]; }
  const TurningCircle& wheel_circle(std::uint32_t wheel) const { return circles_[wheel / 2]; }
  static double sense(std::uint32_t wheel) { return wheel % 2 == 0 ? 1 : -1; }

  /// Point of the wheel where a line leaves or arrives.
  Vec2 touch(std::uint32_t wheel, const TangentLine& line) const {
    return wheel_circle(wheel).touch(sense(wheel), line.along);
  }
  /// Angle of the normal at which a line leaves or arrives [rad].
  double angle_at(std::uint32_t wheel, const TangentLine& line) const {
    return wheel_circle(wheel).angle_at(-sense(wheel) * perpendicular(line.along));
  }
  /// Tangent of two circles; the margin admits a point on a circle that rounding put inside.
  std::optional<TangentLine> join(const TurningCircle& a, double sense_a, const TurningCircle& b,
                                  double sense_b) const {
    return tangent(a, sense_a, b, sense_b, 4 * margin_);
  }
  /// Hops of a wheel of the map in order of `leave`; those known to be blocked may be left out.
  std::vector<Hop>& hops(std::uint32_t wheel) {
    if (!wheels_[wheel].is_known) find_hops(wheel);
    return wheels_[wheel].hops;
  }
  /// Hop `index` of a wheel whose hops were found.
  Hop& hop(std::uint32_t wheel, std::uint32_t index) { return wheels_[wheel].hops[index]; }
  /// Counts a query that visits a circle of the map. After some visits its hops are tested, which
  /// renumbers them: none may be open.
  void visit(std::uint32_t circle);
  /// Whether a hop of the wheel `from` is free of walls.
  bool test(std::uint32_t from, Hop& hop);
  /// Index of the circle's arc free of walls that contains this angle; −1 if none does.
  int arc_at(std::uint32_t circle, double angle);
  /// Adds the arcs of a circle that are free of walls and, if given, of bodies.
  ArcRange cut(std::uint32_t circle, const BodySet* bodies, std::vector<Arc>& arcs) const;

 private:
  /// A circle with its free arcs.
  struct Circle : TurningCircle {
    ArcRange arcs;            ///< among the walls
    std::uint8_t visits = 0;  ///< queries so far, counted until its hops are settled
    bool is_cut = false;      ///< whether `arcs` was computed
  };
  struct Wheel {
    std::vector<Hop> hops;  ///< in order of `leave`
    bool is_known = false;  ///< whether its hops were found
  };

  Circle around(const Corner& corner) const;
  void find_hops(std::uint32_t wheel);
  void add_hop(std::uint32_t from, std::uint32_t to);
  void settle(std::uint32_t wheel);

  const Map* map_;
  const Corners* corners_;
  double clearance_;
  double margin_;
  std::vector<Circle> circles_;  ///< around the corners of the map, then of the moving bodies
  std::vector<Wheel> wheels_;
  std::vector<Arc> arcs_;
  std::vector<Mark> marks_;          ///< by wheel
  std::vector<std::uint32_t> seen_;  ///< by wheel: the look that saw it last
  std::uint32_t look_ = 0;
  std::uint32_t query_ = 0;
  std::size_t bytes_ = 0;
};

/// Calls `take` with the wheels of a corner that a line may reach and that have not the stamp
/// yet. `stamp_at` refers to the stamp of a wheel.
template <class FindSides, class StampAt, class Take>
void take_unseen(std::uint32_t corner, FindSides&& find_sides, StampAt&& stamp_at,
                 std::uint32_t stamp, Take&& take) {
  std::uint32_t& left = stamp_at(2 * corner);
  std::uint32_t& right = stamp_at(2 * corner + 1);
  if (left == stamp && right == stamp) return;
  const Sides sides = find_sides();
  if (sides.left && std::exchange(left, stamp) != stamp) take(2 * corner);
  if (sides.right && std::exchange(right, stamp) != stamp) take(2 * corner + 1);
}

}  // namespace microswarm::planning

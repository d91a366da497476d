// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/exact/corners.hpp"

namespace microswarm {

/// A shortest path, or why there is none.
struct ShortestPath {
  Status status = Status::no_path;
  double length = 0;         ///< of straight lines and true arcs [µm]
  std::vector<Vec2> points;  ///< [µm]; arcs are replaced by lines around them, with clearance
  std::uint64_t expanded = 0;
  std::uint64_t checks = 0;  ///< of tangents
};

/// Exact shortest paths of a disc in a map, for one clearance.
///
/// A* over the tangents between the circles around corners. The free tangents of a circle are found
/// when a search first comes to it, and kept for further queries. Not for several threads at once.
class ShortestPaths {
 public:
  /// `map` must outlive it. `clearance` [µm].
  ShortestPaths(const Map& map, std::shared_ptr<const Corners> corners, double clearance);

  /// The shortest path between two places that are free. It keeps the clearance to within a share
  /// of 1e-7 and exists if there is one with that much more clearance.
  ShortestPath find(Vec2 start, Vec2 goal, const Stop& stop = {});

 private:
  static constexpr std::uint32_t none = ~0u;

  /// A straight line from one circle to the next.
  struct Line {
    Vec2 along;         ///< unit vector
    double length = 0;  ///< [µm]
  };
  /// A free tangent of two circles, with the normals at which it leaves and arrives, counted from
  /// where the corner's cone begins [rad].
  struct Hop {
    Line line;
    double leave = 0;
    double arrive = 0;
    double best = 0;  ///< length of a path over it in the present query [µm]
    std::uint32_t query = 0;
    std::uint32_t to = none;  ///< wheel
    std::uint16_t leave_arc = 0;
    std::uint16_t arrive_arc = 0;
  };
  /// A circle around a corner, gone around counter-clockwise (even number) or clockwise.
  struct Wheel {
    std::vector<Hop> hops;             ///< as one comes by them, from where the cone begins
    std::uint32_t query = 0;           ///< of the following
    std::uint32_t first_label = none;  ///< expanded at it
  };
  /// Free part of a circle: normals from `from` to `to`.
  struct Arc {
    double from, to;
  };
  /// Circle with its cone of normals.
  struct Circle {
    Vec2 centre;
    double radius = 0;
    double from = 0;
    double width = 0;
    Vec2 first, last;  ///< normals at the ends of the cone; unused for a disc
    bool is_disc = false;
    bool is_known = false;  ///< its hops
    bool is_cut = false;    ///< into its free arcs
    std::uint16_t arcs = 0;
    std::uint32_t first_arc = 0;
  };
  /// A line that was taken.
  struct Label {
    double length = 0;  ///< of the path to its end [µm]
    Line line;
    Vec2 from;         ///< where it begins
    double leave = 0;  ///< normal at which it leaves its parent's wheel
    double arrive = 0;
    std::uint32_t wheel = none;  ///< at which it arrives
    std::uint16_t arc = 0;
    std::uint32_t parent = none;
    std::uint32_t next = none;  ///< at the same wheel
  };
  /// A line that may be taken, from the label `parent` or from the start.
  struct Open {
    double estimate;
    double length;
    std::uint32_t parent;
    std::uint32_t line;  ///< number among the wheel's hops, the lines from the start or to the goal
    bool is_end;
    bool operator<(const Open& o) const { return estimate > o.estimate; }
  };
  struct FromStart {
    Line line;
    std::uint32_t to;
  };
  struct ToGoal {
    Line line;
    double leave;
  };

  static double sense(std::uint32_t wheel) { return wheel % 2 == 0 ? 1 : -1; }
  /// Place on the wheel where a line leaves or arrives.
  Vec2 touch(std::uint32_t wheel, const Line& line) const {
    const Circle& circle = circles_[wheel / 2];
    return circle.centre - sense(wheel) * circle.radius * perpendicular(line.along);
  }
  bool is_free(Vec2 from, const Line& line) const {
    return map_.is_free(Segment{from, from + line.length * line.along}, clearance_);
  }
  void know(std::uint32_t corner);
  void join_free(std::uint32_t from, std::uint32_t to);
  void find_arcs(Circle& circle);
  int arc_at(Circle& circle, double at);
  double angle_in(const Circle& circle, Vec2 normal) const;
  static bool is_taut(const Circle& circle, Vec2 normal);
  bool join(const Circle& a, double sense_a, const Circle& b, double sense_b, Line& line) const;
  void begin();
  bool take(const Open& open, Label& label, ShortestPath& path);
  void expand(const Label& label, std::uint32_t number);
  double way_around(const Circle& circle, double sense, double from, double to) const;
  bool is_dominated(const Label& label);
  Wheel& wheel(std::uint32_t number);
  void draw(std::uint32_t last, ShortestPath& path) const;
  void draw_arc(const Circle& circle, double sense, double from, double to,
                std::vector<Vec2>& points) const;
  void push(const Open& open);

  const Map& map_;
  std::shared_ptr<const Corners> corners_;
  double clearance_;
  double margin_;
  std::vector<Circle> circles_;
  std::vector<Wheel> wheels_;
  std::vector<Arc> arcs_;
  std::vector<std::uint32_t> seen_;  ///< of each corner: the look around in which it was seen
  std::uint32_t look_ = 0;

  // Of the present query.
  std::uint32_t query_ = 0;
  Vec2 start_, goal_;
  std::vector<FromStart> starts_;
  std::vector<ToGoal> ends_;
  std::vector<Label> labels_;
  std::vector<Open> open_;
};

}  // namespace microswarm

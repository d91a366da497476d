// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/planning/exact/turning_circle.hpp"

namespace microswarm {

/// A shortest path, or why there is none and a path that ends near the goal.
struct ShortestPath {
  Status status = Status::no_path;
  double length = 0;           ///< of straight lines and true arcs, once solved [µm]
  std::vector<Vec2> points;    ///< [µm]; arcs are replaced by lines around them, with clearance
  std::uint64_t expanded = 0;  ///< circles gone around, as often as they were
  std::uint64_t lines = 0;     ///< free ones that were taken
};

/// Exact shortest paths of a disc in a map, for one clearance, also among moving bodies at their
/// present places.
///
/// A* over the tangents between the circles around corners. The tangents of a circle are found when
/// a search first comes to it, tested when their turn comes, and kept for further queries; those to
/// and from moving bodies are found anew by each query. What was kept changes no path. Not for
/// several threads at once.
class ShortestPaths {
 public:
  /// `map` must outlive it. `clearance` [µm].
  ShortestPaths(const Map& map, double clearance);

  /// The shortest path between two places that are free. It keeps the clearance to within a share
  /// of 1e-7 and exists if there is one with that much more clearance.
  ShortestPath find(Vec2 start, Vec2 goal, const BodySet& moving, const Stop& stop = {});
  ShortestPath find(Vec2 start, Vec2 goal, const Stop& stop = {}) {
    return find(start, goal, {}, stop);
  }
  /// Continues with a copy of the map.
  void use(const Map& map) { map_ = &map; }
  /// About what is kept at most [B].
  std::size_t bytes() const { return bytes_; }

 private:
  static constexpr std::uint32_t none = ~0u;

  using Line = TangentLine;

  /// Whether a tangent is free of walls.
  enum class Walls : std::uint8_t { unknown, free, blocked };

  /// A tangent of two circles, with the normals at which it leaves and arrives, counted from where
  /// the corner's cone begins [rad].
  struct Hop {
    Line line;
    double leave = 0;
    double arrive = 0;  ///< of one that is free
    double best = 0;    ///< length of a path over it in the present query [µm]
    std::uint32_t query = 0;
    std::uint32_t to = none;  ///< wheel
    std::uint16_t leave_arc = 0;
    std::uint16_t arrive_arc = 0;  ///< of one that is free
    Walls walls = Walls::unknown;
  };
  /// A line of the present query, from the start, to the goal, or to or from a moving body; not
  /// tested yet.
  struct Guess {
    Line line;
    double leave = 0;
    std::uint32_t to = none;  ///< wheel; none: the goal
  };
  /// A circle around a corner, gone around counter-clockwise (even number) or clockwise.
  struct Wheel {
    std::vector<Hop> hops;             ///< as one comes by them, from where the cone begins
    bool is_known = false;             ///< its hops
    std::uint32_t query = 0;           ///< of the following
    std::uint32_t first_label = none;  ///< expanded at it
  };
  /// Free parts of a circle, in a list of arcs.
  struct ArcRange {
    std::uint32_t first = 0;
    std::uint16_t count = 0;
    std::span<const Arc> of(const std::vector<Arc>& all) const {
      return std::span(all).subspan(first, count);
    }
  };
  /// A circle, and what is known of it.
  struct Circle : TurningCircle {
    ArcRange arcs;            ///< among the walls
    ArcRange arcs_now;        ///< among the walls and the moving bodies
    std::uint32_t query = 0;  ///< of the following
    bool is_near = false;     ///< to a moving body, so that arcs_now holds
    std::uint8_t visits = 0;  ///< by queries, until its hops are settled
    bool is_cut = false;      ///< into its free arcs
  };
  /// A line that was taken.
  struct Label {
    double length = 0;  ///< of the path to its end [µm]
    Line line;
    Vec2 from;         ///< where it begins
    double leave = 0;  ///< normal at which it leaves its parent's wheel
    double arrive = 0;
    std::uint32_t wheel = none;  ///< at which it arrives; none: the goal
    std::uint16_t arc = 0;
    std::uint32_t parent = none;
    std::uint32_t next = none;  ///< at the same wheel
  };
  /// A line that may be taken, from the label `parent` or from the start.
  struct Open {
    double estimate;
    double length;
    std::uint32_t parent;
    std::uint32_t to;    ///< wheel; none: the goal
    std::uint32_t line;  ///< number among the wheel's hops, or among the guesses
    bool is_guess;
    /// The order in which lines are taken, so that of equal paths the same one is found whatever
    /// else is open.
    bool operator<(const Open& o) const {
      if (estimate != o.estimate) return estimate > o.estimate;
      return to != o.to ? to > o.to : parent > o.parent;
    }
  };

  static double sense(std::uint32_t wheel) { return wheel % 2 == 0 ? 1 : -1; }
  /// Place on the wheel where a line leaves or arrives.
  Vec2 touch(std::uint32_t wheel, const Line& line) const {
    return circles_[wheel / 2].touch(sense(wheel), line.along);
  }
  static Segment segment(Vec2 from, const Line& line) {
    return {from, from + line.length * line.along};
  }
  static Vec2 end_of(const Label& label) { return segment(label.from, label.line).b; }
  std::uint32_t still_count() const { return static_cast<std::uint32_t>(seen_.size() / 2); }
  Circle circle_of(const Corner& corner) const;
  void know(std::uint32_t wheel);
  void add_hop(std::uint32_t from, std::uint32_t to);
  bool test(std::uint32_t from, Hop& hop);
  void settle(std::uint32_t wheel);
  ArcRange cut(const Circle& circle, const BodySet* moving, std::vector<Arc>& arcs) const;
  int still_arc_at(Circle& circle, double at);
  int arc_at(Circle& circle, double at);
  bool is_near_moving(Circle& circle);
  /// A place on a circle may lie in it by a rounding error.
  std::optional<Line> join(const TurningCircle& a, double sense_a, const TurningCircle& b,
                           double sense_b) const {
    return tangent(a, sense_a, b, sense_b, 4 * margin_);
  }
  void begin(Vec2 start, Vec2 goal, const BodySet& moving);
  void open_from_start();
  void look_from_start(double length);
  void open_from_start(std::uint32_t to);
  void expand(const Label& label, std::uint32_t number);
  void expand_hops(const Label& label, std::uint32_t number);
  void guess(const Label& label, std::uint32_t number, const TurningCircle& there,
             std::uint32_t to);
  void guess_both(const Label& label, std::uint32_t number, std::uint32_t corner);
  bool take(const Open& open, Label& label);
  bool arrive(Label& label);
  bool is_free(Segment s) const;
  bool is_dominated(const Label& label);
  Wheel& wheel(std::uint32_t number);
  std::vector<Vec2> near_goal();
  Vec2 walk(Vec2 from);
  std::vector<Vec2> draw(std::uint32_t last) const;
  void add(Vec2 p, std::vector<Vec2>& points) const;
  void draw_arc(const Circle& circle, double sense, double from, double to,
                std::vector<Vec2>& points) const;
  void push(const Open& open);

  const Map* map_;
  const Corners& corners_;
  double clearance_;
  double margin_;
  std::vector<Circle> circles_;  ///< around the corners of the map, then of the moving bodies
  std::vector<Wheel> wheels_;
  std::vector<Arc> arcs_;
  std::vector<std::uint32_t> seen_;  ///< of each wheel: the look around in which it was seen
  std::uint32_t look_ = 0;
  std::size_t bytes_ = 0;
  std::vector<std::uint32_t>
      starts_seen_;  ///< of each wheel: the query in which its start line was opened
  Trapezoids::Look from_start_;

  // Of the present query.
  std::uint32_t query_ = 0;
  Vec2 start_, goal_;
  const BodySet* moving_ = nullptr;  ///< null if there is none
  std::vector<Corner> moving_corners_;
  std::vector<Arc> arcs_now_;
  std::vector<Guess> guesses_;
  std::vector<Label> labels_;
  std::vector<Open> open_;
};

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/planning/exact/turning_circle.hpp"

namespace microswarm {

/// A* over the tangents between the circles around corners: shortest paths from a start to one
/// goal, or to many positions in turn.
///
/// The tangents of a circle are computed when a search first reaches it, tested when they are the
/// best open line, and kept for later searches, which changes no result. Tangents of moving bodies
/// are computed by each search. Not thread-safe.
class TangentSearch {
 public:
  static constexpr std::uint32_t none = ~0u;

  /// A closed line, with the shortest path to its end.
  struct Label {
    double length = 0;  ///< of the path to its end [µm]
    TangentLine line;
    Vec2 from;         ///< start of the line [µm]
    double leave = 0;  ///< angle of the normal at which it leaves the parent's wheel [rad]
    double arrive = 0;
    std::uint32_t wheel = none;  ///< wheel of its end; none: the goal
    std::uint16_t arc = 0;
    std::uint32_t parent = none;
    std::uint32_t next = none;  ///< next label of the same wheel

    Vec2 end() const { return from + line.length * line.along; }
  };
  /// A line from a label's wheel, and the length of the path to the line's end [µm].
  struct Leaving {
    TangentLine line;
    double leave = 0;  ///< angle of the normal at which it leaves [rad]
    double length = 0;
  };

  /// `map` must outlive the search. `clearance` [µm].
  TangentSearch(const Map& map, double clearance);
  /// Continues with an equal copy of the map.
  void use(const Map& map) { map_ = &map; }
  /// Approximate memory in use [B].
  std::size_t bytes() const {
    return bytes_ + labels_.capacity() * sizeof(Label) + open_.capacity() * sizeof(Open);
  }

  /// Begins a query for a path from `start` to `goal`.
  void begin(Vec2 start, Vec2 goal, const BodySet& moving);
  /// Begins a query for paths to any position, among walls alone, and opens the start's tangents.
  void begin_to_everywhere(Vec2 start);
  /// Directs the search to `position`, after begin_to_everywhere().
  void head_for(Vec2 position);
  /// Whether `s` keeps the clearance from walls and from the query's moving bodies.
  bool is_free(Segment s) const;
  /// Opens the tangents from the start, those near the line to the goal first. To be called once
  /// a query.
  void open_from_start();
  /// Lower bound of the path length over any later label [µm], including the straight line on to
  /// the goal or to the position headed for; infinity after the last label.
  double reached() const;
  /// Index of the next label, unless reached() exceeds `most` [µm]; nothing after the last one.
  std::optional<std::uint32_t> next(double most = infinity);
  /// Opens the lines that leave a label, which must not be the goal's.
  void expand(std::uint32_t label);

  std::span<const Label> labels() const { return labels_; }
  /// Index of a wheel's latest label, which links to the earlier ones; none without labels.
  std::uint32_t last_label(std::uint32_t wheel) const {
    return wheels_[wheel].query == query_ ? wheels_[wheel].first_label : none;
  }
  /// Distance of a position from a wheel's circle [µm], 0 inside.
  double distance_to(std::uint32_t wheel, Vec2 position) const {
    const Circle& circle = circles_[wheel / 2];
    return std::max(0.0, distance(circle.centre, position) - circle.radius);
  }
  /// Line from a label's wheel to a position; nothing if it cannot belong to a shortest path. It is
  /// not tested against walls.
  std::optional<Leaving> leaving(const Label& label, Vec2 position) {
    return leaving(label, {.centre = position}, 1);
  }
  const Corners& corners() const { return *corners_; }
  Vec2 start() const { return start_; }

  /// Path to the end of a label [µm]; arcs are replaced by tangent lines, which keep the clearance.
  std::vector<Vec2> path_to(std::uint32_t label) const;
  /// Extends that path along a line to a position.
  void go_on(const Label& label, const Leaving& leaving, Vec2 position,
             std::vector<Vec2>& path) const;
  /// Adds a point unless it equals the last one up to rounding.
  void add(Vec2 p, std::vector<Vec2>& path) const;

 private:
  /// Whether a tangent is free of walls.
  enum class Walls : std::uint8_t { unknown, free, blocked };

  /// A tangent of two circles, with the angles of the normals at which it leaves and arrives,
  /// measured from the start of the corner's cone [rad].
  struct Hop {
    TangentLine line;
    double leave = 0;
    double arrive = 0;  ///< if free
    double best = 0;    ///< length of a path over it in the current query [µm]
    std::uint32_t query = 0;
    std::uint32_t to = none;  ///< wheel
    std::uint16_t leave_arc = 0;
    std::uint16_t arrive_arc = 0;  ///< if free
    Walls walls = Walls::unknown;
  };
  /// An untested line of the current query: from the start, to the goal, or to or from a moving
  /// body.
  struct Guess {
    TangentLine line;
    double leave = 0;
    std::uint32_t to = none;  ///< wheel; none: the goal
  };
  /// A circle around a corner with a sense: counter-clockwise (even index) or clockwise (odd).
  struct Wheel {
    std::vector<Hop> hops;             ///< in order of `leave`
    bool is_known = false;             ///< whether its hops were computed
    std::uint32_t query = 0;           ///< for which first_label holds
    std::uint32_t first_label = none;  ///< latest expanded label
  };
  /// Free parts of a circle, as a range in a list of arcs.
  struct ArcRange {
    std::uint32_t first = 0;
    std::uint16_t count = 0;
    std::span<const Arc> of(const std::vector<Arc>& all) const {
      return std::span(all).subspan(first, count);
    }
  };
  /// A circle and its cached free arcs.
  struct Circle : TurningCircle {
    ArcRange arcs;            ///< among the walls
    ArcRange arcs_now;        ///< among the walls and the moving bodies
    std::uint32_t query = 0;  ///< for which is_near and arcs_now hold
    bool is_near = false;     ///< near a moving body, so that arcs_now applies
    std::uint8_t visits = 0;  ///< queries so far, counted until its hops are settled
    bool is_cut = false;      ///< whether `arcs` was computed
  };
  /// An open line, from the label `parent` or from the start.
  struct Open {
    double estimate;
    double length;
    std::uint32_t parent;
    std::uint32_t to;    ///< wheel; none: the goal
    std::uint32_t line;  ///< index among the wheel's hops, or among the guesses
    bool is_guess;
    /// Order of the queue. Ties are broken so that the result does not depend on the other open
    /// lines.
    bool operator<(const Open& o) const {
      if (estimate != o.estimate) return estimate > o.estimate;
      return to != o.to ? to > o.to : parent > o.parent;
    }
  };

  static double sense(std::uint32_t wheel) { return wheel % 2 == 0 ? 1 : -1; }
  /// Point of the wheel where a line leaves or arrives.
  Vec2 touch(std::uint32_t wheel, const TangentLine& line) const {
    return circles_[wheel / 2].touch(sense(wheel), line.along);
  }
  static Segment segment(Vec2 from, const TangentLine& line) {
    return {from, from + line.length * line.along};
  }
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
  /// Tangent of two circles; the margin admits a point on a circle that rounding put inside.
  std::optional<TangentLine> join(const TurningCircle& a, double sense_a, const TurningCircle& b,
                                  double sense_b) const {
    return tangent(a, sense_a, b, sense_b, 4 * margin_);
  }
  void look_from_start(double length);
  void open_from_start(std::uint32_t to);
  std::optional<Leaving> leaving(const Label& label, const TurningCircle& there,
                                 double sense_there);
  void expand_hops(const Label& label, std::uint32_t number);
  void guess(const Label& label, std::uint32_t number, const TurningCircle& there,
             std::uint32_t to);
  void guess_both(const Label& label, std::uint32_t number, std::uint32_t corner);
  bool take(const Open& open, Label& label);
  bool arrive(Label& label);
  bool is_dominated(const Label& label);
  Wheel& wheel(std::uint32_t number);
  void draw_arc(const Circle& circle, double sense, double from, double to,
                std::vector<Vec2>& points) const;
  void push(const Open& open);

  const Map* map_;
  const Corners* corners_;
  double clearance_;
  double margin_;
  std::vector<Circle> circles_;  ///< around the corners of the map, then of the moving bodies
  std::vector<Wheel> wheels_;
  std::vector<Arc> arcs_;
  std::vector<std::uint32_t> seen_;  ///< by wheel: the look that saw it last
  std::uint32_t look_ = 0;
  std::size_t bytes_ = 0;
  std::vector<std::uint32_t> starts_seen_;  ///< by wheel: the query that opened its start line
  Trapezoids::Look from_start_;

  // State of the current query.
  std::uint32_t query_ = 0;
  Vec2 start_;
  Vec2 goal_;                        ///< or the position headed for
  bool ends_there_ = true;           ///< whether goal_ is the goal
  const BodySet* moving_ = nullptr;  ///< null without moving bodies
  std::vector<Corner> moving_corners_;
  std::vector<Arc> arcs_now_;
  std::vector<Guess> guesses_;
  std::vector<Label> labels_;
  std::vector<Open> open_;
};

}  // namespace microswarm

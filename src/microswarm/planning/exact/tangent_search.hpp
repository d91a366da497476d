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

/// Shortest paths from a place over the tangents between the circles around corners, by A*: to a
/// goal, or to everywhere, then one place after the other.
///
/// The tangents of a circle are found when a search first comes to it, tested when their turn
/// comes, and kept for further searches; those to and from moving bodies are found anew by each.
/// What was kept changes no path. Not for several threads at once.
class TangentSearch {
 public:
  static constexpr std::uint32_t none = ~0u;

  /// A line that was taken, with the shortest path to its end.
  struct Label {
    double length = 0;  ///< of the path to its end [µm]
    TangentLine line;
    Vec2 from;         ///< where it begins
    double leave = 0;  ///< normal at which it leaves its parent's wheel
    double arrive = 0;
    std::uint32_t wheel = none;  ///< at which it arrives; none: the goal
    std::uint16_t arc = 0;
    std::uint32_t parent = none;
    std::uint32_t next = none;  ///< at the same wheel

    Vec2 end() const { return from + line.length * line.along; }
  };
  /// A line from a label's wheel, and the length of the path to its end [µm].
  struct Leaving {
    TangentLine line;
    double leave = 0;  ///< normal at which it leaves
    double length = 0;
  };

  /// `map` must outlive it. `clearance` [µm].
  TangentSearch(const Map& map, double clearance);
  /// Continues with a copy of the map.
  void use(const Map& map) { map_ = &map; }
  /// About what is kept at most [B].
  std::size_t bytes() const {
    return bytes_ + labels_.capacity() * sizeof(Label) + open_.capacity() * sizeof(Open);
  }

  /// Takes in a query: paths from `start` to `goal`.
  void begin(Vec2 start, Vec2 goal, const BodySet& moving);
  /// The same to everywhere, among walls alone, and opens the tangents from the start.
  void begin_to_everywhere(Vec2 start);
  /// From now on, lines towards this place come first. For paths to everywhere.
  void head_for(Vec2 place);
  /// Whether the clearance is kept, to the moving bodies of the query too.
  bool is_free(Segment s) const;
  /// Opens the tangents from the start, those to what is near the way to the goal first. To be
  /// called once a query.
  void open_from_start();
  /// Length that no label to come falls short of, with the straight line on to the goal or to the
  /// place headed for [µm]; infinite after the last one.
  double reached() const;
  /// Number of the next label if `most` [µm] is not reached yet; nothing after the last one.
  std::optional<std::uint32_t> next(double most = infinity);
  /// Opens the lines that lead on from a label that is not the goal's.
  void expand(std::uint32_t label);

  std::span<const Label> labels() const { return labels_; }
  /// Number of the latest label at a wheel, those before it are linked; none if there is none.
  std::uint32_t last_label(std::uint32_t wheel) const {
    return wheels_[wheel].query == query_ ? wheels_[wheel].first_label : none;
  }
  /// Distance of a place from a wheel [µm], 0 in it.
  double distance_to(std::uint32_t wheel, Vec2 place) const {
    const Circle& circle = circles_[wheel / 2];
    return std::max(0.0, distance(circle.centre, place) - circle.radius);
  }
  /// The line on from a label's wheel to a place; nothing if no shortest path leads so. Whether it
  /// is free of walls is not tested.
  std::optional<Leaving> leaving(const Label& label, Vec2 place) {
    return leaving(label, {.centre = place}, 1);
  }
  const Corners& corners() const { return *corners_; }
  Vec2 start() const { return start_; }

  /// The path to the end of a label [µm]; arcs are replaced by lines around them, with clearance.
  std::vector<Vec2> path_to(std::uint32_t label) const;
  /// Adds to that path how it goes on along a line to a place.
  void go_on(const Label& label, const Leaving& leaving, Vec2 place, std::vector<Vec2>& path) const;
  /// Adds a point unless it is the last one but for rounding.
  void add(Vec2 p, std::vector<Vec2>& path) const;

 private:
  /// Whether a tangent is free of walls.
  enum class Walls : std::uint8_t { unknown, free, blocked };

  /// A tangent of two circles, with the normals at which it leaves and arrives, counted from where
  /// the corner's cone begins [rad].
  struct Hop {
    TangentLine line;
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
    TangentLine line;
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
  /// A place on a circle may lie in it by a rounding error.
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
  std::vector<std::uint32_t> seen_;  ///< of each wheel: the look around in which it was seen
  std::uint32_t look_ = 0;
  std::size_t bytes_ = 0;
  std::vector<std::uint32_t>
      starts_seen_;  ///< of each wheel: the query in which its start line was opened
  Trapezoids::Look from_start_;

  // Of the present query.
  std::uint32_t query_ = 0;
  Vec2 start_;
  Vec2 goal_;                        ///< or the place headed for
  bool ends_there_ = true;           ///< whether it is the goal
  const BodySet* moving_ = nullptr;  ///< null if there is none
  std::vector<Corner> moving_corners_;
  std::vector<Arc> arcs_now_;
  std::vector<Guess> guesses_;
  std::vector<Label> labels_;
  std::vector<Open> open_;
};

}  // namespace microswarm

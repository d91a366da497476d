// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/planning/exact/tangent_graph.hpp"

namespace microswarm::planning {

/// One search by A* over the tangents of a graph: shortest paths from a start to one goal, or to
/// many positions in turn. Tangents of moving bodies are computed by each query. A graph serves one
/// query at a time, and must outlive it.
class TangentQuery {
 public:
  static constexpr std::uint32_t none = TangentGraph::none;

  /// A closed line, with the shortest path to its end.
  struct Label {
    double length = 0;  ///< of the path to its end [µm]
    TangentLine line{};
    Vec2 from{};       ///< start of the line [µm]
    double leave = 0;  ///< angle of the normal at which it leaves the parent's wheel [rad]
    double arrive = 0;
    std::uint32_t wheel = none;  ///< wheel of its end; none: the goal
    std::uint16_t arc = 0;
    std::uint32_t parent = none;
    std::uint32_t next = none;  ///< next label of the same wheel

    Vec2 end() const { return line.from(from).b; }
  };
  /// A line from a label's wheel, and the length of the path to the line's end [µm].
  struct Leaving {
    TangentLine line{};
    double leave = 0;  ///< angle of the normal at which it leaves [rad]
    double length = 0;
  };

  struct Memory;

  /// A query for a path from `start` to `goal`, with the tangents from the start open, those near
  /// the line to the goal first. `moving` must outlive it. `memory` is that of an earlier query.
  TangentQuery(TangentGraph& graph, Vec2 start, Vec2 goal, const BodySet& moving, Memory memory);
  /// A query for paths to any position, among walls alone.
  TangentQuery(TangentGraph& graph, Vec2 start);

  /// Directs a search for any position to this one.
  void head_for(Vec2 position);
  /// Whether `s` keeps the clearance from walls and from the moving bodies.
  bool is_free(Segment s) const;
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
    const TangentGraph::Mark& mark = graph_->marks()[wheel];
    return mark.query == query_ ? mark.last_label : none;
  }
  /// Distance of a position from a wheel's circle [µm], 0 inside.
  double distance_to(std::uint32_t wheel, Vec2 position) const {
    const TurningCircle& circle = graph_->wheel_circle(wheel);
    return std::max(0.0, distance(circle.centre, position) - circle.radius);
  }
  /// Line from a label's wheel to a position; nothing if it cannot belong to a shortest path. It is
  /// not tested against walls.
  std::optional<Leaving> leaving(const Label& label, Vec2 position) {
    return leaving(label, {.centre = position}, 1);
  }
  Vec2 start() const { return start_; }
  /// Approximate memory in use [B], without the graph.
  std::size_t bytes() const {
    return labels_.capacity() * sizeof(Label) + open_.capacity() * sizeof(Open);
  }
  /// Its memory for the next query. This one ends.
  Memory release();

  /// Path to the end of a label [µm]; arcs are replaced by tangent lines, which keep the clearance.
  std::vector<Vec2> path_to(std::uint32_t label) const;
  /// Extends that path along a line to a position.
  void go_on(const Label& label, const Leaving& leaving, Vec2 position,
             std::vector<Vec2>& path) const;
  /// Adds a point unless it equals the last one up to rounding.
  void add(Vec2 p, std::vector<Vec2>& path) const;

 private:
  using Hop = TangentGraph::Hop;

  /// An untested line of the query: from the start, to the goal, or to or from a moving body.
  struct Guess {
    TangentLine line;
    double leave = 0;
    std::uint32_t to = none;  ///< wheel; none: the goal
  };
  /// A circle among the moving bodies.
  struct CircleNow {
    TangentGraph::ArcRange arcs;  ///< free of walls and bodies, if near
    bool is_known = false;
    bool is_near = false;  ///< near a moving body, so that `arcs` applies
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

  TangentQuery(TangentGraph& graph, Vec2 start, Vec2 goal, bool ends_there, const BodySet* moving,
               Memory memory);
  int arc_at(std::uint32_t circle, double angle);
  bool is_near_moving(std::uint32_t circle);
  void look_from_start(double length);
  void open_from_start(std::uint32_t to);
  std::optional<Leaving> leaving(const Label& label, const TurningCircle& there,
                                 double sense_there);
  void expand_hops(const Label& label, std::uint32_t number);
  void guess(const Label& label, std::uint32_t number, const TurningCircle& there,
             std::uint32_t to);
  void guess_both(const Label& label, std::uint32_t number, std::uint32_t circle);
  bool take(const Open& open, Label& label);
  bool arrive(Label& label);
  bool is_dominated(const Label& label) const;
  void draw_arc(const Label& label, double to, std::vector<Vec2>& points) const;
  void push(const Open& open);

  TangentGraph* graph_;
  std::uint32_t query_;  ///< number of the query, for its marks in the graph
  Vec2 start_;
  Vec2 goal_;              ///< or the position headed for
  bool ends_there_;        ///< whether goal_ is the goal
  const BodySet* moving_;  ///< null without moving bodies
  TrapezoidLook from_start_;
  std::vector<CircleNow> circles_now_;  ///< with moving bodies, by circle
  std::vector<Arc> arcs_now_;
  std::vector<Guess> guesses_;
  std::vector<Label> labels_;
  std::vector<Open> open_;
};

/// Memory that an ended query hands to the next one, which then allocates little.
struct TangentQuery::Memory {
  TrapezoidLook from_start{};
  std::vector<CircleNow> circles_now{};
  std::vector<Arc> arcs_now{};
  std::vector<Guess> guesses{};
  std::vector<Label> labels{};
  std::vector<Open> open{};

  /// Approximate size [B].
  std::size_t bytes() const {
    return circles_now.capacity() * sizeof(CircleNow) + arcs_now.capacity() * sizeof(Arc) +
           guesses.capacity() * sizeof(Guess) + labels.capacity() * sizeof(Label) +
           open.capacity() * sizeof(Open);
  }
};

}  // namespace microswarm::planning

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/record_layout.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/planning/common/detection.hpp"

namespace microswarm {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::string key_of(std::string_view name, Unit unit) {
  std::string key(name);
  if (unit != Unit::none) key.append("_").append(unit_suffix(unit));
  return key;
}

/// A quantity that every row has; `field(row)` is the number itself.
template <class Row, class FieldOf>
Column<Row> column(std::string_view name, Unit unit, std::string_view doc, FieldOf field) {
  using T = std::remove_cvref_t<decltype(field(std::declval<Row&>()))>;
  return {.key = key_of(name, unit),
          .unit = unit,
          .doc = doc,
          .kind = std::is_floating_point_v<T> ? ColumnKind::real : ColumnKind::integer,
          .number = [field](const Row& row) { return static_cast<double>(field(row)); },
          .set_number = [field](Row& row, double v) { field(row) = static_cast<T>(v); },
          .max = std::min(9007199254740992.0, static_cast<double>(std::numeric_limits<T>::max())),
          .word = {},
          .set_word = {}};
}

/// A quantity of something that a row may lack; `optional(row)` is the optional, `field(*optional)`
/// the number.
template <class Row, class OptionalOf, class FieldOf>
Column<Row> column(std::string_view name, Unit unit, std::string_view doc, OptionalOf optional,
                   FieldOf field) {
  return {
      .key = key_of(name, unit),
      .unit = unit,
      .doc = doc,
      .kind = ColumnKind::real,
      .number =
          [=](const Row& row) { return optional(row) ? double{field(*optional(row))} : no_value; },
      .set_number =
          [=](Row& row, double v) {
            if (std::isnan(v)) return;
            if (!optional(row)) optional(row).emplace();
            field(*optional(row)) = v;
          },
      .max = 0,
      .word = {},
      .set_word = {}};
}

template <class Row>
Column<Row> word_column(std::string_view name, std::string_view doc,
                        std::function<std::string(const Row&)> word,
                        std::function<bool(Row&, const std::string&)> set_word) {
  return {.key = std::string(name),
          .unit = Unit::none,
          .doc = doc,
          .kind = ColumnKind::word,
          .number = {},
          .set_number = {},
          .max = 0,
          .word = std::move(word),
          .set_word = std::move(set_word)};
}

bool set_status(Status& status, const std::string& word) {
  for (int i = 0; i <= static_cast<int>(Status::fault); ++i) {
    status = static_cast<Status>(i);
    if (to_string(status) == word) return true;
  }
  return false;
}

}  // namespace

std::vector<Column<Frame>> columns_of(const Frame*) {
  const auto observed = [](auto& f) -> auto& { return f.observed; };
  const auto target = [](auto& f) -> auto& { return f.target; };
  return {
      column<Frame>(
          "t", Unit::s, "When the tick begins.", [](auto& f) -> auto& { return f.t; }),
      column<Frame>(
          "x", Unit::um, "Where the swarm's centre is at t.",
          [](auto& f) -> auto& { return f.pose.position.x; }),
      column<Frame>(
          "y", Unit::um, "Where the swarm's centre is at t.",
          [](auto& f) -> auto& { return f.pose.position.y; }),
      column<Frame>(
          "heading", Unit::rad, "The swarm's heading at t.",
          [](auto& f) -> auto& { return f.pose.heading; }),
      column<Frame>(
          "radius", Unit::um, "The swarm's radius at t; of robots 0.",
          [](auto& f) -> auto& { return f.radius; }),
      column<Frame>(
          "speed", Unit::um_per_s, "The swarm's speed at t.",
          [](auto& f) -> auto& { return f.speed; }),
      column<Frame>(
          "seen", Unit::s, "When the camera frame that the navigator got was taken.",
          [](auto& f) -> auto& { return f.seen; }),
      column<Frame>(
          "observed_x", Unit::um, "The swarm's centre in that camera frame.", observed,
          [](auto& p) -> auto& { return p.position.x; }),
      column<Frame>(
          "observed_y", Unit::um, "The swarm's centre in that camera frame.", observed,
          [](auto& p) -> auto& { return p.position.y; }),
      column<Frame>(
          "observed_heading", Unit::rad, "The swarm's heading in that camera frame.", observed,
          [](auto& p) -> auto& { return p.heading; }),
      column<Frame>(
          "command_heading", Unit::rad, "The heading that the navigator commanded.",
          [](auto& f) -> auto& { return f.command.heading; }),
      column<Frame>(
          "command_speed", Unit::um_per_s, "The speed it commanded; 0 is hold.",
          [](auto& f) -> auto& { return f.command.speed; }),
      column<Frame>(
          "goal_distance", Unit::um, "What is left to the goal; of robots as in the metrics.",
          [](auto& f) -> auto& { return f.goal_distance; }),
      column<Frame>(
          "wall_clearance", Unit::um,
          "From the centre at t to walls and border; infinite for robots.",
          [](auto& f) -> auto& { return f.wall_clearance; }),
      column<Frame>(
          "obstacle_clearance", Unit::um,
          "From the centre at t to moving bodies; infinite without any.",
          [](auto& f) -> auto& { return f.obstacle_clearance; }),
      column<Frame>(
          "avoidance_cost", Unit::none, "Avoidance cost δ at t, Eq 4 [radar].",
          [](auto& f) -> auto& { return f.avoidance_cost; }),
      column<Frame>(
          "target_x", Unit::um, "The navigator's local target.", target,
          [](auto& p) -> auto& { return p.x; }),
      column<Frame>(
          "target_y", Unit::um, "The navigator's local target.", target,
          [](auto& p) -> auto& { return p.y; }),
      word_column<Frame>(
          "state", "What the navigator does, in one word; end in the last frame.",
          [](const Frame& f) { return std::string(enum_name(f.state)); },
          [](Frame& f, const std::string& word) {
            const auto state = enum_value<NavigatorState>(word);
            if (state) f.state = *state;
            return state.has_value();
          }),
      column<Frame>(
          "planned", Unit::none, "1 for a planning event, else 0.",
          [](auto& f) -> auto& { return f.planned; }),
  };
}

std::vector<Column<PathChange>> columns_of(const PathChange*) {
  return {column<PathChange>(
      "t", Unit::s, "When the navigator began to follow it.",
      [](auto& p) -> auto& { return p.t; })};
}

std::vector<Column<RobotMoment>> columns_of(const RobotMoment*) {
  return {column<RobotMoment>(
      "t", Unit::s, "When the robots were there; of a long run only some of the frames.",
      [](auto& m) -> auto& { return m.t; })};
}

std::vector<Column<PlanEvent>> columns_of(const PlanEvent*) {
  return {
      column<PlanEvent>(
          "t", Unit::s, "When it planned.", [](auto& p) -> auto& { return p.t; }),
      word_column<PlanEvent>(
          "status", "What the planner came to.",
          [](const PlanEvent& p) { return std::string(to_string(p.plan.status)); },
          [](PlanEvent& p, const std::string& word) { return set_status(p.plan.status, word); }),
      column<PlanEvent>(
          "iterations", Unit::none, "Iterations of the planner.",
          [](auto& p) -> auto& { return p.plan.counts.iterations; }),
      column<PlanEvent>(
          "samples", Unit::none, "Samples it drew.",
          [](auto& p) -> auto& { return p.plan.counts.samples; }),
      column<PlanEvent>(
          "edge_checks", Unit::none, "Edges it checked.",
          [](auto& p) -> auto& { return p.plan.counts.edge_checks; }),
  };
}

std::vector<Column<RunEvent>> columns_of(const RunEvent*) {
  return {
      column<RunEvent>(
          "t", Unit::s, "When it happened, between the ticks too.",
          [](auto& e) -> auto& { return e.t; }),
      word_column<RunEvent>(
          "kind", "What happened.",
          [](const RunEvent& e) { return std::string(enum_name(e.kind)); },
          [](RunEvent& e, const std::string& word) {
            const auto kind = enum_value<EventKind>(word);
            if (kind) e.kind = *kind;
            return kind.has_value();
          }),
      column<RunEvent>(
          "x", Unit::um, "Where the swarm's centre was.",
          [](auto& e) -> auto& { return e.position.x; }),
      column<RunEvent>(
          "y", Unit::um, "Where the swarm's centre was.",
          [](auto& e) -> auto& { return e.position.y; }),
      column<RunEvent>(
          "clearance", Unit::um, "From the centre, of a contact.",
          [](auto& e) -> auto& { return e.clearance; }),
      column<RunEvent>(
          "speed", Unit::um_per_s, "The swarm's speed then.",
          [](auto& e) -> auto& { return e.speed; }),
      column<RunEvent>(
          "body", Unit::none, "Wall piece or obstacle that was touched; 4294967295 is the border.",
          [](auto& e) -> auto& { return e.body; }),
  };
}

std::vector<Column<Vec2>> columns_of(const Vec2*) {
  return {
      column<Vec2>(
          "x", Unit::um, "Position to the right.", [](auto& p) -> auto& { return p.x; }),
      column<Vec2>(
          "y", Unit::um, "Position upwards.", [](auto& p) -> auto& { return p.y; }),
  };
}

std::vector<Column<TreeNode>> columns_of(const TreeNode*) {
  return {
      column<TreeNode>(
          "x", Unit::um, "Position to the right.", [](auto& n) -> auto& { return n.position.x; }),
      column<TreeNode>(
          "y", Unit::um, "Position upwards.", [](auto& n) -> auto& { return n.position.y; }),
      column<TreeNode>(
          "heading", Unit::rad, "Of the edge from its parent.",
          [](auto& n) -> auto& { return n.heading; }),
      column<TreeNode>(
          "cost", Unit::none, "From the root, in the planner's own measure.",
          [](auto& n) -> auto& { return n.cost; }),
      column<TreeNode>(
          "parent", Unit::none, "Index in its own tree, from 0; the root's is 0.",
          [](auto& n) -> auto& { return n.parent; }),
  };
}

std::vector<Column<Detection>> columns_of(const Detection*) {
  return {
      column<Detection>(
          "x", Unit::um, "Centre of the detection circle.",
          [](auto& d) -> auto& { return d.circle.centre.x; }),
      column<Detection>(
          "y", Unit::um, "Centre of the detection circle.",
          [](auto& d) -> auto& { return d.circle.centre.y; }),
      column<Detection>(
          "radius", Unit::um, "Radius of the detection circle.",
          [](auto& d) -> auto& { return d.circle.radius; }),
      column<Detection>(
          "w1", Unit::none, "Density, Eq 1 [drrt].", [](auto& d) -> auto& { return d.w1; }),
      column<Detection>(
          "w2", Unit::none, "Distribution, Eq 2 [drrt].", [](auto& d) -> auto& { return d.w2; }),
      column<Detection>(
          "rho", Unit::none, "Dynamic adjust factor, Eq 3 [drrt].",
          [](auto& d) -> auto& { return d.rho; }),
  };
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "lab/stream/stream.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "microswarm/config/json_value.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/experiment/session/running_experiment.hpp"

namespace microswarm::lab {
namespace {

using Json = nlohmann::json;
static_assert(std::endian::native == std::endian::little);

/// Numbers as a byte string.
template <class T>
class Numbers {
 public:
  void add(T value) {
    const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void add(Vec2 p) {
    add(static_cast<T>(p.x));
    add(static_cast<T>(p.y));
  }
  Json take() { return Json::binary(std::move(bytes_)); }

 private:
  std::vector<std::uint8_t> bytes_;
};
using Floats = Numbers<float>;
using Indices = Numbers<std::uint32_t>;

Json points(std::span<const Vec2> list) {
  Floats floats;
  for (const Vec2 p : list) floats.add(p);
  return floats.take();
}

Json point(Vec2 p) { return {p.x, p.y}; }

Json polygon(const Polygon& shape) {
  Json holes = Json::array();
  for (const auto& hole : shape.holes) holes.push_back(points(hole));
  return {{"outer", points(shape.outer)}, {"holes", std::move(holes)}};
}

/// Discs as x, y, radius and number, and polygons.
Json bodies(std::span<const Body> list) {
  Floats discs;
  Json polygons = Json::array();
  for (const Body& body : list)
    std::visit(Overloaded{[&](const Disc& disc) {
                            discs.add(disc.centre);
                            discs.add(static_cast<float>(disc.radius));
                            discs.add(static_cast<float>(body.obstacle));
                          },
                          [&](const Polygon& shape) {
                            Json one = polygon(shape);
                            one["number"] = body.obstacle;
                            polygons.push_back(std::move(one));
                          }},
               body.shape);
  return {{"discs", discs.take()}, {"polygons", std::move(polygons)}};
}

/// Quotes a word for a POSIX shell.
std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./=,:+@%").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

Json radar(const RadarDiagnostics& scan) {
  Floats beams;
  Numbers<std::int32_t> screens;
  for (const RadarBeam& beam : scan.beams) {
    screens.add(beam.obstacle ? static_cast<std::int32_t>(*beam.obstacle) : -1);
    beams.add(static_cast<float>(beam.heading));
    beams.add(static_cast<float>(beam.fate));
    beams.add(static_cast<float>(beam.score));
  }
  Json json{{"centre", point(scan.centre)},
            {"radius", scan.radius},
            {"prediction", scan.circles.prediction},
            {"safety", scan.circles.safety},
            {"detection", scan.circles.detection},
            {"step", scan.step},
            {"beams", beams.take()},
            {"screens", screens.take()}};
  if (scan.best) json["best"] = *scan.best;
  if (scan.straight) json["straight"] = *scan.straight;
  return json;
}

/// Bodies as body, time, x, y, radius, uncertainty, turn and growth, corners as body, x and y.
Json predicted(const PredictiveDiagnostics& ahead) {
  Floats bodies;
  for (const PredictedMoment& body : ahead.bodies) {
    bodies.add(static_cast<float>(body.body));
    bodies.add(static_cast<float>(body.t));
    bodies.add(body.centre);
    bodies.add(static_cast<float>(body.radius));
    bodies.add(static_cast<float>(body.uncertainty));
    bodies.add(static_cast<float>(body.turn));
    bodies.add(static_cast<float>(body.growth));
  }
  Floats corners;
  for (const PredictedCorner& corner : ahead.corners) {
    corners.add(static_cast<float>(corner.body));
    corners.add(corner.offset);
  }
  return {{"effect", ahead.effect},
          {"radius", ahead.radius},
          {"bodies", bodies.take()},
          {"corners", corners.take()}};
}

/// State of an aggregation; its tree is in `aggregation_message`.
Json gathering(const AggregationDiagnostics& plan) {
  Json json{{"mean_distance", plan.mean_distance}, {"livelock", plan.is_livelock}};
  if (plan.leader) json["leader"] = *plan.leader;
  if (plan.team_region) json["region"] = *plan.team_region;
  if (plan.team_branch) json["branch"] = *plan.team_branch;
  if (plan.moves_left) json["moves_left"] = *plan.moves_left;
  return json;
}

Json hierarchical(const HierarchicalDiagnostics& decision) {
  Json json{{"towards", point(decision.towards)},
            {"path_clearance", decision.path_clearance},
            {"in_time", decision.in_time},
            {"is_led", decision.is_led}};
  if (decision.wait_at) json["wait"] = point(*decision.wait_at);
  if (decision.wait_since) json["wait_since"] = *decision.wait_since;
  return json;
}

void add(Json& json, const Diagnostics& diagnostics) {
  std::visit(
      Overloaded{
          [](std::monostate) {}, [&](const RadarDiagnostics& of) { json["radar"] = radar(of); },
          [&](const AggregationDiagnostics& of) { json["gathering"] = gathering(of); },
          [&](const PredictiveDiagnostics& of) { json["predicted"] = predicted(of); },
          [&](const HierarchicalDiagnostics& of) { json["hierarchical"] = hierarchical(of); }},
      diagnostics);
}

Json event(const experiment::RunEvent& happened) { return to_json_value(happened); }

std::string_view word(experiment::OperatingMode mode) {
  switch (mode) {
    case experiment::OperatingMode::autonomous:
      return "autonomous";
    case experiment::OperatingMode::manual:
      return "manual";
    case experiment::OperatingMode::paused:
      return "hold";
  }
  return {};
}

}  // namespace

MessagePtr make_message(const Json& json, Message::Kind kind) {
  auto made = std::make_shared<Message>();
  Json::to_cbor(json, made->bytes);
  made->kind = kind;
  return made;
}

Row to_row(const experiment::Tick& tick) {
  const experiment::Frame& frame = tick.frame;
  return {.t = frame.t,
          .position = frame.pose.position,
          .clearance = std::min(frame.wall_clearance, frame.obstacle_clearance),
          .cost = frame.avoidance_cost,
          .goal_distance = frame.goal_distance,
          .step_time = tick.step_time,
          .speed = frame.command.speed,
          .state = frame.state,
          .planned = frame.planned};
}

std::string command_line(const Source& source, bool is_record) {
  std::string command = is_record     ? "microswarm replay"
                        : source.live ? "microswarm rig run"
                                      : "microswarm run";
  const auto add = [&](const std::string& text) { command += " " + shell_word(text); };
  const auto add_all = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) add(option), add(value);
  };
  add(source.file);
  if (!source.rig.empty()) add("--rig"), add(source.rig);
  add_all("--set", source.settings);
  add_all("--set-rig", source.rig_settings);
  return command;
}

Json hello_json(const experiment::Session& session, const Source& source) {
  const experiment::Scenario& scenario =
      session.is_playback() ? session.record().scene.scenario : session.scenario();
  const Map& map = session.map();
  Json states = Json::array();
  for (const auto& [state, word] : enum_names(NavigatorState{})) states.push_back(word);
  Json photo;
  if (source.photo)
    photo = {{"file", source.photo->file.string()}, {"um_per_px", source.photo->um_per_px}};
  return {{"type", "hello"},
          {"name", source.file},
          {"command", command_line(source, session.is_playback())},
          {"settings", source.settings},
          {"rig", source.rig},
          {"live", source.live},
          {"photo", std::move(photo)},
          {"playback", session.is_playback()},
          {"scenario", to_json_value(scenario)},
          {"changeable", experiment::changeable_keys()},
          {"states", std::move(states)},
          {"map",
           {{"lo", point(map.bounds().lo)},
            {"hi", point(map.bounds().hi)},
            {"walls", bodies(map.walls().bodies())}}}};
}

MessagePtr hello_message(const experiment::Session& session, const Source& source) {
  return make_message(hello_json(session, source), Message::Kind::hello);
}

MessagePtr scenario_message(const experiment::Scenario& scenario) {
  return make_message({{"type", "scenario"}, {"scenario", to_json_value(scenario)}});
}

MessagePtr frame_message(const experiment::SessionView& view, const Diagnostics& diagnostics) {
  Json json{{"type", "frame"},
            {"number", view.number},
            {"frame", to_json_value(view.frame)},
            {"holding", view.holding},
            {"bodies", bodies(view.bodies)},
            {"robots", points(view.robots)},
            {"path", points(view.path)},
            {"plans", view.plans}};
  if (view.target) json["target"] = point(*view.target);
  add(json, diagnostics);
  return make_message(json, Message::Kind::frame);
}

MessagePtr plan_message(const experiment::SessionView& view) {
  Floats nodes;
  Indices parents;
  for (const TreeNode& node : view.tree) {
    nodes.add(node.position);
    parents.add(node.parent);
  }
  Floats circles;
  for (const Detection& found : view.detections) {
    circles.add(found.circle.centre);
    circles.add(static_cast<float>(found.circle.radius));
  }
  return make_message({{"type", "plan"},
                       {"plans", view.plans},
                       {"nodes", nodes.take()},
                       {"parents", parents.take()},
                       {"detections", circles.take()}});
}

MessagePtr aggregation_message(const AggregationDiagnostics& plan) {
  Floats nodes;
  Indices next, numbers, branches;
  for (const AggregationNode& node : plan.nodes) {
    nodes.add(node.position);
    next.add(node.next);
    numbers.add(node.region);
    branches.add(node.branch);
  }
  Json regions = Json::array();
  for (const Region& region : plan.regions)
    regions.push_back({{"junction", point(region.junction)},
                       {"gate", region.gate},
                       {"next", region.next},
                       {"branches", region.branches}});
  return make_message({{"type", "aggregation"},
                       {"nodes", nodes.take()},
                       {"next", next.take()},
                       {"region", numbers.take()},
                       {"branch", branches.take()},
                       {"regions", std::move(regions)}});
}

MessagePtr clearance_message(const Map& map, double max_cells) {
  const Box& box = map.bounds();
  double cell = std::sqrt(box.width() * box.height() / max_cells);
  const auto count = [&cell](double length) { return std::ceil(length / cell); };
  while (count(box.width()) * count(box.height()) > max_cells) cell *= 1.01;
  const auto columns = static_cast<int>(count(box.width()));
  const auto rows = static_cast<int>(count(box.height()));
  Floats values;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      values.add(static_cast<float>(
          map.clearance(box.lo + Vec2{(column + 0.5) * cell, (row + 0.5) * cell})));
  return make_message({{"type", "clearance"},
                       {"lo", point(box.lo)},
                       {"cell", cell},
                       {"columns", columns},
                       {"rows", rows},
                       {"values", values.take()}});
}

MessagePtr rows_message(std::span<const Row> rows, std::span<const experiment::RunEvent> events,
                        bool anew) {
  Numbers<double> numbers;
  for (const Row& row : rows)
    for (const double value : {row.t, row.position.x, row.position.y, row.clearance, row.cost,
                               row.goal_distance, row.step_time, row.speed,
                               static_cast<double>(row.state), static_cast<double>(row.planned)})
      numbers.add(value);
  Json list = Json::array();
  for (const experiment::RunEvent& happened : events) list.push_back(event(happened));
  return make_message({{"type", "rows"},
                       {"anew", anew},
                       {"columns",
                        {"t_s", "x_um", "y_um", "clearance_um", "avoidance_cost",
                         "goal_distance_um", "step_time_s", "speed_um_per_s", "state", "planned"}},
                       {"rows", numbers.take()},
                       {"events", std::move(list)}});
}

MessagePtr standing_message(const Standing& standing, const experiment::RunResult& result) {
  return make_message({{"type", "standing"},
                       {"plays", standing.plays},
                       {"speed", standing.speed},
                       {"looks_back", standing.looks_back},
                       {"frame", standing.frame},
                       {"frames", standing.frames},
                       {"ended", standing.ended},
                       {"growing", standing.growing},
                       {"mode", word(standing.mode)},
                       {"steered", standing.steered},
                       {"changes", standing.changes},
                       {"status", to_string(result.status)},
                       {"state", result.state},
                       {"metrics", to_json_value(standing.past_metrics.value_or(result.metrics))},
                       {"decisions_every", standing.decisions_every},
                       {"trouble", standing.trouble}},
                      Message::Kind::standing);
}

MessagePtr answer_message(std::uint64_t id, const Issues& issues) {
  Json list = Json::array();
  for (const Issue& issue : issues)
    list.push_back({{"keys", issue.keys},
                    {"place", issue.location},
                    {"text", issue.text},
                    {"value", issue.value},
                    {"limit", issue.limit}});
  return make_message({{"type", "answer"}, {"id", id}, {"issues", std::move(list)}},
                      Message::Kind::answer);
}

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "microswarm/config/type.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/queries/path_query.hpp"
#include "microswarm/planning/path/planner_params.hpp"
#include "microswarm/report/run_picture.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct PlanOptions {
  MapInput map;
  std::string start;
  std::string goal;
  std::vector<std::string> settings;
  std::string picture;
  std::uint64_t seed = 1;
  bool json = false;
};

void draw(const PlanOptions& o, const Snapshot& world, const experiment::PathQuery& query,
          const experiment::PathAnswer& answer) {
  const Plan& plan = answer.plan;
  report::draw_plan(world.map(), plan, query.start.position,
                    {query.goal, experiment::path_limits(answer.planner).goal_tolerance},
                    fmt::format("{}: {}", o.map.file, to_string(plan.status)))
      ->write(o.picture);
}

void show(const experiment::PathAnswer& answer, double start_heading, const Notes& notes,
          bool json) {
  const Plan& made = answer.plan;
  const double length = path_length(made);
  const double turning = path_turning(made.path, start_heading);
  const double ms = 1e3 * answer.seconds;
  if (json) {
    Json path = Json::array();
    for (const Vec2 p : made.path) path.push_back({p.x, p.y});
    print("{}\n", Json{{"status", to_string(made.status)},
                       {"length_um", length},
                       {"turning_rad", turning},
                       {"time_s", answer.seconds},
                       {"iterations", made.counts.iterations},
                       {"nodes", made.tree.size()},
                       {"planner", Json::parse(experiment::planner_json(answer.planner))},
                       {"path_um", path},
                       {"notes", notes},
                       {"turning_deg", degrees(turning)},  // names of 0.2.0, for one more release
                       {"time_ms", ms}}
                      .dump(2));
    return;
  }
  print("{} of {:.1f} µm in {} points, turns {:.0f}° in all; {} iterations, {} nodes, {:.2f} ms\n",
        made.status == Status::solved
            ? "path"
            : fmt::format("no path ({}), only the beginning of one,", answer.why_none()),
        length, made.path.size(), degrees(turning), made.counts.iterations, made.tree.size(), ms);
  if (!made.path.empty()) print("x_um,y_um\n");
  for (const Vec2 p : made.path) print("{:.3f},{:.3f}\n", p.x, p.y);
}

int plan_command(const PlanOptions& o, const Context& context) {
  keep_input(o.picture, o.map.file);
  const std::vector<double> from = numbers(o.start);
  const std::vector<double> to = numbers(o.goal);
  const experiment::PathQuery query{
      .start = {{from[0], from[1]}, from.size() > 2 ? radians(from[2]) : 0.0},
      .goal = {to[0], to[1]},
      .settings = {other_settings(o.settings), "--set"},
      .seed = o.seed};
  const formats::LoadedMap map = load_map(o.map, o.settings);
  const Snapshot world(map.map);
  const experiment::PathAnswer made = answer(world, query, o.map.file, context.stop);
  note_each(made.notes);
  Notes notes = map.notes;
  notes.insert(notes.end(), made.notes.begin(), made.notes.end());
  if (!o.picture.empty()) draw(o, world, query, made);
  show(made, query.start.heading, notes, o.json);
  if (!o.json && !o.picture.empty()) print("wrote {}\n", o.picture);
  return made.plan.status == Status::solved ? ok : not_reached;
}

}  // namespace

void add_plan(Command app, Action& action) {
  auto o = std::make_shared<PlanOptions>();
  Command cmd = app.add_command(
      "plan",
      fmt::format("Plan a path on a map, the shortest one by default. Planners: {}. What is not "
                  "set follows from the map",
                  fmt::join(type_of<planning::PlannerParams>().words, ", "))
          .c_str(),
      "plan scenarios/maps/retina.geojson --start 2323,3816,-70 --goal 3499,2838 \\\n"
      "      --set planner.type=a_star --set planner.clearance_um=14 --picture path.svg");
  add_map_input(cmd, o->map);
  cmd.add_option("--start", o->start,
                 "Start position in µm and optional heading in degrees; y points up")
      .required()
      .type_name("X,Y[,HEADING]")
      .check(place(3, "x,y or x,y,heading in µm and degrees"));
  cmd.add_option("--goal", o->goal, "Goal position in µm")
      .required()
      .type_name("X,Y")
      .check(place(2, "x,y in µm"));
  add_settings(cmd, o->settings, "Set values of planner and map, e.g. map.free=dark",
               type_of<MapAndPlanner<planning::PlannerParams>>);
  cmd.add_option("--seed", o->seed, "Seed of the random stream")
      .type_name("NUMBER")
      .check(whole(0, UINT64_MAX));
  cmd.add_option("--picture", o->picture,
                 "Draw map, tree and path to this file: .png, .svg or .pdf")
      .type_name("FILE");
  add_json(cmd, o->json);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return plan_command(*o, context); }; });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/angles.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/planning/planners.hpp"
#include "microswarm/report/picture.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string map;
  std::optional<double> um_per_px;
  std::vector<double> start;
  std::vector<double> goal;
  std::vector<std::string> settings;
  std::string picture;
  std::uint64_t seed = 1;
  bool json = false;
};

/// The planner's choice as a file would hold it, so that --set planner.… works as in scenarios.
struct Choice {
  PlannerParams planner;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.planner, {"planner", Unit::none, {}, "Planner and its parameters."});
  }
};

void draw(const Options& o, const Snapshot& world, const Pose2& start, Vec2 goal,
          const Plan& plan) {
  Picture picture(world.bounds(), fmt::format("{}: {}", o.map, to_string(plan.status)));
  picture.walls(world.map());
  picture.tree(plan.tree);
  picture.line(plan.path, colours::path, 3);
  picture.mark(start.position, "start");
  picture.mark(goal, "goal", colours::goal);
  picture.legend("path", colours::path);
  picture.legend("tree", colours::tree);
  picture.write(o.picture);
}

int plan_command(const Options& o, const Context& context) {
  Choice choice;
  for (const std::string& s : o.settings) set_value(choice, s);
  const Pose2 start{{o.start[0], o.start[1]}, o.start.size() > 2 ? radians(o.start[2]) : 0.0};
  const Vec2 goal{o.goal[0], o.goal[1]};
  const Snapshot world(load_map(guess_map_spec(o.map, o.um_per_px)).map);
  Rng rng(o.seed, Purpose::planner);
  const auto began = Stop::Clock::now();
  const Plan made = plan(world, start, goal, choice.planner, rng, context.stop);
  const double ms = std::chrono::duration<double, std::milli>(Stop::Clock::now() - began).count();

  const double clearance = std::visit([](const auto& p) { return p.clearance; }, choice.planner);
  std::string why;
  if (made.status == Status::start_blocked)
    why = "start " + world.why_blocked(start.position, clearance);
  if (made.status == Status::goal_blocked) why = "goal " + world.why_blocked(goal, clearance);
  if (!why.empty()) throw InputError(fmt::format("{}: {}", o.map, why));

  if (!o.picture.empty()) draw(o, world, start, goal, made);
  if (o.json) {
    Json path = Json::array();
    for (const Vec2 p : made.path) path.push_back({p.x, p.y});
    fmt::print("{}\n", Json{{"status", to_string(made.status)},
                            {"length_um", path_length(made.path)},
                            {"turning_deg", degrees(path_turning(made.path, start.heading))},
                            {"time_ms", ms},
                            {"iterations", made.counts.iterations},
                            {"nodes", made.tree.size()},
                            {"path_um", path}}
                           .dump(2));
  } else {
    fmt::print("{}: {:.1f} µm, turns {:.0f}°, {} points, {} nodes, {:.2f} ms\n",
               to_string(made.status), path_length(made.path),
               degrees(path_turning(made.path, start.heading)), made.path.size(), made.tree.size(),
               ms);
    for (const Vec2 p : made.path) fmt::print("{:.3f},{:.3f}\n", p.x, p.y);
  }
  return made.status == Status::solved ? ok : not_reached;
}

}  // namespace

void add_plan(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  CLI::App* cmd = app.add_subcommand("plan", "Plan one path on a map");
  cmd->add_option("map", o->map, "Map file: picture, ROS YAML, MovingAI, GeoJSON, CSV")->required();
  cmd->add_option("--um-per-px", o->um_per_px, "µm per pixel or cell");
  cmd->add_option("--start", o->start, "x,y or x,y,heading in µm and degrees")
      ->required()
      ->delimiter(',')
      ->expected(2, 3);
  cmd->add_option("--goal", o->goal, "x,y in µm")->required()->delimiter(',')->expected(2);
  cmd->add_option("--set", o->settings, "planner.type=a_star, planner.clearance_um=40, …")
      ->take_all()
      ->allow_extra_args(false);
  cmd->add_option("--seed", o->seed, "Seed of the random stream");
  cmd->add_option("--picture", o->picture, "Draw map, tree and path: .png, .svg or .pdf");
  cmd->add_flag("--json", o->json, "Result for machines");
  cmd->callback(
      [o, &action] { action = [o](const Context& context) { return plan_command(*o, context); }; });
}

}  // namespace microswarm::cli

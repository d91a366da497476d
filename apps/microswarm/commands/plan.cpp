// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/planning/common/free_goal.hpp"
#include "microswarm/planning/path/fit_to_map.hpp"
#include "microswarm/planning/path/planners.hpp"
#include "microswarm/report/picture.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct PlanOptions {
  std::string map;
  std::optional<double> um_per_px;
  std::string start;
  std::string goal;
  std::vector<std::string> settings;
  std::string picture;
  std::uint64_t seed = 1;
  bool json = false;
};

using PathChoice = PlannerChoice<PlannerParams>;

struct Ends {
  double clearance;
  double tolerance;
};

Ends ends_of(const PlannerParams& planner) {
  return std::visit([](const auto& p) { return Ends{p.clearance, p.goal_tolerance}; }, planner);
}

void draw(const PlanOptions& o, const Snapshot& world, const Pose2& start, Vec2 goal,
          const PlannerParams& planner, const Plan& plan) {
  Picture picture(world.bounds(), fmt::format("{}: {}", o.map, to_string(plan.status)));
  picture.walls(world.map());
  picture.tree(plan.tree);
  picture.line(plan.path, colours::path, 3);
  picture.mark(start.position, "start");
  picture.circle({goal, ends_of(planner).tolerance}, colours::goal, 2);
  picture.mark(goal, "goal", colours::goal);
  picture.legend("path", colours::path);
  if (!plan.tree.empty()) picture.legend("tree", colours::tree);
  picture.write(o.picture);
}

/// Throws InputError if no path can exist: a blocked start or goal, a swarm too wide, or a goal cut
/// off.
void explain(const PlanOptions& o, const Snapshot& world, Vec2 start, Vec2 goal,
             const PlannerParams& planner, Status status) {
  const auto [clearance, tolerance] = ends_of(planner);
  if (status == Status::start_blocked)
    throw InputError(fmt::format("{}: start {}", o.map, world.blocked_reason(start, clearance)));
  if (status == Status::goal_blocked)
    throw InputError(fmt::format("{}: goal {}", o.map, world.blocked_reason(goal, clearance)));
  if (status != Status::no_path && status != Status::node_limit) return;
  if (const auto target = free_goal(world, goal, tolerance, clearance))
    KeyLocations(o.map).require_none(validate_path(world.map(), start, *target, clearance));
}

std::string why_none(const Plan& made, const PlannerParams& planner) {
  const std::string word(to_string(made.status));
  if (made.status != Status::node_limit) return word;
  return fmt::format("{}: {}", word, limit_text(planner, made.counts));
}

void show(const Plan& made, const PathChoice& choice, double start_heading, double ms, bool json) {
  const double length = path_length(made);
  const double turning = degrees(path_turning(made.path, start_heading));
  if (json) {
    Json path = Json::array();
    for (const Vec2 p : made.path) path.push_back({p.x, p.y});
    print("{}\n", Json{{"status", to_string(made.status)},
                       {"length_um", length},
                       {"turning_deg", turning},
                       {"time_ms", ms},
                       {"iterations", made.counts.iterations},
                       {"nodes", made.tree.size()},
                       {"planner", Json::parse(to_json_text(choice))["planner"]},
                       {"path_um", path}}
                      .dump(2));
    return;
  }
  print("{} of {:.1f} µm in {} points, turns {:.0f}° in all; {} iterations, {} nodes, {:.2f} ms\n",
        made.status == Status::solved ? "path"
                                      : fmt::format("no path ({}), only the beginning of one,",
                                                    why_none(made, choice.planner)),
        length, made.path.size(), turning, made.counts.iterations, made.tree.size(), ms);
  if (!made.path.empty()) print("x_um,y_um\n");
  for (const Vec2 p : made.path) print("{:.3f},{:.3f}\n", p.x, p.y);
}

/// Throws InputError if the planner's parameters are inconsistent.
void check_planner(const PlannerParams& planner, const KeyLocations& keys) {
  Issues issues;
  if (const auto* fmt_star = std::get_if<FmtStarParams>(&planner)) issues = validate(*fmt_star);
  if (const auto* drrt_star = std::get_if<DrrtStarParams>(&planner))
    issues = validate(*drrt_star, given_within(keys.is_given(), "planner"));
  Issues of_planner;
  of_planner.add_within("planner", issues, "planner");
  keys.require_none(of_planner);
}

int plan_command(const PlanOptions& o, const Context& context) {
  keep_input(o.picture, o.map);
  PathChoice choice;
  note_each(set_values(choice, o.settings));
  const KeyLocations keys = locations_of({}, "plan", o.settings);
  check_planner(choice.planner, keys);
  const std::vector<double> from = numbers(o.start);
  const std::vector<double> to = numbers(o.goal);
  const Pose2 start{{from[0], from[1]}, from.size() > 2 ? radians(from[2]) : 0.0};
  const Vec2 goal{to[0], to[1]};
  const Snapshot world(reading([&] { return load_map(guess_map_spec(o.map, o.um_per_px)).map; }));
  choice.planner =
      fit_to_map(choice.planner, world.map(), given_within(keys.is_given(), "planner"));
  Rng rng(o.seed, Purpose::planner);
  const auto began = Stop::Clock::now();
  const Plan made = plan(world, start, goal, choice.planner, rng, context.stop);
  const double ms = std::chrono::duration<double, std::milli>(Stop::Clock::now() - began).count();
  explain(o, world, start.position, goal, choice.planner, made.status);
  if (!o.picture.empty()) draw(o, world, start, goal, choice.planner, made);
  show(made, choice, start.heading, ms, o.json);
  if (!o.json && !o.picture.empty()) print("wrote {}\n", o.picture);
  return made.status == Status::solved ? ok : not_reached;
}

}  // namespace

void add_plan(Command app, Action& action) {
  auto o = std::make_shared<PlanOptions>();
  Command cmd = app.add_command(
      "plan",
      "Plan a path on a map: the shortest one, or with drrt_star, rrt_star, uniform_rrt_star, rrt, "
      "rrt_connect, a_star, theta_star or fmt_star. What is not set follows from the map",
      "plan map.png --um-per-px 5 --start 200,700,-90 --goal 1750,300 \\\n"
      "      --set planner.type=a_star --set planner.clearance_um=40 --picture path.svg");
  cmd.add_option("map", o->map, "Picture, ROS .yaml, MovingAI .map, GeoJSON or CSV of rectangles")
      .required()
      .type_name("FILE");
  add_um_per_px(cmd, o->um_per_px, "µm per pixel or cell of the map, 1e-6..1e6");
  cmd.add_option("--start", o->start,
                 "Start position in µm and optional heading in degrees; y points up")
      .required()
      .type_name("X,Y[,HEADING]")
      .check(place(3, "x,y or x,y,heading in µm and degrees"));
  cmd.add_option("--goal", o->goal, "Goal position in µm")
      .required()
      .type_name("X,Y")
      .check(place(2, "x,y in µm"));
  add_settings(cmd, o->settings, "Select planner.type and override its values (repeatable)");
  cmd.add_option("--seed", o->seed, "Seed of the random stream (default: 1)")
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

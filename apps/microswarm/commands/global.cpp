// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/queries/global_query.hpp"
#include "microswarm/experiment/record/global_tree_file.hpp"
#include "microswarm/report/robot_picture.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct GlobalOptions {
  MapInput map;
  std::string robots;
  std::string goals;
  std::string tree;
  std::string save_tree;
  std::optional<double> time_limit;
  std::vector<std::string> settings;
  std::string picture;
  std::uint64_t seed = 1;
  bool as_found = false;
  bool json = false;
};

/// Parses "60,300;60,250"; empty if the text is not such a list.
std::vector<Vec2> places(const std::string& text) {
  std::vector<Vec2> all;
  for (const std::string_view one : split(text, ';')) {
    const std::vector<double> p = numbers(one);
    if (p.size() != 2) return {};
    all.push_back({p[0], p[1]});
  }
  return all;
}

Check place_list() {
  return {[](const std::string& text) -> std::string {
    const std::size_t count = places(text).size();
    if (count == 0) return "must be places as 60,300;60,250 in µm, not " + quote(text);
    if (count <= planning::max_global_robots) return {};
    return fmt::format("has {} places, allowed are 1 to {}", count, planning::max_global_robots);
  }};
}

/// Parameters with which a tree was grown; --set must not change them.
planning::GlobalRrtParams search_parameters(const GlobalOptions& o,
                                            const planning::GlobalTree& tree) {
  experiment::GlobalChoice choice;
  planning::GlobalRrtParams grown;
  grown.robostep = tree.robostep;
  grown.directions = static_cast<int>(tree.moves.size());
  grown.contact = tree.contact;
  grown.separation = tree.separation;
  choice.planner = grown;
  note_each(set_values(choice, {other_settings(o.settings), "--set"}));
  const auto* set = std::get_if<planning::GlobalRrtParams>(&choice.planner);
  const auto differs = [&](const char* key, const auto& was, const auto& is) {
    if (was != is)
      throw InputError(o.tree, fmt::format("was grown with {} {}, not {}", key, was, is));
  };
  if (!set) throw InputError(o.tree, "a tree is asked by planner.type=global_rrt only");
  differs("robostep_um", grown.robostep, set->robostep);
  differs("directions", grown.directions, set->directions);
  differs("separation_um", grown.separation, set->separation);
  differs("contact", enum_name(grown.contact), enum_name(set->contact));
  return *set;
}

Json to_runs(const std::vector<Vec2>& inputs) {
  Json runs = Json::array();
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    if (k > 0 && inputs[k] == inputs[k - 1])
      runs.back()["times"] = runs.back()["times"].get<int>() + 1;
    else
      runs.push_back({{"x_um", inputs[k].x}, {"y_um", inputs[k].y}, {"times", 1}});
  }
  return runs;
}

Json to_paths(const planning::GlobalPlan& plan) {
  Json paths = Json::array();
  for (std::size_t robot = 0; robot < plan.configurations.at(0).size(); ++robot) {
    Json path = Json::array();
    for (const auto& positions : plan.configurations)
      path.push_back({positions[robot].x, positions[robot].y});
    paths.push_back(path);
  }
  return paths;
}

void show_json(const experiment::GlobalAnswer& found, bool has_goals, Notes notes) {
  Json json{
      {"status", to_string(found.plan.status)}, {"nodes", found.nodes}, {"time_s", found.seconds}};
  if (has_goals) {
    json["worst_um"] = found.plan.worst;
    json["input_count"] = found.plan.inputs.size();
    json["input_count_found"] = found.inputs_found;
    json["inputs"] = to_runs(found.plan.inputs);
    json["ways_um"] = to_paths(found.plan);
  }
  notes.insert(notes.end(), found.notes.begin(), found.notes.end());
  json["notes"] = notes;
  print("{}\n", json.dump(2));
}

void show(const GlobalOptions& o, const experiment::GlobalAnswer& found) {
  const planning::GlobalPlan& plan = found.plan;
  if (o.goals.empty()) {
    print("tree of {} nodes, {:.2f} s\n", found.nodes, found.seconds);
  } else {
    print("{} of {} inputs",
          plan.status == Status::solved
              ? "plan"
              : fmt::format("no plan ({}), only the nearest one,", to_string(plan.status)),
          plan.inputs.size());
    if (found.inputs_found != plan.inputs.size()) print(" (found with {})", found.inputs_found);
    print(", the worst robot ends {:.1f} µm from its goal; {} nodes, {:.3f} s\n", plan.worst,
          found.nodes, found.seconds);
    print("input_x_um,input_y_um,times\n");
    for (const Json& run : to_runs(plan.inputs))
      print("{:.6g},{:.6g},{}\n", run["x_um"].get<double>(), run["y_um"].get<double>(),
            run["times"].get<int>());
  }
  if (!o.save_tree.empty()) print("wrote {}\n", o.save_tree);
  if (!o.picture.empty()) print("wrote {}\n", o.picture);
}

void check_options(const GlobalOptions& o) {
  if (o.robots.empty() == o.tree.empty())
    throw InputError("global: give either --robots, where they start, or --tree, which knows");
  if (o.goals.empty() && o.save_tree.empty())
    throw InputError("global: give --goals, or --save-tree to grow a tree for later");
  if (o.goals.empty() && !o.picture.empty()) throw InputError("global: --picture needs --goals");
}

/// Plans with a stored tree.
experiment::GlobalAnswer ask_tree(const GlobalOptions& o, const formats::LoadedMap& map,
                                  std::span<const Vec2> goals, const Stop& stop) {
  const planning::GlobalTree tree = experiment::read_global_tree(o.tree, map);
  const planning::GlobalRrtParams params = search_parameters(o, tree);
  const planning::GlobalPlay play = experiment::to_play(params);
  experiment::check_ends(*map.map, tree.positions(0), goals, play, o.map.file);
  const auto began = Stop::Clock::now();
  experiment::GlobalAnswer found{
      .plan = planning::plan_to(tree, planning::ask(tree, goals, params.goal_tolerance)),
      .planner = params,
      .nodes = tree.size()};
  found.seconds = seconds_since(began);
  found.inputs_found = found.plan.inputs.size();
  if (!o.as_found) found.plan = planning::shortened(*map.map, found.plan, goals, play, stop);
  return found;
}

/// Plans with a planner, which grows a tree; saves the tree if requested.
experiment::GlobalAnswer found_plan(const GlobalOptions& o, const formats::LoadedMap& map,
                                    std::vector<Vec2> goals, const Stop& stop) {
  if (!o.tree.empty()) return ask_tree(o, map, goals, stop);
  experiment::GlobalAnswer found =
      experiment::answer(*map.map,
                         {.starts = places(o.robots),
                          .goals = std::move(goals),
                          .settings = {other_settings(o.settings), "--set"},
                          .seed = o.seed,
                          .shorten = !o.as_found,
                          .keep_tree = !o.save_tree.empty()},
                         o.map.file, stop);
  note_each(found.notes);
  if (found.tree) experiment::write_global_tree(*found.tree, map, o.save_tree);
  return found;
}

int global_command(const GlobalOptions& o, const Context& context) {
  check_options(o);
  for (const std::string& out : {o.save_tree, o.picture})
    for (const std::string& in : {o.map.file, o.tree}) keep_input(out, in);
  const Stop stop = o.time_limit ? context.within(*o.time_limit) : context.stop;
  const formats::LoadedMap map = load_map(o.map, o.settings);
  const std::vector<Vec2> goals = places(o.goals);
  const experiment::GlobalAnswer found = found_plan(o, map, goals, stop);
  if (!o.picture.empty())
    report::draw_robots(*map.map, found.plan, goals,
                        experiment::to_play(found.planner).goal_tolerance,
                        fmt::format("{}: {}, {} inputs", o.map.file, to_string(found.plan.status),
                                    found.plan.inputs.size()),
                        o.picture);
  if (o.json)
    show_json(found, !goals.empty(), map.notes);
  else
    show(o, found);
  const bool grew = goals.empty() && found.plan.status == Status::node_limit;
  return grew || found.plan.status == Status::solved ? ok : not_reached;
}

}  // namespace

void add_global(Command app, Action& action) {
  auto o = std::make_shared<GlobalOptions>();
  Command cmd = app.add_command(
      "global", "Plan common inputs that bring each of several robots to its own goal",
      "global samples/veins.csv --robots \"20,60;20,50\" --goals \"180,60;180,50\" \\\n"
      "      --picture ways.png\n"
      "  microswarm global samples/veins.csv --robots \"20,60;20,50\" --save-tree tree.h5 \\\n"
      "      --set planner.max_nodes=20000\n"
      "  microswarm global samples/veins.csv --tree tree.h5 --goals \"180,60;180,50\"");
  add_map_input(cmd, o->map);
  cmd.add_option("--robots", o->robots, "Start positions of the robots in µm; y points up")
      .type_name("X,Y;X,Y;...")
      .check(place_list());
  cmd.add_option("--goals", o->goals, "Goal positions of the robots, in the same order")
      .type_name("X,Y;X,Y;...")
      .check(place_list());
  cmd.add_option("--tree", o->tree, "Query this tree, grown earlier on the same map")
      .type_name("FILE")
      .input();
  Option save = cmd.add_option("--save-tree", o->save_tree,
                               "Grow a tree to planner.max_nodes and save it to this HDF5 file");
  save.type_name("FILE").excludes("--tree");
  add_settings(cmd, o->settings, "Set values of planner (global_search, global_rrt) and map",
               type_of<MapAndPlanner<experiment::GlobalPlannerParams>>);
  cmd.add_option("--time-limit", o->time_limit, "Time limit")
      .type_name("SECONDS")
      .default_text("no limit")
      .check(number(0, 1e6));
  cmd.add_flag("--as-found", o->as_found, "Keep superfluous inputs");
  cmd.add_option("--seed", o->seed, "Seed of the random stream")
      .type_name("NUMBER")
      .check(whole(0, UINT64_MAX));
  cmd.add_option("--picture", o->picture, "Draw the robots' paths to this file: .png, .svg or .pdf")
      .type_name("FILE");
  add_json(cmd, o->json);
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return global_command(*o, context); };
  });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/core/text.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/navigation/aggregation.hpp"
#include "microswarm/report/picture.hpp"
#include "options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string map;
  std::optional<double> um_per_px;
  std::string goal;
  int robots = 256;
  std::optional<double> channel_width;
  int most_steps = 100'000;
  std::vector<std::string> settings;
  std::string out;
  std::uint64_t seed = 1;
  PhotoOptions photo;
  bool json = false;
};

/// Usual width of the channels: in one of width w the mean clearance of a free point is w/4.
double channel_width(const Map& map, Rng& rng) {
  constexpr int samples = 2000;
  const Box& box = map.bounds();
  double sum = 0;
  int count = 0;
  for (int i = 0; i < 1000 * samples && count < samples; ++i) {
    const double x = rng.uniform(box.lo.x, box.hi.x);
    const double clearance = map.clearance({x, rng.uniform(box.lo.y, box.hi.y)});
    if (clearance <= 0) continue;
    sum += clearance;
    ++count;
  }
  if (count == 0) throw InputError("no free space");
  return 4 * sum / count;
}

/// The published parameters, for channels of 10 µm, made as large as this map's channels.
AggregationParams parameters(const Options& o, double width) {
  AggregationParams params;
  const double factor = width / 10;
  params.tree = scaled(params.tree, factor);
  for (double* length : {&params.step, &params.sigma, &params.discount_length}) *length *= factor;
  for (const std::string& s : o.settings) set_value(params, s);
  return params;
}

/// Random places from which the tree is seen: what it did not reach cannot be gathered.
std::vector<Vec2> places(const AggregationMap& ground, const RobotStepper& stepper, int count,
                         Rng& rng, const std::string& map) {
  const Box& box = ground.map.bounds();
  std::vector<Vec2> found;
  for (int draw = 0; draw < 100'000 + 1000 * count && std::ssize(found) < count; ++draw) {
    const double x = rng.uniform(box.lo.x, box.hi.x);
    const Vec2 p{x, rng.uniform(box.lo.y, box.hi.y)};
    if (ground.map.is_free(p, 4 * stepper.guard()) && ground.tree.nearest_visible(ground.map, p))
      found.push_back(p);
  }
  if (std::ssize(found) < count)
    throw InputError(fmt::format("{}: found {} places for {} robots", map, found.size(), count));
  return found;
}

void draw(const Options& o, const ReportOptions& under, const AggregationMap& ground,
          const Robots& robots, Vec2 goal, const std::string& title, const std::string& name) {
  Picture picture(ground.map.bounds(), title);
  if (under.photo) {
    picture.photo(*under.photo, under.um_per_px, 0.25);
    picture.walls(ground.map, {1, 1, 1, 0.55}, colours::wall_edge);
  } else {
    picture.walls(ground.map);
  }
  for (std::size_t i = 0; i < robots.size(); ++i)
    picture.disc({robots.position(i), 0}, colours::swarm);
  picture.mark(goal, "goal", colours::goal);
  picture.legend("robots", colours::swarm, true);
  picture.write(std::filesystem::path(o.out) / name);
}

int gather_command(const Options& o, const Context& context) {
  const std::vector<double> to = numbers(o.goal);
  const Vec2 goal{to[0], to[1]};
  const ReportOptions under = report_options(o.photo);
  Map map = *load_map(guess_map_spec(o.map, o.um_per_px)).map;
  if (const std::string why = Snapshot(std::make_shared<Map>(map)).why_blocked(goal, 0);
      !why.empty())
    throw InputError(fmt::format("{}: goal {}", o.map, why));
  Rng rng(o.seed, Purpose::planner);
  const double width = o.channel_width ? *o.channel_width : channel_width(map, rng);
  const AggregationParams params = parameters(o, width);
  const AggregationMap ground(std::move(map), goal, params, rng);
  const RobotStepper stepper(ground.map, params.step);
  Rng scene(o.seed, Purpose::scene);
  Robots robots = stepper.place(places(ground, stepper, o.robots, scene, o.map));
  if (!o.out.empty()) {
    make_folder(o.out);
    draw(o, under, ground, robots, goal, fmt::format("{} robots before", o.robots), "before.png");
  }

  Gatherer gatherer(ground, params);
  const GatherResult result = gather(stepper, gatherer, robots, o.most_steps, context.stop);
  if (!o.out.empty())
    draw(o, under, ground, robots, goal,
         fmt::format("{} robots after {} steps of {:.3g} µm", o.robots, result.steps, params.step),
         "after.png");
  const bool gathered = result.status == Status::solved;
  if (o.json) {
    print("{}\n", Json{{"status", to_string(result.status)},
                       {"steps", result.steps},
                       {"mean_way_um", result.mean_way},
                       {"guard_count", result.guard_count},
                       {"step_um", params.step},
                       {"channel_width_um", width},
                       {"regions", ground.segmentation.regions.size()},
                       {"nodes", ground.tree.nodes.size()}}
                      .dump(2));
  } else {
    print("{} after {} steps of {:.3g} µm; the mean way to the goal is {:.3g} µm\n",
          gathered ? "gathered" : fmt::format("not gathered ({})", to_string(result.status)),
          result.steps, params.step, result.mean_way);
    print("  channels  about {:.3g} µm wide, {} regions; the tree has {} nodes\n", width,
          ground.segmentation.regions.size(), ground.tree.nodes.size());
    print("  guard     broke {} livelocks\n", result.guard_count);
    if (!o.out.empty()) print("wrote {}/before.png and {}/after.png\n", o.out, o.out);
  }
  return gathered ? ok : not_reached;
}

}  // namespace

void add_gather(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  CLI::App* cmd = add_command(
      app, "gather", "Gather many robots at a goal with one input for all, in a simulation",
      "gather vessels.geojson --goal 11103,2397 --robots 512 --out out/gather");
  cmd->add_option("map", o->map, "Picture, ROS .yaml, MovingAI .map, GeoJSON or CSV of rectangles")
      ->required()
      ->type_name("FILE");
  cmd->add_option("--map-um-per-px", o->um_per_px, "µm per pixel or cell of the map, 1e-6..1e6")
      ->type_name("NUMBER")
      ->check(number(1e-6, 1e6));
  cmd->add_option("--goal", o->goal, "x,y in µm; in a dead end")
      ->required()
      ->type_name("X,Y")
      ->check(place(2, "x,y in µm"));
  cmd->add_option("--robots", o->robots, "How many, at random places; 256 when not given")
      ->type_name("NUMBER")
      ->check(whole(1, 1'000'000));
  cmd->add_option(
         "--channel-width", o->channel_width,
         "Usual width of a channel in µm, which all lengths go by; measured when not given")
      ->type_name("NUMBER")
      ->check(number(1e-3, 1e6));
  cmd->add_option("--most-steps", o->most_steps, "Give up after so many; 100000 when not given")
      ->type_name("NUMBER")
      ->check(whole(1, 100'000'000));
  add_settings(cmd, o->settings, "Change a value, as method=heuristic (again and again)");
  cmd->add_option("--seed", o->seed, "Seed of the random streams; 1 when not given")
      ->type_name("NUMBER")
      ->check(whole(0, UINT64_MAX));
  cmd->add_option("--out", o->out, "Folder for before.png and after.png")->type_name("FOLDER");
  add_photo(cmd, o->photo);
  cmd->get_option("--photo")->needs("--out");
  add_json(cmd, o->json);
  cmd->callback([o, &action] {
    action = [o](const Context& context) { return gather_command(*o, context); };
  });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>
#include <utility>

#include "commands/run_output.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/queries/gather_query.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"

namespace microswarm::cli {
namespace {

struct GatherOptions {
  MapInput map{.file = {},
               .um_per_px = {},
               .um_per_unit = {},
               .um_per_px_option = "--map-um-per-px"};  // --um-per-px is the photograph's
  std::string goal;
  int robots = 256;
  std::optional<double> channel_width;
  int max_steps = 100'000;
  std::vector<std::string> settings;
  std::string out;
  std::uint64_t seed = 1;
  PhotoOptions photo;
  bool json = false;
};

/// Warns on stderr if a given width is far from the measured one.
void note_width(const GatherOptions& o, double measured) {
  constexpr double far = 5;
  if (!o.channel_width) return;
  if (*o.channel_width > far * measured || far * *o.channel_width < measured)
    note("note: --channel-width is {:.4g} µm, the map's channels are about {:.4g} µm\n",
         *o.channel_width, measured);
}

int gather_command(const GatherOptions& o, const Context& context) {
  const std::vector<double> to = numbers(o.goal);
  const report::ReportOptions report = report_options(o.photo);
  formats::MapSpec spec = choose_map_spec(o.map, o.settings);
  formats::MapParts map = formats::read_map_parts(spec);
  experiment::GatherExperiment made =
      experiment::open_gathering(std::move(map), std::move(spec),
                                 {.goal = {to[0], to[1]},
                                  .robots = o.robots,
                                  .channel_width = o.channel_width,
                                  .max_steps = o.max_steps,
                                  .settings = {other_settings(o.settings), "--set"},
                                  .seed = o.seed},
                                 o.map.file);
  note_width(o, made.measured_width);
  note_each(made.notes);
  const OutFolder hold(o.out);
  experiment::Session session(std::move(made.experiment));
  const auto growing = grow_record(session, o.out);
  finish_run(session, context.stop);
  return tell_run(session, {o.out, false, o.json}, report);
}

}  // namespace

void add_gather(Command app, Action& action) {
  auto o = std::make_shared<GatherOptions>();
  Command cmd = app.add_command(
      "gather", "Simulate gathering many robots at a goal with one common input",
      "gather scenarios/maps/retina.geojson --goal 11103,2397 --robots 64 --out out/gather");
  add_map_input(cmd, o->map);
  cmd.add_option("--goal", o->goal, "Goal in µm, in a dead end")
      .required()
      .type_name("X,Y")
      .check(place(2, "x,y in µm"));
  cmd.add_option("--robots", o->robots, "Number of robots, at random positions")
      .type_name("NUMBER")
      .check(whole(1, 1'000'000));
  cmd.add_option("--channel-width", o->channel_width,
                 "Typical channel width in µm, which scales all lengths")
      .type_name("NUMBER")
      .default_text("measured")
      .check(number(1e-3, 1e6));
  cmd.add_option("--max-steps,--most-steps", o->max_steps, "Maximum number of steps")
      .type_name("NUMBER")
      .check(whole(1, 100'000'000));
  add_settings(cmd, o->settings, "Override a scenario value, e.g. navigator.method=heuristic",
               type_of<experiment::Scenario>);
  cmd.add_option("--seed", o->seed, "Seed of the random streams")
      .type_name("NUMBER")
      .check(whole(0, UINT64_MAX));
  cmd.add_option("--out", o->out, "Folder for run.h5, pictures and index.html").type_name("FOLDER");
  add_photo(cmd, o->photo);
  cmd.option("--photo").needs("--out");
  add_json(cmd, o->json);
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return gather_command(*o, context); };
  });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/core/angles.hpp"
#include "microswarm/experiment/progress.hpp"
#include "microswarm/experiment/record.hpp"
#include "microswarm/experiment/trials.hpp"
#include "microswarm/report/run_report.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string scenario;
  std::string out;
  std::vector<std::string> settings;
  std::optional<std::uint64_t> seed;
  int trials = 1;
  int jobs = 0;
  bool json = false;
  bool no_report = false;
  std::string photo;
  double um_per_px = 1;
};

int exit_code(Status status) { return status == Status::solved ? ok : not_reached; }

Json to_json(const RunResult& result, const std::string& hash) {
  Json out{{"status", to_string(result.status)},
           {"metrics", Json::parse(to_json_text(result.metrics))},
           {"planning", Json::parse(to_json_text(summarise(result.timing.planning)))},
           {"record_hash", hash}};
  return out;
}

std::string summary(const RunResult& result) {
  const Metrics& m = result.metrics;
  const TimeSummary p = summarise(result.timing.planning);
  return fmt::format(
      "{} after {:.1f} s: {:.0f} µm, turned {:.0f}°, nearest wall {:.1f} µm, nearest obstacle "
      "{:.1f} µm,\n"
      "{} planning events of {:.3f} ms on average (longest {:.3f} ms), {:.1f} s held\n",
      to_string(result.status), m.time, m.length, degrees(m.turning), m.walls.clearance,
      m.obstacles.clearance, m.planning_events, 1e3 * p.mean, 1e3 * p.max, m.hold_time);
}

int one_run(const Options& o, const Scene& scene, const World& world, const Stop& stop) {
  const std::filesystem::path folder = o.out;
  Recorder recorder(scene);
  ProgressBar bar(scene.scenario.name.empty() ? "run" : scene.scenario.name);
  ProgressListener progress(scene.scenario, [&](const RunProgress& p) {
    bar.update(std::max(p.way_done, p.time_spent));
  });
  RunListener* const listeners[] = {&recorder, &progress};
  const RunResult result = simulate(scene.scenario, world, 0, listeners, stop);
  const Record& record = recorder.record();
  const std::string hash = record.hash();
  if (!o.out.empty()) {
    write_record(record, folder / "run.h5");
    if (!o.no_report) {
      ReportOptions options;
      if (!o.photo.empty()) options = {read_image(o.photo), o.um_per_px};
      write_run_report(record, folder, options);
    }
  }
  if (o.json) {
    fmt::print("{}\n", to_json(result, hash).dump(2));
  } else {
    fmt::print("{}record {}\n", summary(result), hash);
    if (!o.out.empty())
      fmt::print("wrote {}\n", (folder / (o.no_report ? "run.h5" : "index.html")).string());
  }
  return exit_code(result.status);
}

int many_runs(const Options& o, const Scene& scene, const World& world, const Stop& stop) {
  ProgressBar bar("trials");
  const auto results = run_trials(
      scene.scenario, world,
      {.trials = o.trials,
       .jobs = o.jobs,
       .progress = [&](int done, int all) { bar.update(static_cast<double>(done) / all); }},
      stop);
  Json list = Json::array();
  int solved = 0;
  int ran = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].ran) continue;
    ++ran;
    solved += results[i].result.status == Status::solved;
    Json row = to_json(results[i].result, results[i].hash);
    row["trial"] = i;
    list.push_back(row);
    if (!o.json)
      fmt::print("trial {}: {}record {}\n", i, summary(results[i].result), results[i].hash);
  }
  if (o.json)
    fmt::print("{}\n", Json{{"trials", list}}.dump(2));
  else
    fmt::print("{} of {} trials reached the goal\n", solved, ran);
  return solved == o.trials ? ok : not_reached;
}

int run_command(const Options& o, const Context& context) {
  const std::filesystem::path file = o.scenario;
  Scenario scenario = read_scenario(file, o.settings);
  if (o.seed) scenario.seed = *o.seed;
  const Scene scene = load_scene(std::move(scenario), file.parent_path());
  const World world = build_world(scene);
  check(scene.scenario, world, file.string());
  if (!o.out.empty()) make_folder(o.out);
  return o.trials > 1 ? many_runs(o, scene, world, context.stop)
                      : one_run(o, scene, world, context.stop);
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  CLI::App* cmd = app.add_subcommand("run", "Run a scenario: simulate, record, report");
  cmd->add_option("scenario", o->scenario, "Scenario file (YAML)")->required();
  cmd->add_option("--out", o->out, "Folder for record, pictures and page");
  cmd->add_option("--set", o->settings, "Change a value: key.path=value (again and again)")
      ->take_all()
      ->allow_extra_args(false);
  cmd->add_option("--seed", o->seed, "Seed of all random streams");
  cmd->add_option("--trials", o->trials, "Repeat with this many random streams")
      ->check(CLI::Range(1, 1000000));
  cmd->add_option("--jobs", o->jobs, "Threads for trials; 0: one a core")
      ->check(CLI::Range(0, 1024));
  cmd->add_option("--photo", o->photo, "Photograph to lay under the pictures");
  cmd->add_option("--um-per-px", o->um_per_px, "µm per pixel of the photograph")
      ->check(CLI::Range(1e-6, 1e6));
  cmd->add_flag("--no-report", o->no_report, "Write the record only");
  cmd->add_flag("--json", o->json, "Results for machines");
  cmd->callback(
      [o, &action] { action = [o](const Context& context) { return run_command(*o, context); }; });
}

}  // namespace microswarm::cli

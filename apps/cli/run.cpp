// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "microswarm/config/write.hpp"
#include "microswarm/core/angles.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/core/text.hpp"
#include "microswarm/experiment/progress.hpp"
#include "microswarm/experiment/record.hpp"
#include "microswarm/experiment/trials.hpp"
#include "options.hpp"

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
  PhotoOptions photo;
};

int exit_code(Status status) { return status == Status::solved ? ok : not_reached; }

Json to_json(const RunResult& result, const std::string& hash) {
  return {{"status", to_string(result.status)},
          {"metrics", Json::parse(to_json_text(result.metrics))},
          {"planning", Json::parse(to_json_text(summarise(result.timing.planning)))},
          {"record_hash", hash}};
}

std::string_view ending(Status status) {
  switch (status) {
    case Status::solved:
      return "goal reached";
    case Status::time_limit:
      return "time limit";
    case Status::held:
      return "held: nothing was safe, or nothing was seen,";
    case Status::collided:
      return "touched a wall or an obstacle";
    default:
      return to_string(status);
  }
}

std::string um(double length) {
  return std::isfinite(length) ? fmt::format("{:.1f} µm", length) : "–";
}

std::string robots_summary(const RunResult& result, const RobotSwarmParams& robots) {
  const Metrics& m = result.metrics;
  return fmt::format(
      "{} after {:.1f} s of simulated time and {} commands\n  {} {:.1f} µm\n  planning  {} times\n",
      ending(result.status), m.time, result.timing.steps.size(),
      robots.goals.empty() ? "goal      the mean way to it is"
                           : "goals     the robot farthest from its own is off by",
      m.goal_distance, m.planning_events);
}

std::string summary(const RunResult& result) {
  const Metrics& m = result.metrics;
  const TimeSummary p = summarise(result.timing.planning);
  std::string text =
      fmt::format("{} after {:.1f} s of simulated time", ending(result.status), m.time);
  if (result.status != Status::solved)
    text += fmt::format(", {:.0f} µm from the goal", m.goal_distance);
  text += fmt::format("\n  way       {:.0f} µm long, turned {:.0f}° in all, held for {:.1f} s\n",
                      m.length, degrees(m.turning), m.hold_time);
  text += fmt::format("  nearest   wall {}, moving obstacle {} (from the swarm's centre)\n",
                      um(m.walls.clearance), um(m.obstacles.clearance));
  return text + fmt::format("  planning  {} times, {:.3f} ms on average, {:.3f} ms the longest\n",
                            m.planning_events, 1e3 * p.mean, 1e3 * p.max);
}

int one_run(const Options& o, const Scene& scene, const World& world, const ReportOptions& report,
            const Stop& stop) {
  const std::filesystem::path folder = o.out;
  Recorder recorder(scene);
  RunResult result;
  {
    ProgressBar bar(scene.scenario.name.empty() ? "run" : scene.scenario.name);
    ProgressListener progress(scene.scenario, [&](const RunProgress& p) {
      bar.update(std::max(p.way_done, p.time_spent));
    });
    RunListener* const listeners[] = {&recorder, &progress};
    result = simulate(scene.scenario, world, 0, listeners, stop);
  }
  const Record& record = recorder.record();
  const std::string hash = record.hash();
  if (!o.out.empty()) {
    write_record(record, folder / "run.h5");
    if (!o.no_report) write_run_report(record, folder, report);
  }
  if (o.json) {
    print("{}\n", to_json(result, hash).dump(2));
  } else {
    const auto& robots = scene.scenario.robots;
    print("{}  record    {}\n", robots ? robots_summary(result, *robots) : summary(result), hash);
    if (!o.out.empty())
      print("wrote {}\n", (folder / (o.no_report ? "run.h5" : "index.html")).string());
  }
  return exit_code(result.status);
}

std::string trials_csv(const std::vector<TrialResult>& trials) {
  std::string text =
      "trial,status,time_s,length_um,turning_deg,goal_distance_um,hold_time_s,least_wall_um,"
      "least_obstacle_um,contacts,planning_events,planning_mean_s,planning_max_s,record_hash\n";
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!trials[i].ran) continue;
    const RunResult& r = trials[i].result;
    const Metrics& m = r.metrics;
    const TimeSummary p = summarise(r.timing.planning);
    text += fmt::format("{},{}", i, to_string(r.status));
    for (const double v : {m.time, m.length, degrees(m.turning), m.goal_distance, m.hold_time,
                           m.walls.clearance, m.obstacles.clearance})
      text += "," + number_text(v);
    text += fmt::format(",{},{},{:.6g},{:.6g},{}\n", m.contacts, m.planning_events, p.mean, p.max,
                        trials[i].hash);
  }
  return text;
}

int many_runs(const Options& o, const Scene& scene, const World& world, const Stop& stop) {
  std::vector<TrialResult> results;
  {
    ProgressBar bar("trials");
    results = run_trials(
        scene.scenario, world,
        {.trials = o.trials,
         .jobs = o.jobs,
         .progress = [&](int done, int all) { bar.update(static_cast<double>(done) / all); }},
        stop);
  }
  const std::filesystem::path csv = std::filesystem::path(o.out) / "trials.csv";
  if (!o.out.empty()) write_file_atomically(csv, trials_csv(results));
  Json list = Json::array();
  int solved = 0;
  int ran = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].ran) continue;
    const RunResult& r = results[i].result;
    ++ran;
    solved += r.status == Status::solved;
    Json row{{"trial", i}};
    row.update(to_json(r, results[i].hash));
    list.push_back(std::move(row));
    if (!o.json)
      print("trial {:3}: {} after {:.1f} s, {:.0f} µm long, record {}\n", i, ending(r.status),
            r.metrics.time, r.metrics.length, results[i].hash);
  }
  if (o.json)
    print("{}\n", Json{{"trials", list}}.dump(2));
  else
    print("{} of {} trials reached the goal{}\n", solved, ran,
          ran < o.trials ? fmt::format(", {} were not begun", o.trials - ran) : "");
  if (!o.json && !o.out.empty()) print("wrote {}\n", csv.string());
  return solved == o.trials ? ok : not_reached;
}

int run_command(const Options& o, const Context& context) {
  const std::filesystem::path file = o.scenario;
  Scenario scenario = read_scenario(file, o.settings);
  if (o.seed) scenario.seed = *o.seed;
  const Scene scene = load_scene(std::move(scenario), file.parent_path());
  const World world = build_world(scene);
  check(scene.scenario, world, file.string());
  const ReportOptions report = report_options(o.photo);
  if (!o.out.empty()) make_folder(o.out);
  return o.trials > 1 ? many_runs(o, scene, world, context.stop)
                      : one_run(o, scene, world, report, context.stop);
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  CLI::App* cmd = add_command(app, "run", "Run a scenario: simulate, record, report",
                              "run scenarios/first_flight.yaml --out out/first --set "
                              "swarm.radius_um=50");
  cmd->add_option("scenario", o->scenario, "Scenario file (YAML); `schema --keys` lists its keys")
      ->required()
      ->type_name("FILE");
  cmd->add_option("--out", o->out,
                  "Folder for run.h5, pictures and index.html; with --trials for trials.csv")
      ->type_name("FOLDER");
  add_settings(cmd, o->settings, "Change a value of the scenario (again and again)");
  cmd->add_option("--seed", o->seed, "Seed of all random streams, in place of the scenario's")
      ->type_name("NUMBER")
      ->check(whole(0, UINT64_MAX));
  cmd->add_option("--trials", o->trials, "Run this often, each time with other random streams")
      ->type_name("NUMBER")
      ->check(whole(1, 1'000'000));
  cmd->add_option("--jobs", o->jobs, "Threads for --trials; 0: one a core")
      ->type_name("NUMBER")
      ->needs("--trials")
      ->check(whole(0, 1024));
  add_photo(cmd, o->photo);
  cmd->get_option("--photo")->needs("--out");
  cmd->add_flag("--no-report", o->no_report, "Write run.h5 only");
  add_json(cmd, o->json);
  cmd->callback(
      [o, &action] { action = [o](const Context& context) { return run_command(*o, context); }; });
}

}  // namespace microswarm::cli

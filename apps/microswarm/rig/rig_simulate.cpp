// SPDX-License-Identifier: Apache-2.0
// `rig simulate` compares scenarios through a simulated rig with the kinematic simulation.
#include <fmt/ranges.h>

#include <array>
#include <memory>
#include <mutex>
#include <optional>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/run/run.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/rig/runtime/devices.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"
#include "rig/rig.hpp"
#include "rig/rig_notes.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

/// A scenario and its rig.
struct Pair {
  std::string scenario;
  std::string rig;
  std::vector<std::string> settings{};  ///< of the scenario
  std::vector<std::string> rig_settings{};
};

/// Default scenarios: every kind of navigator, scenarios of the papers.
std::vector<Pair> usual_pairs() {
  const std::string papers = (scenario_folder() / "papers").string() + "/";
  const std::string rigs = (scenario_folder() / "rigs").string() + "/";
  return {
      {papers + "drrt/s_channel.yaml", rigs + "ribbon.yaml"},
      {papers + "drrt/moving_obstacles.yaml", rigs + "ribbon.yaml"},
      {papers + "radar/single.yaml", rigs + "vortex.yaml"},
      {papers + "radar/experiment_twelve.yaml",
       rigs + "vortex.yaml",
       {},
       {"camera.type=simulated", "camera.microscope.um_per_px=10"}},
      {papers + "global/two_robots.yaml", rigs + "rollers.yaml"},
      {papers + "gather/t_junction.yaml", rigs + "rollers.yaml", {"navigator.method=heuristic"}},
      {papers + "gather/t_junction.yaml",
       rigs + "rollers.yaml",
       {"navigator.method=divide_and_conquer"}}};
}

/// Statistics of the runs of one plant.
struct Summary {
  int arrived = 0;
  int contacts = 0;
  std::vector<double> times;  ///< of arrivals [s]

  void add(const RunResult& result) {
    contacts += result.metrics.contacts;
    if (result.status != Status::solved) return;
    ++arrived;
    times.push_back(result.metrics.time);
  }
  std::string time() const { return times.empty() ? "–" : fmt::format("{:.1f}", median(times)); }
};

struct SimulateOptions {
  std::string scenario;
  std::string rig;
  std::vector<std::string> settings;
  std::vector<std::string> rig_settings;
  std::string out;
  int trials = 5;
  int jobs = 0;
};

/// A run as in simulation.csv.
struct SimulatedRunRow {
  std::string scenario;
  std::string settings;
  int trial = 0;
  std::string plant;
  Status status = Status::stopped;
  double time = 0;
  int contacts = 0;
  double goal_distance = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.scenario, {"scenario", Unit::none, {}, "Name of the scenario's file."});
    visit(self.settings, {"settings", Unit::none, {}, "Settings of the scenario."});
    visit(self.trial, {"trial", Unit::none, {}, "Number of the trial."});
    visit(self.plant, {"plant", Unit::none, {}, "kinematic or rig."});
    visit(self.status, {"status", Unit::none, {}, "How it ended."});
    visit(self.time, {"time", Unit::s, {}, "Time of the run."});
    visit(self.contacts, {"contacts", Unit::none, {}, "Number of contacts."});
    visit(self.goal_distance, {"goal_distance", Unit::um, {}, "Remaining distance."});
  }
};

int simulate_trials(const SimulateOptions& o, const Context& context) {
  if (o.scenario.empty() != o.rig.empty())
    throw InputError("rig simulate: a scenario and --rig go together");
  const std::vector<Pair> pairs =
      o.scenario.empty() ? usual_pairs()
                         : std::vector<Pair>{{o.scenario, o.rig, o.settings, o.rig_settings}};
  std::vector<RigExperiment> scenes;  // open all first, so that errors are reported before any run
  scenes.reserve(pairs.size());
  for (const Pair& pair : pairs)
    scenes.push_back(
        open_rig_experiment(pair.scenario, pair.settings, pair.rig, pair.rig_settings));
  for (const RigExperiment& on : scenes) {
    note_field(on.rig, on.scenario());
    simulated_camera(on.rig);
  }
  const OutFolder hold(o.out);
  std::vector<SimulatedRunRow> rows;
  print("{:<42} {:>7}  {:^24}  {:^24}\n", "", "", "without a rig", "through the rig");
  print("{:<42} {:>7}  {:>7} {:>8} {:>7}  {:>7} {:>8} {:>7}\n", "scenario", "trials", "arrived",
        "contacts", "time s", "arrived", "contacts", "time s");
  bool all = true;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Pair& pair = pairs[k];
    const RigExperiment& on = scenes[k];
    const std::filesystem::path file = pair.scenario;
    const Scenario& scenario = on.scenario();
    const World& world = on.experiment.world;
    const auto trials = static_cast<std::size_t>(o.trials);
    std::vector<std::optional<std::array<RunResult, 2>>> results(trials);
    {
      ProgressBar bar(file.stem().string());
      std::mutex mutex;
      int done = 0;
      for_each_index(trials, o.jobs, [&](std::size_t i) {
        const auto trial = static_cast<std::uint32_t>(i);
        if (context.stop()) return;
        const std::array<RunResult, 2> both{
            simulate(scenario, world, trial, {}, context.stop),
            microswarm::simulate_rig(scenario, world, on.rig, trial, {}, context.stop)};
        if (context.stop()) return;
        results[i] = both;
        const std::lock_guard lock(mutex);
        bar.update(++done / static_cast<double>(o.trials));
      });
    }
    std::array<Summary, 2> sums;
    int done = 0;
    for (std::size_t i = 0; i < trials; ++i) {
      if (!results[i]) continue;  // interrupted
      ++done;
      for (const std::size_t plant : {0U, 1U}) {
        const RunResult& r = (*results[i])[plant];
        sums[plant].add(r);
        rows.push_back({.scenario = file.stem().string(),
                        .settings = fmt::format("{}", fmt::join(pair.settings, " ")),
                        .trial = static_cast<int>(i),
                        .plant = plant == 0 ? "kinematic" : "rig",
                        .status = r.status,
                        .time = r.metrics.time,
                        .contacts = static_cast<int>(r.metrics.contacts),
                        .goal_distance = r.metrics.goal_distance});
      }
    }
    if (done == 0) break;
    std::string name = file.stem().string();
    for (const std::string& setting : pair.settings)
      name += " " + setting.substr(setting.find('=') + 1);
    print("{:<42} {:>7}  {:>7} {:>8} {:>7}  {:>7} {:>8} {:>7}\n", name, done, sums[0].arrived,
          sums[0].contacts, sums[0].time(), sums[1].arrived, sums[1].contacts, sums[1].time());
    flush_output();
    all = all && sums[1].arrived == o.trials;
  }
  if (!o.out.empty()) {
    const std::filesystem::path table = std::filesystem::path(o.out) / "simulation.csv";
    write_file_atomically(table, csv_table(rows));
    print("wrote {}\n", table.string());
  }
  if (context.stop()) print("interrupted\n");
  return all && !context.stop() ? ok : not_reached;
}

}  // namespace

void add_rig_simulate(Command rig, Action& action) {
  auto o = std::make_shared<SimulateOptions>();
  Command cmd =
      rig.add_command("simulate", "Compare runs through a simulated rig with runs without one",
                      "rig simulate scenario.yaml --rig rig.yaml --trials 10");
  cmd.former_name("rehearse");
  cmd.add_option("scenario", o->scenario,
                 "Scenario file (YAML) (default: a selection from the papers)")
      .type_name("FILE");
  cmd.add_option("--rig", o->rig, "Rig file (YAML)").type_name("FILE");
  add_settings(cmd, o->settings, "Override a scenario value (repeatable)");
  cmd.add_option("--set-rig", o->rig_settings, "Override a rig value (repeatable)")
      .type_name("KEY=VALUE");
  cmd.add_option("--trials", o->trials,
                 "Number of trials per scenario, each with its own random streams")
      .type_name("NUMBER")
      .check(whole(1, 100'000));
  cmd.add_option("--jobs", o->jobs, "Number of threads; 0: one per core")
      .type_name("NUMBER")
      .check(whole(0, 1024));
  cmd.add_option("--out", o->out, "Folder for simulation.csv").type_name("FOLDER");
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return simulate_trials(*o, context); };
  });
}

}  // namespace microswarm::cli

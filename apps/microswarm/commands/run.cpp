// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands/run_output.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/experiment/trials.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/rig/session/open_on_rig.hpp"
#include "rig/rig_notes.hpp"
#include "rig/rig_settings.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct RunOptions {
  std::string scenario;
  std::string out;
  std::string rig;
  std::vector<std::string> rig_settings;
  std::vector<std::string> settings;
  std::optional<std::uint64_t> seed;
  int trials = 1;
  int jobs = 0;
  bool json = false;
  bool no_report = false;
  PhotoOptions photo;
};

/// A row of trials.csv.
struct TrialRow {
  int trial = 0;
  Status status = Status::stopped;
  experiment::Metrics metrics;
  double planning_mean = 0;
  double planning_max = 0;
  std::string record_hash;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.trial, plain("trial", "Number of the trial."));
    visit(self.status, plain("status", "How it ended."));
    experiment::Metrics::fields(self.metrics, visit);
    visit(self.planning_mean, s("planning_mean", "Mean time of a plan."));
    visit(self.planning_max, s("planning_max", "Longest time of a plan."));
    visit(self.record_hash, plain("record_hash", "Hash of the record."));
  }
};

std::string trials_csv(const std::vector<experiment::TrialResult>& trials) {
  std::vector<TrialRow> rows;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!trials[i].ran) continue;
    const experiment::RunResult& r = trials[i].result;
    const experiment::TimeSummary p = experiment::summarise(r.timing.planning);
    rows.push_back({.trial = static_cast<int>(i),
                    .status = r.status,
                    .metrics = r.metrics,
                    .planning_mean = p.mean,
                    .planning_max = p.max,
                    .record_hash = trials[i].hash});
  }
  const auto columns = io::to_columns<TrialRow>();  // named as in a record, angles in rad
  std::string csv = io::csv_head(columns) + "\n";
  for (const TrialRow& row : rows) csv += io::csv_line(columns, &row) + "\n";
  return csv;
}

int many_runs(const RunOptions& o, const experiment::Scene& scene, const World& world,
              const Stop& stop) {
  std::vector<experiment::TrialResult> results;
  {
    ProgressBar bar("trials");
    results = experiment::run_trials(
        scene.scenario, world,
        {.trials = o.trials,
         .jobs = o.jobs,
         .progress = [&](int done, int all) { bar.update(static_cast<double>(done) / all); }},
        stop);
  }
  const std::filesystem::path csv = std::filesystem::path(o.out) / "trials.csv";
  if (!o.out.empty()) write_file_atomically(csv, trials_csv(results));
  Json list = Json::array();
  std::vector<std::string> hashes;
  int solved = 0;
  int ran = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].ran) continue;
    const experiment::RunResult& r = results[i].result;
    ++ran;
    solved += r.status == Status::solved;
    hashes.push_back(results[i].hash);
    Json row{{"trial", i}};
    row.update(run_json(r, results[i].hash));
    list.push_back(std::move(row));
    if (!o.json)
      print("trial {:3}: {} after {:.1f} s, {:.0f} µm long, record {}\n", i, ending(r),
            r.metrics.time, r.metrics.length, results[i].hash);
  }
  Notes notes;
  if (std::string same = experiment::same_run_note(hashes); !same.empty())
    notes.push_back(std::move(same));
  note_each(notes);
  if (o.json)
    print("{}\n", Json{{"trials", list}, {"notes", notes}}.dump(2));
  else
    print("{} of {} trials reached the goal{}\n", solved, ran,
          ran < o.trials ? fmt::format(", {} were not finished", o.trials - ran) : "");
  if (!o.json && !o.out.empty()) print("wrote {}\n", csv.string());
  return solved == o.trials ? ok : not_reached;
}

/// Opens the scenario on a simulated rig: camera, coils and field.
std::unique_ptr<experiment::Session> open_on_rig(const RunOptions& o) {
  if (o.rig.empty()) return nullptr;
  const rig::RigExperiment on = reading([&] {
    return rig::open_rig_experiment(o.scenario, {o.settings, "--set"}, o.rig,
                                    {o.rig_settings, "--set-rig"}, o.seed);
  });
  note_each(on.experiment.keys.notes());
  note_field(on.rig, on.scenario());
  return microswarm::rig::open_on_rig(on);
}

int run_command(const RunOptions& o, const Context& context) {
  std::unique_ptr<experiment::Session> session = open_on_rig(o);
  std::optional<experiment::Experiment> experiment;
  if (!session) {
    experiment = reading([&] {
      return experiment::open_experiment(o.scenario, {o.settings, "--set"}, o.seed);
    });
    note_each(experiment->keys.notes());
  }
  const report::ReportOptions report = report_options(o.photo);
  const OutFolder hold(o.out);
  if (o.trials > 1) return many_runs(o, experiment->scene, experiment->world, context.stop);
  if (!session) session = std::make_unique<experiment::Session>(std::move(*experiment));
  const auto growing = grow_record(*session, o.out);
  finish_run(*session, context.stop);
  return tell_run(*session, {o.out, o.no_report, o.json}, report);
}

}  // namespace

void add_run(Command app, Action& action) {
  auto o = std::make_shared<RunOptions>();
  Command cmd = app.add_command("run", "Run a scenario: simulate, record, report",
                                "run scenarios/first_flight.yaml --out out/first --set "
                                "swarm.radius_um=50");
  cmd.add_option("scenario", o->scenario, "Scenario file (YAML); `schema --keys` lists its keys")
      .required()
      .type_name("FILE")
      .input("papers");
  cmd.add_option("--out", o->out,
                 "Folder for run.h5, pictures and index.html, or with --trials for trials.csv")
      .type_name("FOLDER");
  add_settings(cmd, o->settings, "Override a scenario value", type_of<experiment::Scenario>);
  cmd.add_option("--rig", o->rig,
                 "Rig file (YAML); runs through its simulated camera, coils and field")
      .type_name("FILE")
      .input("rigs");
  add_rig_settings(cmd, "--set-rig", o->rig_settings).needs("--rig");
  cmd.add_option("--seed", o->seed, "Seed of all random streams; overrides the scenario's")
      .type_name("NUMBER")
      .check(whole(0, UINT64_MAX));
  cmd.add_option("--trials", o->trials, "Number of trials, each with its own random streams")
      .type_name("NUMBER")
      .excludes("--rig")
      .check(whole(1, 1'000'000));
  cmd.add_option("--jobs", o->jobs, "Number of threads for --trials; 0: one per core")
      .type_name("NUMBER")
      .needs("--trials")
      .check(whole(0, 1024));
  add_photo(cmd, o->photo);
  cmd.option("--photo").needs("--out");
  cmd.add_flag("--no-report", o->no_report, "Write run.h5 only");
  add_json(cmd, o->json);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return run_command(*o, context); }; });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
// `rig simulate` compares scenarios through a simulated rig with the kinematic simulation.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"
#include "microswarm/rig/session/open_on_rig.hpp"
#include "microswarm/rig/simulation/rig_comparison.hpp"
#include "rig/rig.hpp"
#include "rig/rig_notes.hpp"
#include "rig/rig_settings.hpp"
#include "rig/run/error_table.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

/// Default scenarios: every kind of navigator, in the papers' scenarios.
std::vector<RigPair> usual_pairs() {
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

struct SimulateOptions {
  std::string scenario;
  std::string rig;
  std::vector<std::string> settings;
  std::vector<std::string> rig_settings;
  std::string out;
  int trials = 5;
  int jobs = 0;
  bool errors = false;
};

std::vector<RigPair> paired_values(const SimulateOptions& o) {
  if (o.scenario.empty()) return usual_pairs();
  return {{o.scenario, o.rig, o.settings, o.rig_settings}};
}

std::string time_text(const rig::RunSummary& of) {
  return std::isnan(of.time) ? "–" : fmt::format("{:.1f}", of.time);
}

void note_same(const std::string& name, std::string_view where, std::size_t trials) {
  note("note: {}: all {} trials {} are the same run: nothing there is random, count them as one\n",
       name, trials, where);
}

/// Notes what the rig did in the trials that only a rig does.
void note_rig(const std::string& name, std::span<const rig::ComparedTrial> trials) {
  double min_scale = 1;
  for (const rig::ComparedTrial& trial : trials) {
    min_scale = std::min(min_scale, trial.min_scale);
    if (!trial.fault.empty())
      note("note: {}: trial {} ended with a fault: {}\n", name, trial.trial, trial.fault);
    for (const std::string& about : trial.notes)
      note("note: {}: trial {}: {}\n", name, trial.trial, about);
  }
  if (min_scale < 1)
    note("note: {}: the coils' limits weakened the field to {:.3g} of what was commanded\n", name,
         min_scale);
}

int simulate_trials(const SimulateOptions& o, const Context& context) {
  if (o.scenario.empty() != o.rig.empty())
    throw InputError("rig simulate: a scenario and --rig go together");
  const std::vector<RigPair> pairs = paired_values(o);
  if (o.errors) return simulate_errors(pairs, o.trials, o.jobs, o.out, context);
  std::vector<rig::RigExperiment>
      scenes;  // open all first, so that errors are reported before any run
  scenes.reserve(pairs.size());
  for (const RigPair& pair : pairs)
    scenes.push_back(rig::open_rig_experiment(pair.scenario, {pair.settings, "--set"}, pair.rig,
                                              {pair.rig_settings, "--set-rig"}));
  for (const rig::RigExperiment& on : scenes) {
    note_field(on.rig, on.scenario());
    rig::require_field(on.rig);
    rig::require_simulated_map(on);
  }
  const OutFolder hold(o.out);
  std::vector<rig::ComparisonRow> rows;
  print("{:<42} {:>7}  {:^24}  {:^24}\n", "", "", "without a rig", "through the rig");
  print("{:<42} {:>7}  {:>7} {:>8} {:>7}  {:>7} {:>8} {:>7}\n", "scenario", "trials", "arrived",
        "contacts", "time s", "arrived", "contacts", "time s");
  bool all = true;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const RigPair& pair = pairs[k];
    const std::filesystem::path file = pair.scenario;
    std::vector<rig::ComparedTrial> trials;
    {
      ProgressBar bar(file.stem().string());
      trials = rig::compare_with_rig(
          scenes[k], o.trials, o.jobs, [&](double share) { bar.update(share); }, context.stop);
    }
    if (trials.empty()) break;  // interrupted
    for (rig::ComparisonRow& row : rig::comparison_rows(
             trials, file.stem().string(), fmt::format("{}", fmt::join(pair.settings, " "))))
      rows.push_back(std::move(row));
    const rig::RunSummary kinematic = summarise(trials, &rig::ComparedTrial::kinematic);
    const rig::RunSummary rig = summarise(trials, &rig::ComparedTrial::rig);
    std::string name = file.stem().string();
    for (const std::string& setting : pair.settings)
      name += " " + setting.substr(setting.find('=') + 1);
    print("{:<42} {:>7}  {:>7} {:>8} {:>7}  {:>7} {:>8} {:>7}\n", name, trials.size(),
          kinematic.arrived, kinematic.contacts, time_text(kinematic), rig.arrived, rig.contacts,
          time_text(rig));
    flush_output();
    if (kinematic.are_same) note_same(name, "without a rig", trials.size());
    if (rig.are_same) note_same(name, "through the rig", trials.size());
    note_rig(name, trials);
    all = all && rig.arrived == o.trials;
  }
  if (!o.out.empty()) {
    const std::filesystem::path table = std::filesystem::path(o.out) / "simulation.csv";
    write_file_atomically(table, io::csv_table(rows));
    print("wrote {}\n", table.string());
  }
  if (context.stop()) print("interrupted\n");
  return all && !context.stop() ? ok : not_reached;
}

}  // namespace

void add_rig_simulate(Command rig, Action& action) {
  auto o = std::make_shared<SimulateOptions>();
  Command cmd = rig.add_command(
      "simulate", "Compare runs through a simulated rig with runs without one",
      "rig simulate scenarios/first_rig.yaml --rig scenarios/rigs/vortex.yaml --trials 2");
  cmd.former_name("rehearse");
  cmd.add_option("scenario", o->scenario, "Scenario file (YAML)")
      .type_name("FILE")
      .input("papers")
      .default_text("a selection from the papers");
  cmd.add_option("--rig", o->rig, "Rig file (YAML)").type_name("FILE").input("rigs");
  add_settings(cmd, o->settings, "Override a scenario value", type_of<experiment::Scenario>);
  add_rig_settings(cmd, "--set-rig", o->rig_settings);
  cmd.add_option("--trials", o->trials,
                 "Number of trials per scenario, each with its own random streams")
      .type_name("NUMBER")
      .check(whole(1, 100'000));
  cmd.add_option("--jobs", o->jobs, "Number of threads; 0: one per core")
      .type_name("NUMBER")
      .check(whole(0, 1024));
  cmd.add_flag(
      "--errors", o->errors,
      "Through the rig only, with errors that its file does not know, one after the other");
  cmd.add_option("--out", o->out, "Folder for simulation.csv or errors.csv").type_name("FOLDER");
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return simulate_trials(*o, context); };
  });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/experiment/run/run_listener.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"

namespace microswarm::rig {

/// One trial in the kinematic simulation and through the simulated rig.
struct ComparedTrial {
  int trial = 0;
  experiment::RunResult kinematic{};
  experiment::RunResult rig{};
  std::string fault{};   ///< why the run through the rig stopped; empty without a fault
  double min_scale = 1;  ///< lowest scale of the rig's currents, imposed by the coils' limits
  std::vector<std::string> notes{};  ///< about the rig's pictures, one line each
};

/// Runs the trials 0 to `trials` − 1 in both simulations, on `jobs` threads (0: one per core).
/// `progress` is called with the completed share, one call at a time. Returns the trials that were
/// completed before a stop, in order.
std::vector<ComparedTrial> compare_with_rig(const RigExperiment& on, int trials, int jobs,
                                            const std::function<void(double share)>& progress,
                                            const Stop& stop = {});

/// Statistics of the runs in one of the two simulations.
struct RunSummary {
  int arrived = 0;
  int contacts = 0;
  double time = 0;        ///< median of the runs that arrived [s]; NaN if none did
  bool are_same = false;  ///< whether all, two or more, have the same result to the bit
};

/// Summary of one of the two results of each trial.
RunSummary summarise(std::span<const ComparedTrial> trials,
                     experiment::RunResult ComparedTrial::*plant);

/// A row of simulation.csv.
struct ComparisonRow {
  std::string scenario{};
  std::string settings{};
  int trial = 0;
  std::string plant{};
  Status status = Status::stopped;
  double time = 0;
  int contacts = 0;
  double goal_distance = 0;
  std::string fault{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.scenario, plain("scenario", "Name of the scenario's file."));
    visit(self.settings, plain("settings", "Settings of the scenario."));
    visit(self.trial, plain("trial", "Number of the trial."));
    visit(self.plant, plain("plant", "kinematic or rig."));
    visit(self.status, plain("status", "How it ended."));
    visit(self.time, s("time", "Time of the run."));
    visit(self.contacts, plain("contacts", "Number of contacts."));
    visit(self.goal_distance, um("goal_distance", "Remaining distance."));
    visit(self.fault, plain("fault", "Why the rig stopped; empty if it did not."));
  }
};

/// Two rows for each trial.
std::vector<ComparisonRow> comparison_rows(std::span<const ComparedTrial> trials,
                                           const std::string& scenario,
                                           const std::string& settings);

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/experiment/run/run_listener.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"

namespace microswarm::rig {

/// An error of a simulated rig that its file does not know, as settings of the rig.
struct RigError {
  std::string_view name{};
  std::vector<std::string> rig_settings{};
};

/// Errors that rigs have: wrong speed, delay, scale, turn, displacement and light, one by one and
/// together; the first is none.
std::span<const RigError> rig_errors();

/// One trial through a simulated rig, beside the truth.
struct RigTrial {
  experiment::RunResult result{};
  std::string fault{};               ///< why it stopped; empty without a fault
  std::vector<std::string> notes{};  ///< about the pictures, one line each
  bool arrived = false;       ///< whether the swarm truly is within 1.1 tolerances of the goal
  double goal_distance = 0;   ///< true distance to the goal at the end [µm]
  double position_error = 0;  ///< largest distance between the seen and the true position [µm]
  double min_scale = 1;       ///< lowest scale of the currents, imposed by the coils' limits

  /// The run ended as solved, but the swarm is elsewhere.
  bool is_believed() const { return result.status == Status::solved && !arrived; }
};

/// Runs a trial through the simulated rig.
RigTrial run_on_rig(const RigExperiment& on, std::uint32_t trial, const Stop& stop = {});

/// A row of errors.csv.
struct RigErrorRow {
  std::string scenario{};
  std::string error{};
  int trial = 0;
  Status status = Status::stopped;
  bool arrived = false;
  double time = 0;
  int contacts = 0;
  double goal_distance = 0;
  double position_error = 0;
  std::string fault{};
  std::string note{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.scenario, plain("scenario", "Name of the scenario's file."));
    visit(self.error, plain("error", "Error of the rig."));
    visit(self.trial, plain("trial", "Number of the trial."));
    visit(self.status, plain("status", "How it ended."));
    visit(self.arrived, plain("arrived", "Whether the swarm truly is at the goal."));
    visit(self.time, s("time", "Time of the run."));
    visit(self.contacts, plain("contacts", "Number of contacts."));
    visit(self.goal_distance, um("goal_distance", "True distance to the goal at the end."));
    visit(self.position_error, um("position_error", "Largest error of a seen position."));
    visit(self.fault, plain("fault", "Why the rig stopped; empty if it did not."));
    visit(self.note, plain("note", "First note about the pictures."));
  }
};

/// The row of a trial.
RigErrorRow error_row(const RigTrial& trial, int number, const std::string& scenario,
                      const RigError& error);

}  // namespace microswarm::rig

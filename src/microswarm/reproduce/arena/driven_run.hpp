// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/navigation/params.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::reproduce {

/// Properties of a world that a navigator must be given.
struct DrivenSwarm {
  double speed = 0;      ///< [µm/s]
  double clearance = 0;  ///< from the swarm's centre to walls, for D-RRT* and the radar's path [µm]
};

/// A navigator that is compared with others, at its default settings.
struct DrivenNavigator {
  std::string name{};
  navigation::NavigatorParams (*params)(const DrivenSwarm& swarm) = nullptr;
  bool is_recommended = false;
};

/// The navigators for one body: ours, those of the papers as published, and the baselines.
std::vector<DrivenNavigator> driven_navigators();

/// A navigator's run through a world.
struct DrivenRun {
  bool ran = false;       ///< false if it was refused or stopped
  std::string refusal{};  ///< why it was not begun; empty if it was
  Status status = Status::stopped;
  double time = 0;     ///< [s]
  double length = 0;   ///< of the swarm's path [µm]
  double turning = 0;  ///< [rad]
  int contacts = 0;
  int avoidable = 0;
  double step_p50 = 0;  ///< wall-clock time of a decision [s]
  double step_p99 = 0;

  bool arrived() const { return ran && status == Status::solved; }
};

/// Runs the scenario from its start, with a verdict on each contact; a scenario that `validate`
/// refuses is not begun.
DrivenRun drive(const experiment::Scenario& scenario, const World& world, const Stop& stop);

/// Time of the earliest arrival with all motions known [s]; nothing if there is none.
std::optional<double> find_optimum(const experiment::Scenario& scenario, const World& world,
                                   const Stop& stop);

/// "3 of 60; 95 %: 1.7 – 13.7", in percent.
std::string share_text(int count, int all);

}  // namespace microswarm::reproduce

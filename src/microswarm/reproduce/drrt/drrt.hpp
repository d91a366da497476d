// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/reproduce/reproduce.hpp"

namespace microswarm::reproduce {

/// A shipped scenario of [drrt] with its world.
struct DrrtSetting {
  experiment::Scene scene{};
  World world{};
};
DrrtSetting load_drrt(const ReproduceOptions& options, const char* name);

/// Reduction of `ours` relative to `theirs` [%].
inline double percent_less(double ours, double theirs) {
  return theirs == 0 ? 0 : 100 * (1 - ours / theirs);
}

// The figures of [drrt], one in each file.

/// The S-channel: D-RRT* as published and ours, compared with RRT*, uniform RRT* and A*.
std::vector<report::ReproduceRow> drrt_fig3(const ReproduceOptions& options, const Stop& stop);
/// Median planning time [ms] of the published planner over the whole S-channel, for Fig 6.
double drrt_global_planning_time(const ReproduceOptions& options, const Stop& stop);
/// The deforming channel and the moving obstacles, as published and ours.
std::vector<report::ReproduceRow> drrt_fig5a(const ReproduceOptions& options, const Stop& stop);
std::vector<report::ReproduceRow> drrt_fig5b(const ReproduceOptions& options, const Stop& stop);
/// Compares D-RRT* with the radar of [radar] among the moving obstacles of Fig 5(b), with equal
/// start, goal and margin, each as published and ours.
std::vector<report::ReproduceRow> drrt_comparison(const ReproduceOptions& options,
                                                  const Stop& stop);

/// Shortest way [µm] of the scenario's swarm to within the goal's tolerance, without its moving
/// obstacles and at no distance from the walls: no run is shorter.
double shortest_path_length(const DrrtSetting& setting);
/// Median of lengths [µm] over the shortest [%]; nothing without one.
std::optional<double> over_the_shortest(const std::vector<double>& lengths, double shortest);

/// Gives the obstacles of each trial another phase of their motion.
void vary_phases(experiment::Scenario& scenario, std::uint32_t trial);

}  // namespace microswarm::reproduce

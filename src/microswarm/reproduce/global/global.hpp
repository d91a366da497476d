// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "microswarm/planning/global_input/global_search.hpp"
#include "microswarm/planning/global_input/global_tree.hpp"
#include "microswarm/reproduce/reproduce.hpp"
#include "microswarm/scenes/global_tasks.hpp"

namespace microswarm::reproduce {

/// Draws the plan in all picture formats. Does nothing without an output folder.
void draw_plan(const ReproduceOptions& options, const std::string& name, const std::string& title,
               const Map& map, const planning::GlobalPlan& plan, std::span<const Vec2> goals,
               double tolerance = 20);

/// Minimum distance [µm] between two robots at the ends of a plan's inputs.
double min_distance(const planning::GlobalPlan& plan);

/// Solves a task by our search (beyond the paper) with several seeds; the plan of the first is
/// drawn as `name`.
std::vector<report::ReproduceRow> search_task(const char* figure, const char* name,
                                              const scenes::GlobalTask& task,
                                              planning::GlobalSearchParams params, int seeds,
                                              const ReproduceOptions& options, const Stop& stop);

/// Coverage of the configuration space by trees of two robots: over input length and number of
/// nodes (3–5), edge of the hypercubes (6) and distance between the starts (7).
std::vector<report::ReproduceRow> global_step_lengths(const ReproduceOptions& options,
                                                      const Stop& stop);
std::vector<report::ReproduceRow> global_cell_sizes(const ReproduceOptions& options,
                                                    const Stop& stop);
std::vector<report::ReproduceRow> global_initial_distances(const ReproduceOptions& options,
                                                           const Stop& stop);

/// Plans of the published tree compared with those of the search: three robots in vascular networks
/// (1), four in Env 3 by a reused tree (9, 10), two magnets (12).
std::vector<report::ReproduceRow> global_vascular(const ReproduceOptions& options,
                                                  const Stop& stop);
std::vector<report::ReproduceRow> global_reuse(const ReproduceOptions& options, const Stop& stop);
std::vector<report::ReproduceRow> global_magnets(const ReproduceOptions& options, const Stop& stop);

/// Plans of the search alone: three robots in a digestive system (8); beyond the paper: two to four
/// robots in Env 1–4, and six.
std::vector<report::ReproduceRow> global_digestive(const ReproduceOptions& options,
                                                   const Stop& stop);
std::vector<report::ReproduceRow> global_beyond(const ReproduceOptions& options, const Stop& stop);
std::vector<report::ReproduceRow> global_six(const ReproduceOptions& options, const Stop& stop);

}  // namespace microswarm::reproduce

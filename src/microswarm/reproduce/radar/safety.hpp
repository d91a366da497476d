// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/reproduce/reproduce.hpp"

namespace microswarm::reproduce {

/// Runs every navigator in generated worlds with obstacles slower than the swarm, with and without
/// walls, and among recorded pedestrians. Measures contacts, contacts avoidable by holding or
/// retreating, arrivals and times. Plots, tables of all runs and contacts, and some worlds are
/// written to options.out.
std::vector<report::ReproduceRow> radar_safety(const ReproduceOptions& options, const Stop& stop);

/// The same worlds with noisy and missed detections of obstacles.
std::vector<report::ReproduceRow> radar_safety_noisy(const ReproduceOptions& options,
                                                     const Stop& stop);

/// The same with obstacles at 1 to 3 times the swarm's speed, and pedestrians as fast as the swarm.
std::vector<report::ReproduceRow> radar_fast(const ReproduceOptions& options, const Stop& stop);

/// The recommended navigators in worlds of every hardship, where obstacles do not turn in no time.
std::vector<report::ReproduceRow> radar_hardships(const ReproduceOptions& options,
                                                  const Stop& stop);

}  // namespace microswarm::reproduce

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/reproduce/reproduce.hpp"

namespace microswarm::reproduce {

/// Generated worlds with obstacles slower than the swarm, with and without walls, and recorded
/// walkers: contacts, those that holding or retreating could have avoided, arrivals and times of
/// every navigator. Plots, tables of all runs and contacts, and some worlds go to options.out.
std::vector<ReproduceRow> radar_safety(const ReproduceOptions& options, const Stop& stop);

/// The same worlds with obstacles that are seen with noise and not in every frame.
std::vector<ReproduceRow> radar_safety_noisy(const ReproduceOptions& options, const Stop& stop);

/// The same with obstacles at 1 to 3 times the swarm's speed, and walkers as fast as it.
std::vector<ReproduceRow> radar_fast(const ReproduceOptions& options, const Stop& stop);

}  // namespace microswarm::reproduce

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/reproduce/arena/driven_run.hpp"

namespace microswarm::reproduce {

/// A scene with the runs through it.
struct ArenaScene {
  std::size_t kind = 0;
  std::uint64_t seed = 0;
  bool done = false;
  std::optional<double> optimum{};  ///< earliest arrival with the motions known [s]
  double shortest = 0;              ///< way among the walls alone [µm]
  std::vector<DrivenRun> runs{};    ///< one for each navigator
};

/// Scenes that are run: one kind in `every`, with `seeds` seeds from `first` on.
struct ArenaExtent {
  std::uint64_t first = 1;
  std::size_t seeds = 5;
  std::size_t every = 1;
  int threads = 0;  ///< 0: as many as there are processors
};

/// Runs every navigator through the scenes, in parallel; the results, apart from wall-clock times,
/// do not depend on the number of threads. `progress` receives the completed fraction.
std::vector<ArenaScene> run_arena(const std::vector<DrivenNavigator>& who,
                                  const ArenaExtent& extent,
                                  const std::function<void(double)>& progress, const Stop& stop);

}  // namespace microswarm::reproduce

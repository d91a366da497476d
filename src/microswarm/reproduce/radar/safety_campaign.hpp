// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "microswarm/reproduce/radar/crossing_store.hpp"
#include "microswarm/scenes/avoidance_worlds.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::reproduce {

/// Worlds to cross, by seed. Both functions must be pure and thread-safe.
struct Course {
  std::string name{};
  double passage_gap = scenes::avoidance_passage_gap;  ///< beside the swarm, between walls [µm]
  std::function<experiment::Scenario(std::uint64_t seed)> scenario{};
  std::function<World(const experiment::Scenario&)> world{};
};

/// A navigator and its parameters for a scenario.
struct Contestant {
  std::string name{};
  std::function<navigation::NavigatorParams(const experiment::Scenario&, double passage_gap)>
      params{};
};

/// Every navigator that supports such a swarm, in the order of NavigatorParams. All use the swarm's
/// speed. D-RRT* has a margin that fits every passage; navigators with waypoints plan them where
/// there are walls. The radar appears once more as published. Other parameters are defaults.
std::vector<Contestant> contestants(const experiment::Scenario& example);

/// Results of one course, by contestant and seed.
using Crossings = std::vector<std::vector<Crossing>>;

/// Runs contestant k on the worlds of seeds 0 … counts[k] − 1, in parallel. The results do not
/// depend on the number of threads. Crossings in `store` are not run again, and the others are
/// added to it; null: no store. `progress` receives the completed fraction.
Crossings cross(const Course& course, const std::vector<Contestant>& who,
                const std::vector<int>& counts, CrossingStore* store,
                const std::function<void(double)>& progress, const Stop& stop);

/// Writes the scenario as stem.yaml, with stem-tracks.csv if it has tracks, for `microswarm run`.
void write_scenario(experiment::Scenario scenario, const std::filesystem::path& folder,
                    const std::string& stem);

}  // namespace microswarm::reproduce

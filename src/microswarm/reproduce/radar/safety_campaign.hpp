// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "microswarm/experiment/run/contact_judge.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::reproduce {

/// Worlds that a swarm has to cross, by seed. Both functions are pure and may be called from any
/// thread.
struct Course {
  std::string name;
  bool walls = false;
  std::function<Scenario(std::uint64_t seed)> scenario;
  std::function<World(const Scenario&)> world;
};

/// A navigator, and how it is set for a scenario.
struct Contestant {
  std::string name;
  std::function<NavigatorParams(const Scenario&, bool walls)> params;
};

/// Every navigator that can steer such a swarm, in the order of NavigatorParams. All of them ask
/// for the swarm's speed; D-RRT* keeps a margin that fits through every passage, and those that
/// plan waypoints do so where there are walls. The radar is there with circles that suit such
/// obstacles and as published. The rest is as by default.
std::vector<Contestant> contestants(const Scenario& example);

/// What came of one run.
struct Crossing {
  bool ran = false;
  Status status = Status::stopped;
  bool arrived = false;  ///< at the goal, touched or not
  std::size_t obstacles = 0;
  double time = 0;       ///< [s]
  double straight = 0;   ///< what the straight way takes at full speed [s]
  double delta = 0;      ///< mean avoidance cost
  double turning = 0;    ///< [rad]
  double min_gap = 0;    ///< [µm]
  double hold_time = 0;  ///< [s]
  double step = 0;       ///< mean wall-clock time of a decision [s]
  std::vector<ContactVerdict> contacts;

  int avoidable() const;
};

/// Crossings of one course, by contestant and seed.
using Crossings = std::vector<std::vector<Crossing>>;

/// Crosses the worlds of seeds 0 … most − 1, contestant k those of seeds below counts[k]; in
/// parallel, the same results for any number of threads. `progress` hears the share done.
Crossings cross(const Course& course, const std::vector<Contestant>& who,
                const std::vector<int>& counts, const std::function<void(double)>& progress,
                const Stop& stop);

/// The scenario as stem.yaml, with stem-tracks.csv where it has tracks, for `microswarm run`.
void write_scenario(Scenario scenario, const std::filesystem::path& folder,
                    const std::string& stem);

}  // namespace microswarm::reproduce

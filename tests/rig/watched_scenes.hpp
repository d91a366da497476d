// SPDX-License-Identifier: Apache-2.0
// Shipped pairs of scenario and rig whose camera may be wrong, and their pictures.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "microswarm/rig/params/rig_experiment.hpp"
#include "microswarm/rig/simulation/rig_simulator.hpp"

namespace microswarm::test {

struct WatchedPair {
  std::string name, scenario, rig;
  std::vector<std::string> rig_settings{};
};
inline void PrintTo(const WatchedPair& pair, std::ostream* out) { *out << pair.name; }

/// Every kind of scene: open ones, channels, mazes, vessels, one swarm and single robots.
inline const std::vector<WatchedPair>& watched_pairs() {
  static const std::vector<WatchedPair> pairs{
      {"single", "papers/radar/single.yaml", "vortex.yaml"},
      {"s_channel", "papers/drrt/s_channel.yaml", "ribbon.yaml"},
      {"moving", "papers/drrt/moving_obstacles.yaml", "ribbon.yaml"},
      {"deforming", "papers/drrt/deforming_channel.yaml", "ribbon.yaml"},
      {"t_junction", "papers/gather/t_junction.yaml", "rollers.yaml"},
      {"micromaze", "papers/radar/micromaze.yaml", "vortex.yaml"},
      {"twelve",
       "papers/radar/experiment_twelve.yaml",
       "vortex.yaml",
       {"camera.type=simulated", "camera.microscope.um_per_px=10"}},
      {"two_robots", "papers/global/two_robots.yaml", "rollers.yaml"},
      {"vascular", "papers/gather/vascular_network.yaml", "rollers.yaml"}};
  return pairs;
}

/// With these settings of the rig, and of the scenario.
inline rig::RigExperiment opened(const WatchedPair& pair,
                                 std::vector<std::string> rig_settings = {},
                                 const std::vector<std::string>& settings = {}) {
  const std::filesystem::path scenarios =
      std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  rig_settings.insert(rig_settings.begin(), pair.rig_settings.begin(), pair.rig_settings.end());
  return rig::open_rig_experiment(scenarios / pair.scenario, {settings, ""},
                                  scenarios / "rigs" / pair.rig, {rig_settings, ""});
}

}  // namespace microswarm::test

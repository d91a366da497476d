// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/results/metrics.hpp"
#include "microswarm/experiment/run/tick.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// Result of a run.
struct RunResult {
  Status status = Status::time_limit;
  Metrics metrics;
  Timing timing;
  std::string state;  ///< name of the navigator's last state
};

/// Interface for observers of a run: recorder, live view, progress bar. References are valid during
/// the call.
class RunListener {
 public:
  virtual ~RunListener() = default;
  /// Called after every tick; the last one has `end`.
  virtual void on_tick(const Tick& tick) = 0;
  virtual void on_end(const RunResult& result) { (void)result; }
};

/// Calls `step` until it returns null and passes every tick to the listeners. With status `fault`,
/// the plant's reason becomes the result's state.
RunResult run(const Scenario& scenario, const std::function<const Tick*()>& step,
              std::span<RunListener* const> listeners = {});

/// Runs an episode of this plant and navigator.
RunResult run(const Scenario& scenario, Plant& plant, Navigator& navigator,
              std::span<RunListener* const> listeners = {}, const Stop& stop = {});

/// Creates the kinematic simulation of a scenario: one swarm, or individual robots.
std::unique_ptr<Plant> make_kinematic_plant(const Scenario& scenario, const World& world,
                                            std::uint32_t trial = 0);

/// Creates plant and navigator for one trial of a scenario and runs it.
RunResult simulate(const Scenario& scenario, const World& world, std::uint32_t trial = 0,
                   std::span<RunListener* const> listeners = {}, const Stop& stop = {});

}  // namespace microswarm

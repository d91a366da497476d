// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/experiment/run/episode.hpp"
#include "microswarm/experiment/run/operation.hpp"
#include "microswarm/experiment/run/run.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// Keys of a scenario that can be changed during a run, with all keys within them.
std::span<const std::string_view> changeable_keys();

/// One trial of a scenario in progress: plant, navigator and episode. It advances only when
/// stepped, and can be changed between ticks.
class OpenRun {
 public:
  /// Uses the scenario's navigator if `navigator` is null. `trial` selects the random streams.
  OpenRun(Scenario scenario, World world, std::unique_ptr<Plant> plant, std::uint32_t trial = 0,
          std::unique_ptr<Navigator> navigator = nullptr);
  /// Runs in the kinematic simulation.
  OpenRun(const Scenario& scenario, const World& world, std::uint32_t trial = 0);
  ~OpenRun() = default;
  OpenRun(const OpenRun&) = delete;
  OpenRun& operator=(const OpenRun&) = delete;

  /// Same as Episode::step.
  const Tick* step(const Stop& stop = {});
  /// Steps to the end and passes the remaining ticks to the listeners.
  RunResult finish(std::span<RunListener* const> listeners = {}, const Stop& stop = {});

  /// Sets a scenario value from the next tick on, for example "navigator.speed_um_per_s" to "60": a
  /// value of the navigator, which is rebuilt, of the goal, of an obstacle, or a limit of the run.
  /// If there are issues, which have no place, nothing changes. An obstacle may be set onto the
  /// swarm, which is a contact.
  Issues change(const std::string& key, const std::string& value);

  /// Manual operation: pause, steer, end.
  Operation& operation() { return operation_; }

  /// The current scenario with all changes.
  const Scenario& scenario() const { return scenario_; }
  const World& world() const { return world_; }
  Plant& plant() { return *plant_; }
  const Navigator& navigator() const { return *navigator_; }
  /// Whether the navigator is not the scenario's.
  bool has_external_navigator() const { return has_external_navigator_; }

 private:
  std::unique_ptr<Navigator> made() const;

  Scenario scenario_;
  World world_;
  std::uint32_t trial_;
  std::unique_ptr<Plant> plant_;
  bool has_external_navigator_;
  std::unique_ptr<Navigator> navigator_;
  std::unique_ptr<Navigator> last_navigator_;  ///< owner of the plan in the last tick
  Operation operation_;
  Episode episode_;
};

}  // namespace microswarm

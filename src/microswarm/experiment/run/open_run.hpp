// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/core/issue.hpp"
#include "microswarm/experiment/run/episode.hpp"
#include "microswarm/experiment/run/run.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// One trial of a scenario under way: its plant, its navigator and the loop over them. It goes on
/// only when it is stepped, and between two ticks it can be changed.
class OpenRun {
 public:
  /// Without a navigator of the caller's the scenario's is made. `trial` chooses the streams.
  OpenRun(Scenario scenario, World world, std::unique_ptr<Plant> plant, std::uint32_t trial = 0,
          std::unique_ptr<Navigator> navigator = nullptr);
  /// In the simulation without physics.
  OpenRun(const Scenario& scenario, const World& world, std::uint32_t trial = 0);
  ~OpenRun() = default;
  OpenRun(const OpenRun&) = delete;
  OpenRun& operator=(const OpenRun&) = delete;

  /// As Episode::step.
  const Tick* step(const Stop& stop = {});
  /// Steps to the end; the listeners hear every tick from now on.
  RunResult finish(std::span<RunListener* const> listeners = {}, const Stop& stop = {});

  /// Sets a value of the scenario from the next tick on, "navigator.speed_um_per_s=60": of the
  /// navigator, which is made anew, the goal, an obstacle, or a limit of the run. Where there are
  /// issues nothing has changed.
  Issues change(const std::string& setting);

  /// As it is now.
  const Scenario& scenario() const { return scenario_; }
  const World& world() const { return world_; }
  Plant& plant() { return *plant_; }
  const Navigator& navigator() const { return *navigator_; }

 private:
  std::unique_ptr<Navigator> made() const;

  Scenario scenario_;
  World world_;
  std::uint32_t trial_;
  std::unique_ptr<Plant> plant_;
  bool has_external_navigator_;
  std::unique_ptr<Navigator> navigator_;
  std::unique_ptr<Navigator> last_navigator_;  ///< the last tick shows its plan
  Episode episode_;
};

}  // namespace microswarm

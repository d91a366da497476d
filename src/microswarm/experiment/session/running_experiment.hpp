// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/run/episode.hpp"
#include "microswarm/experiment/session/source.hpp"

namespace microswarm::experiment {

/// Keys of a scenario that can be changed during a run, with all keys within them.
std::span<const std::string_view> changeable_keys();

/// One trial of a scenario in progress: plant, navigator and episode. It can be changed between
/// ticks.
class RunningExperiment : public SessionSource {
 public:
  /// Uses the kinematic simulation if `plant` is null and the scenario's navigator if `navigator`
  /// is. `trial` selects the random streams.
  RunningExperiment(Scenario scenario, World world, std::uint32_t trial,
                    std::shared_ptr<Plant> plant, std::shared_ptr<Navigator> navigator);
  ~RunningExperiment() override = default;
  RunningExperiment(const RunningExperiment&) = delete;
  RunningExperiment& operator=(const RunningExperiment&) = delete;

  const Tick* step(const Stop& stop) override;
  /// Sets for example "navigator.speed_um_per_s" to "60": a value of the navigator, which is
  /// rebuilt, of the goal, of an obstacle, or a limit of the run. An obstacle may be set onto the
  /// swarm, which is a contact.
  Issues set(const std::string& key, const std::string& value) override;
  Operation* operation() override { return &operation_; }
  std::vector<Vec2> first_robots() const override;
  const Scenario& scenario() const override { return scenario_; }
  const World& world() const override { return world_; }

 private:
  std::shared_ptr<Navigator> made() const;

  Scenario scenario_;
  World world_;
  std::uint32_t trial_;
  std::shared_ptr<Plant> plant_;
  bool has_external_navigator_;
  std::shared_ptr<Navigator> navigator_;
  std::shared_ptr<Navigator> last_navigator_;  ///< owner of the plan in the last tick
  Operation operation_;
  Episode episode_;
};

}  // namespace microswarm::experiment

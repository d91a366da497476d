// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/run/frame.hpp"
#include "microswarm/experiment/run/metrics.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm {

/// What a run came to.
struct RunResult {
  Status status = Status::time_limit;
  Metrics metrics;
  Timing timing;
  std::string state;  ///< the navigator's word for what it did last
};

/// Hears what happens in a run: recorder, live view, progress bar. References hold during the call.
class RunListener {
 public:
  virtual ~RunListener() = default;
  /// After the command was chosen and before it is applied. `view` tells what the navigator did,
  /// `world` is the world at the frame's time.
  virtual void on_frame(const Frame& frame, const NavigatorView& view, const Snapshot& world) {
    (void)frame, (void)view, (void)world;
  }
  /// Besides on_frame, at the same time: where robots are that are told apart.
  virtual void on_robots(double t, std::span<const Vec2> robots) { (void)t, (void)robots; }
  virtual void on_event(const RunEvent& event) { (void)event; }
  virtual void on_end(const RunResult& result) { (void)result; }
};

/// The only loop: at every tick it observes, asks the navigator, applies the command, and watches,
/// in continuous time, for contact and for the goal; whether robots that are told apart have done
/// their task it looks up at every tick, and walls are no danger to them. Ends with `solved`,
/// `collided`, `held` (the navigator stood still for the scenario's hold limit, or up to its time
/// limit), `time_limit`, `stopped`, or `fault`, with the plant's reason as the result's state.
/// Without the plant's truth, clearances and contacts are those of what was seen.
RunResult run(const Scenario& scenario, Plant& plant, Navigator& navigator,
              std::span<RunListener* const> listeners = {}, const Stop& stop = {});

/// The simulation without physics that a scenario asks for: of one swarm, or of robots.
std::unique_ptr<Plant> make_kinematic_plant(const Scenario& scenario, const World& world,
                                            std::uint32_t trial = 0);

/// Builds plant and navigator for one trial of a scenario and runs it.
RunResult simulate(const Scenario& scenario, const World& world, std::uint32_t trial = 0,
                   std::span<RunListener* const> listeners = {}, const Stop& stop = {});

}  // namespace microswarm

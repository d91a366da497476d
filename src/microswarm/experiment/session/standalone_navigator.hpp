// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/navigation/prediction/body_numbers.hpp"
#include "microswarm/navigation/prediction/obstacle_memory.hpp"

namespace microswarm::experiment {

/// Observation supplied by an external control loop.
struct ExternalObservation {
  double now = 0;                    ///< current time [s]
  double seen = 0;                   ///< capture time of the picture [s], at most `now`
  std::optional<SwarmPose> swarm{};  ///< nothing if no swarm was detected, and for robots
  std::vector<Body> obstacles{};     ///< as detected in the picture
  /// Whether `Body::obstacle` identifies obstacles over all pictures. Otherwise they are matched
  /// with those of earlier pictures by distance.
  bool are_numbered = false;
  /// Index i is the same robot in every picture [µm]; empty if they were not detected.
  std::vector<Vec2> robots{};
  int unseen = 0;  ///< number of robots not detected, at expected positions
};

/// The navigator of a scenario in the caller's loop: it maps the detections of a camera to the
/// command for the coils. It uses map, swarm or robots, goal, navigator, tick, the memory of
/// obstacles and the seed of the scenario, but not its obstacles.
///
///     StandaloneNavigator navigator(open_experiment("chip.yaml"));
///     for (;;) drive(navigator.step(look()));
class StandaloneNavigator {
 public:
  explicit StandaloneNavigator(Experiment experiment, std::uint32_t trial = 0);

  /// The command from `given.now` on. The first step prepares the navigator, which may take longer.
  /// Throws InputError and remains unchanged for a number that is not finite or out of range, for a
  /// time before that of the previous step, and for another number of robots.
  Command step(const ExternalObservation& given, const Stop& stop = {});
  /// Whether the first step was made.
  bool is_prepared() const { return is_prepared_; }
  /// Target and state of the navigator; valid until the next step.
  NavigatorView view() const { return navigator_->view(); }
  const Scenario& scenario() const { return experiment_.scenario(); }
  const Map& map() const { return *experiment_.world.map; }

 private:
  void check(const ExternalObservation& given) const;

  Experiment experiment_;
  std::unique_ptr<Navigator> navigator_;
  navigation::BodyNumbers numbers_;
  navigation::ObstacleMemory memory_;
  std::optional<double> last_;  ///< time of the last step [s]
  Command command_;             ///< command of the last step
  std::size_t robots_ = 0;
  bool is_prepared_ = false;
};

}  // namespace microswarm::experiment

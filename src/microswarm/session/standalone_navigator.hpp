// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/navigation/prediction/obstacle_memory.hpp"
#include "microswarm/rig/perception/body_numbers.hpp"

namespace microswarm {

/// What a loop outside of this library sees at one time.
struct ExternalObservation {
  double now = 0;                  ///< the present [s]
  double seen = 0;                 ///< when the picture was taken [s], at most `now`
  std::optional<SwarmPose> swarm;  ///< nothing if no swarm was found, and for robots
  std::vector<Body> obstacles;     ///< as the picture shows them
  /// Whether `Body::obstacle` tells which obstacles are the same in all pictures. Otherwise they
  /// are matched with those of the pictures before, by distance.
  bool are_numbered = false;
  /// Robot i is the same in every picture [µm]; none if they were not found.
  std::vector<Vec2> robots;
  int unseen = 0;  ///< of the robots, which are where they are expected
};

/// The navigator of a scenario in a loop of the caller's own: in go what its camera sees, out comes
/// the command for its coils. Of the scenario it uses map, swarm or robots, goal, navigator, tick,
/// the memory of obstacles and the seed; its obstacles are not used.
///
///     StandaloneNavigator navigator(open_experiment("chip.yaml"));
///     for (;;) drive(navigator.step(look()));
class StandaloneNavigator {
 public:
  explicit StandaloneNavigator(Experiment experiment, std::uint32_t trial = 0);

  /// The command from `given.now` on. The first step prepares the navigator, which may take longer.
  /// Throws InputError, and is as it was, for a number that is not finite or outside of its range,
  /// for a time before that of the step before, and for another number of robots.
  Command step(const ExternalObservation& given, const Stop& stop = {});
  /// Whether the first step was made.
  bool is_prepared() const { return is_prepared_; }
  /// What the navigator heads for, and how it is; valid until the next step.
  NavigatorView view() const { return navigator_->view(); }
  const Scenario& scenario() const { return experiment_.scenario(); }
  const Map& map() const { return *experiment_.world.map; }

 private:
  void check(const ExternalObservation& given) const;

  Experiment experiment_;
  std::unique_ptr<Navigator> navigator_;
  BodyNumbers numbers_;
  ObstacleMemory memory_;
  std::optional<double> last_;  ///< time of the last step [s]
  Command command_;             ///< of the last step
  std::size_t robots_ = 0;
  bool is_prepared_ = false;
};

}  // namespace microswarm

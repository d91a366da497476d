// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/environments/environment_step.hpp"
#include "microswarm/environments/navigation/navigation_rules.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace microswarm::environments {

/// A scenario of one swarm with the rules of its environment.
class NavigationTask {
 public:
  /// Throws InputError if the scenario has several robots.
  NavigationTask(experiment::Experiment experiment, const NavigationRules& rules);

  const experiment::Scenario& scenario() const { return experiment_.scenario(); }
  const World& world() const { return experiment_.world; }
  const NavigationRules& rules() const { return rules_; }
  /// Maximum speed of the swarm [µm/s].
  double max_speed() const { return max_speed_; }
  /// Numbers of an observation: goal_x, goal_y from the swarm [µm], cosine and sine of the heading,
  /// speed [µm/s], radius [µm]; the free distance in each direction from the first, along x,
  /// counter-clockwise [µm]; of each of the nearest obstacles x, y from the swarm, radius [µm],
  /// velocity in x and y [µm/s], zeros where there are fewer. With `scaled` all are from -1 to 1:
  /// free distances are divided by ray_range and the speed by the maximum; a length d, as well as
  /// the length of an offset, becomes d / (d + ray_range), an obstacle's speed v / (v + maximum).
  std::size_t observation_size() const;
  /// Approximate upper bound of an episode's memory besides its observation [B].
  std::size_t episode_bytes() const;
  static constexpr std::size_t own_numbers = 6;
  static constexpr std::size_t obstacle_numbers = 5;

 private:
  experiment::Experiment experiment_;
  NavigationRules rules_;
  double max_speed_;
};

/// Heading [rad] and speed [µm/s] of an agent's input.
using NavigationAction = Command;

/// State of a navigation, from which it continues identically: the inputs of an episode.
struct NavigationState {
  std::uint64_t seed = 0;
  std::uint32_t trial = 0;
  std::vector<NavigationAction> actions{};
};

/// Episodes of a scenario, one after the other, steered from outside. Episode k of a seed has the
/// random streams of trial k.
class NavigationEpisode {
 public:
  /// `observation` has observation_size() numbers; it and the task must outlive this object.
  NavigationEpisode(const NavigationTask& task, std::uint64_t seed, std::span<float> observation);
  /// A navigation in the state of `other`, which it reaches by the same inputs.
  NavigationEpisode(const NavigationEpisode& other, std::span<float> observation);
  ~NavigationEpisode();
  NavigationEpisode(NavigationEpisode&&) noexcept;
  NavigationEpisode(const NavigationEpisode&) = delete;
  NavigationEpisode& operator=(const NavigationEpisode&) = delete;
  NavigationEpisode& operator=(NavigationEpisode&&) = delete;

  void reset(std::uint64_t seed);
  void reset();
  /// Advances one tick of the scenario; has no effect after the end of an episode.
  EnvironmentStep step(const NavigationAction& action);
  NavigationState state() const;
  /// Plays the episode of a state again; returns its last step. Throws InputError for an input that
  /// is not finite or faster than the swarm.
  EnvironmentStep restore(const NavigationState& state);

  /// Time since the start of the episode [s].
  double time() const { return time_; }
  const Pose2& pose() const { return pose_; }
  /// Radius of the swarm [µm].
  double radius() const { return radius_; }
  Vec2 goal() const { return goal_; }
  /// Walls and obstacles now.
  Snapshot world() const;
  /// `running`, or the final status of the episode.
  Status status() const { return status_; }

 private:
  class Agent;
  EnvironmentStep advance();
  void look(const experiment::Tick* tick);
  void see_rays(const Snapshot& world, std::span<float> out) const;
  void see_obstacles(const Snapshot& world, std::span<float> out) const;
  void scale_observation() const;

  const NavigationTask& task_;
  std::uint64_t seed_;
  std::uint32_t trial_ = 0;
  std::span<float> observation_;
  std::shared_ptr<Plant> plant_;
  std::shared_ptr<Agent> agent_;
  std::unique_ptr<experiment::Session> session_;
  Vec2 goal_;
  Pose2 pose_;
  double radius_ = 0;
  std::vector<NavigationAction> actions_;
  double time_ = 0;
  double start_distance_ = 1;
  double distance_ = 0;
  Status status_ = Status::running;
  bool cut_ = false;  ///< whether it has ended by a limit
};

}  // namespace microswarm::environments

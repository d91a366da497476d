// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/plant/plant.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/experiment/session/replay.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "tests/runs.hpp"

namespace microswarm::experiment {

/// Drives straight at the goal, whatever is in the way.
class GoStraight : public Navigator {
 public:
  GoStraight(Vec2 goal, double speed) : goal_(goal), speed_(speed) {}
  Command step(const Observation& seen, const Stop&) override {
    if (!seen.swarm) return {};
    path_ = {seen.swarm->pose.position, goal_};
    return {heading_along(goal_ - seen.swarm->pose.position), speed_};
  }
  NavigatorView view() const override {
    return {.planned = false,
            .state = NavigatorState::follow,
            .local_target = goal_,
            .path = path_,
            .plan = {}};
  }

 private:
  Vec2 goal_;
  double speed_;
  std::vector<Vec2> path_;
};

/// Always the same command.
class Steady : public Navigator {
 public:
  explicit Steady(Command command) : command_(command) {}
  Command step(const Observation&, const Stop&) override { return command_; }
  NavigatorView view() const override {
    return {.planned = false,
            .state = NavigatorState::follow,
            .local_target = {},
            .path = {},
            .plan = nullptr};
  }

 private:
  Command command_;
};

inline Obstacle disc(double radius, Motion motion) {
  return {DiscShape{radius}, std::move(motion)};
}

/// An open room of 2000 × 1000 µm, from left to right, nothing in it.
inline Scenario open_room() {
  Scenario scenario;
  scenario.name = "open room";
  scenario.map = formats::PolygonsMap{.lo = {0, 0}, .hi = {2000, 1000}, .walls = {}, .discs = {}};
  scenario.start = Pose2{{200, 500}, 0};
  scenario.goal = Vec2{1800, 500};
  std::get<RibbonParams>(scenario.swarm).max_speed = 60;
  scenario.time_limit = 60;
  return scenario;
}

/// The room with a wall to go round and two discs that move.
inline Scenario small_flight() {
  Scenario scenario = open_room();
  scenario.name = "small flight";
  std::get<formats::PolygonsMap>(scenario.map).walls = {
      {{950, 0}, {1050, 0}, {1050, 450}, {950, 450}}};
  scenario.obstacles = {
      disc(60, HarmonicLine{.centre = {600, 500}, .amplitude = {0, 250}, .period = 40}),
      disc(50, HarmonicLine{.centre = {1400, 500}, .amplitude = {150, 0}, .period = 40})};
  std::get<RibbonParams>(scenario.swarm).position_noise = 2;
  scenario.sensing.position_noise = 3;
  return scenario;
}

inline World world_of(const Scenario& scenario) { return build_world(load_scene(scenario, {})); }

/// Runs one trial in the world of the scenario and keeps it.
inline Record record_of(const Scenario& scenario, std::uint32_t trial = 0) {
  return test::record_of(load_scene(scenario, {}), {.trial = trial});
}

/// A folder of its own for a test, empty. Tests of one fixture may run in several processes.
inline std::filesystem::path empty_folder(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) /
                      ("microswarm_" + name + "_" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// What the InputError says that `action` throws; empty when it throws none.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// What is wrong with a scenario by its file's name; empty when nothing is.
inline std::string check_error(const Scenario& scenario) {
  return error_of(
      [&] { KeyLocations("s.yaml").require_none(validate(scenario, world_of(scenario))); });
}

}  // namespace microswarm::experiment

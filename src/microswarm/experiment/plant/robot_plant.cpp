// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/plant/robot_plant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/planning/exact/distance_field.hpp"

namespace microswarm::experiment {

namespace {

RobotSwarm make_swarm(const Scenario& scenario, const Map& map, std::uint32_t trial, Rng& rng) {
  const std::vector<Vec2> starts = robot_starts(scenario, map, trial);
  return {*scenario.robots, RobotStepper(map, scenario.robots->max_speed * scenario.tick), starts,
          rng};
}

}  // namespace

std::vector<Vec2> robot_starts(const Scenario& scenario, const Map& map, std::uint32_t trial) {
  if (scenario.robots->count == 0) return scenario.robots->starts;
  const auto count = static_cast<std::size_t>(scenario.robots->count);
  planning::DistanceField field = planning::DistanceField::over(map, *scenario.goal, 512);
  const double guard = RobotStepper(map, scenario.robots->max_speed * scenario.tick).guard();
  const Box& box = map.bounds();
  Rng rng(scenario.seed, Purpose::scene, trial);
  std::vector<Vec2> positions;
  for (std::size_t draw = 0; draw < 100'000 + 1000 * count && positions.size() < count; ++draw) {
    const Vec2 p = uniform_in(box, rng);
    if (field.reaches(p) && map.is_free(p, 4 * guard)) positions.push_back(p);
  }
  if (positions.size() < count)
    throw InputError(fmt::format("found {} places from which the goal is reached, for {} robots",
                                 positions.size(), count));
  return positions;
}

RobotPlant::RobotPlant(const Scenario& scenario, World world, std::uint32_t trial)
    : world_(std::move(world)),
      walls_(std::make_shared<const Snapshot>(world_.at(0))),
      sensing_(scenario.sensing),
      motion_(scenario.seed, Purpose::plant, trial),
      noise_(scenario.seed, Purpose::sensor, trial),
      dropouts_(sensing_.missed_share, sensing_.missed_time),
      swarm_(make_swarm(scenario, *world_.map, trial, motion_)) {
  history_.push_back({0, swarm_.robots().positions()});
}

Observation RobotPlant::observe() {
  Observation observation{.now = now_,
                          .seen = std::max(0.0, now_ - sensing_.observation_delay),
                          .swarm = {},
                          .robots = {},
                          .world = walls_};
  if (dropouts_.miss(0, now_ - std::exchange(observed_, now_), noise_)) return observation;
  seen_ = robots_at(std::max(0.0, now_ - sensing_.age()));
  if (sensing_.position_noise > 0)
    for (Vec2& p : seen_) {
      const double dx = noise_.normal();
      p += sensing_.position_noise * Vec2{dx, noise_.normal()};
    }
  observation.robots = seen_;
  observation.swarm = enclosing_pose(seen_, command_.heading);
  return observation;
}

void RobotPlant::apply(const Command& command, double dt) {
  swarm_.step(command, dt, motion_);
  command_ = command;
  now_ += dt;
  history_.push_back({now_, swarm_.robots().positions()});
  while (history_.size() > 1 && history_[1].t <= now_ - sensing_.age()) history_.pop_front();
}

std::optional<GroundTruth> RobotPlant::ground_truth() const {
  const std::vector<Vec2>& robots = history_.back().robots;
  return GroundTruth{.now = now_,
                     .swarm = enclosing_pose(robots, command_.heading),
                     .speed = command_.speed,
                     .trajectory = {},
                     .robots = robots,
                     .world = &world_};
}

std::vector<Vec2> RobotPlant::robots_at(double t) const {
  const auto after = std::find_if(history_.begin(), history_.end(),
                                  [t](const Moment& moment) { return moment.t >= t; });
  if (after == history_.end()) return history_.back().robots;
  if (after == history_.begin() || after->t == t) return after->robots;
  const Moment& before = *std::prev(after);
  const double share = (t - before.t) / (after->t - before.t);
  std::vector<Vec2> robots = before.robots;
  for (std::size_t i = 0; i < robots.size(); ++i)
    robots[i] += share * (after->robots[i] - robots[i]);
  return robots;
}

}  // namespace microswarm::experiment

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/running_experiment.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/plant/make_plant.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/navigation/make.hpp"

namespace microswarm::experiment {
namespace {

constexpr std::array<std::string_view, 8> changeable{
    "navigator",    "goal_um",      "goal_tolerance_um", "obstacles",
    "time_limit_s", "hold_limit_s", "hold_at_goal_s",    "stop_at_contact"};

double swarm_max_speed(const Scenario& scenario) {
  return scenario.robots ? scenario.robots->max_speed : swarm_limits(scenario.swarm).max_speed;
}

/// Whether the model file changes; model files are read only when the scenario is opened.
bool names_another_model(const Scenario& a, const Scenario& b) {
  const navigation::FollowerParams* first = navigation::find_follower(a.navigator);
  const navigation::FollowerParams* second = navigation::find_follower(b.navigator);
  return second && !second->model.empty() && (!first || first->model != second->model);
}

/// Issues of a scenario after a change of `key` with the swarm at `pose`.
Issues validate_change(Scenario scenario, const World& world, std::string_view key, Pose2 pose) {
  Issues issues;
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
    issues.add_within("obstacles." + std::to_string(i), validate(scenario.obstacles[i]),
                      "obstacle " + std::to_string(i + 1));
  if (scenario.start) scenario.start = pose;
  const World walls{world.map, {}};
  for (Issue issue : validate(scenario, walls)) {
    std::erase_if(issue.keys, [&](const std::string& other) { return !is_in_key(other, key); });
    if (!issue.keys.empty()) issues.add(std::move(issue));
  }
  return issues;
}

}  // namespace

std::span<const std::string_view> changeable_keys() { return changeable; }

RunningExperiment::RunningExperiment(Scenario scenario, World world, std::uint32_t trial,
                                     std::shared_ptr<Plant> plant,
                                     std::shared_ptr<Navigator> navigator)
    : scenario_(std::move(scenario)),
      world_(std::move(world)),
      trial_(trial),
      plant_(plant ? std::move(plant) : make_kinematic_plant(scenario_, world_, trial)),
      has_external_navigator_(navigator != nullptr),
      navigator_(navigator ? std::move(navigator) : made()),
      operation_(swarm_max_speed(scenario_)),
      episode_(scenario_, *plant_, *navigator_, &operation_) {}

std::shared_ptr<Navigator> RunningExperiment::made() const {
  return navigation::make_navigator(scenario_.navigator, navigation_task(scenario_),
                                    Rng(scenario_.seed, Purpose::planner, trial_));
}

std::vector<Vec2> RunningExperiment::first_robots() const {
  const auto truth = plant_->ground_truth();
  if (!truth) return {};
  return {truth->robots.begin(), truth->robots.end()};
}

const Tick* RunningExperiment::step(const Stop& stop) {
  const Tick* tick = episode_.step(stop);
  last_navigator_.reset();
  return tick;
}

Issues RunningExperiment::set(const std::string& wanted_key, const std::string& value) {
  Issues issues;
  if (episode_.over()) {
    issues.add({}, "the run has ended");
    return issues;
  }
  Scenario changed = scenario_;
  Setting setting{wanted_key, value};
  Issues misread;
  try {
    Notes notes;
    const auto present = set_value(changed, setting, "", notes);
    if (!present) return issues;
    setting = *present;
  } catch (const InputError& error) {
    misread = error.issues();
  }
  const std::string key = setting.key.substr(0, setting.key.find('.'));
  if (std::ranges::find(changeable, key) == changeable.end())
    issues.add(key, key + " cannot be changed while the experiment runs");
  if ((wanted_key + value).find_first_of("\n\r") != std::string::npos)
    issues.add(key, key + " is set in more than one line");
  const bool steers_anew = key == "navigator" || key == "goal_um" || key == "goal_tolerance_um";
  if (steers_anew && has_external_navigator_)
    issues.add(key, "an external navigator cannot take another " + key);
  if (issues.empty()) issues = misread.unplaced();
  if (!issues.empty()) return issues;

  if (names_another_model(scenario_, changed))
    issues.add(key, "a model of a learned follower cannot be read while the experiment runs");
  else
    issues = validate_change(changed, world_, key, episode_.pose());
  if (key == "obstacles" && issues.empty() && !plant_->set_obstacles(changed.obstacles))
    issues.add(key, "the obstacles of this plant cannot be changed");
  if (!issues.empty()) return issues;

  scenario_ = std::move(changed);
  world_.obstacles = scenario_.obstacles;
  if (steers_anew) {
    std::shared_ptr<Navigator> next = made();
    episode_.change(to_string(setting), *next);
    if (!last_navigator_) last_navigator_ = std::move(navigator_);
    navigator_ = std::move(next);
  } else {
    episode_.change(to_string(setting), *navigator_);
  }
  return issues;
}

}  // namespace microswarm::experiment

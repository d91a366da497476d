// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/rig_errors.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "microswarm/experiment/monitors/goal_monitor.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"

namespace microswarm::rig {
namespace {

/// Share of the goal's tolerance by which the noise of the pictures may mislead.
constexpr double arrival_slack = 0.1;

/// A simulated rig that notes how far what it shows is from the truth.
class ComparedRig : public Plant {
 public:
  ComparedRig(const RigExperiment& on, std::uint32_t trial)
      : rig_(on.scenario(), on.experiment.world, on.rig, trial) {}

  Observation observe() override {
    const Observation shown = rig_.observe();
    const std::optional<SwarmPose>& swarm = rig_.detections().swarm;
    // Only a swarm in one body: robots are seen as they are, or not at all.
    if (swarm && rig_.detections().robots.empty())
      position_error_ =
          std::max(position_error_,
                   distance(swarm->pose.position, rig_.ground_truth()->swarm.pose.position));
    return shown;
  }
  void apply(const Command& command, double dt) override { rig_.apply(command, dt); }
  bool set_obstacles(const std::vector<Obstacle>& obstacles) override {
    return rig_.set_obstacles(obstacles);
  }
  std::string_view fault() const override { return rig_.fault(); }
  std::optional<GroundTruth> ground_truth() const override { return rig_.ground_truth(); }

  SimulatedRig& rig() { return rig_; }
  double position_error() const { return position_error_; }

 private:
  SimulatedRig rig_;
  double position_error_ = 0;
};

/// True distance to the goal, measured as a run measures it [µm].
double true_goal_distance(const experiment::Scenario& scenario, const GroundTruth& truth) {
  experiment::GoalMonitor goal(scenario);
  goal.take_goal(truth.swarm.pose.position);
  goal.take_robots(*truth.world->map);
  return goal.left(truth.swarm.pose.position, truth.robots);
}

}  // namespace

std::span<const RigError> rig_errors() {
  static const std::array<RigError, 13> errors{{
      {"none"},
      {"20 % slower", {"camera.speed_error=-0.2"}},
      {"20 % faster", {"camera.speed_error=0.2"}},
      {"half speed", {"camera.speed_error=-0.5"}},
      {"100 ms late", {"camera.delay_error_s=0.1"}},
      {"moves 5° aside", {"camera.direction_error_deg=5"}},
      {"scale 2 %", {"camera.microscope.scale_error=0.02"}},
      {"camera turned 5°", {"camera.microscope.turn_deg=5"}},
      {"camera 8 px off", {"camera.microscope.shift_px=[8, 0]"}},
      {"bump of 8 px after 5 s",
       {"camera.microscope.shift_px=[8, 0]", "camera.microscope.moved_after_s=5"}},
      {"light 40 %, 5 s",
       {"camera.microscope.light_drift=0.4", "camera.microscope.light_period_s=5"}},
      {"frozen after 5 s", {"camera.microscope.frozen_after_s=5"}},
      {"all, small",
       {"camera.speed_error=-0.2", "camera.delay_error_s=0.1", "camera.direction_error_deg=3",
        "camera.microscope.scale_error=0.02"}},
  }};
  return errors;
}

RigTrial run_on_rig(const RigExperiment& on, std::uint32_t trial, const Stop& stop) {
  const auto plant = std::make_shared<ComparedRig>(on, trial);
  RigTrial out{.result = experiment::simulate(on.scenario(), on.experiment.world,
                                              {.trial = trial, .plant = plant}, {}, stop),
               .fault = std::string(plant->fault()),
               .notes = plant->rig().take_notes(),
               .position_error = plant->position_error(),
               .min_scale = plant->rig().min_scale()};
  out.goal_distance = true_goal_distance(on.scenario(), *plant->ground_truth());
  out.arrived = out.goal_distance <= (1 + arrival_slack) * on.scenario().goal_tolerance;
  return out;
}

RigErrorRow error_row(const RigTrial& trial, int number, const std::string& scenario,
                      const RigError& error) {
  return {.scenario = scenario,
          .error = std::string(error.name),
          .trial = number,
          .status = trial.result.status,
          .arrived = trial.arrived,
          .time = trial.result.metrics.time,
          .contacts = static_cast<int>(trial.result.metrics.contacts),
          .goal_distance = trial.goal_distance,
          .position_error = trial.position_error,
          .fault = trial.fault,
          .note = trial.notes.empty() ? std::string() : trial.notes.front()};
}

}  // namespace microswarm::rig

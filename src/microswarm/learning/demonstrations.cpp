// SPDX-License-Identifier: Apache-2.0
#include "microswarm/learning/demonstrations.hpp"

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/plant/plant.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/learning/follower_expert.hpp"
#include "microswarm/navigation/following/follower_model.hpp"
#include "microswarm/navigation/following/path_follower.hpp"
#include "microswarm/navigation/steering/steering_cycle.hpp"

namespace microswarm {
namespace {

/// Beyond this angle answers are near the jump from π to −π, which no network can learn [rad].
constexpr double max_off_path = 2.5;

/// Computes the features of a learned follower and queries the expert.
class Demonstrator : public Navigator {
 public:
  Demonstrator(const FollowerTask& task, const Scenario& scenario, const Plant& plant,
               bool expert_drives)
      : plant_(plant),
        path_(task.path),
        params_(std::get<PathNavigatorParams>(scenario.navigator)),
        steering_(limits_of(scenario.swarm), params_.speed, *scenario.goal, scenario.goal_tolerance,
                  scenario.sensing.frame_timeout),
        follower_(params_.follower, steering_.swarm()),
        expert_(std::get<RibbonParams>(scenario.swarm), path_, params_.speed),
        expert_drives_(expert_drives) {}

  Command step(const Observation& seen, const Stop&) override {
    const Command wanted = expert_.command(plant_.ground_truth()->swarm.pose, seen.now);
    if (steering_.sees_swarm(seen)) follower_.update(seen, steering_.compensator());
    const Pose2* pose = steering_.observe(seen);
    const Command command = pose ? drive(*pose, wanted) : steering_.hold();
    expert_.note(seen.now, command);
    return command;
  }
  NavigatorView view() const override { return steering_.view(); }

  std::vector<Demonstration> shown;

 private:
  Command drive(const Pose2& pose, const Command& wanted) {
    const FollowerFeatures features =
        features_of(follower_.query(path_, place_, pose, params_.speed));
    const double off = wrap(wanted.heading - features.bearing);
    if (std::abs(off) < max_off_path)
      shown.push_back({features.features, {off, wanted.speed / params_.speed}});
    if (expert_drives_) return steering_.command(wanted, NavigatorState::follow);
    const auto next =
        follower_.command(path_, place_, pose, params_.lookahead, params_.speed).command;
    return steering_.command(next, NavigatorState::follow);
  }

  const Plant& plant_;
  const std::vector<Vec2>& path_;
  PathNavigatorParams params_;
  SteeringCycle steering_;
  PathFollower follower_;
  FollowerExpert expert_;
  PathPlace place_;
  bool expert_drives_;
};

}  // namespace

std::vector<Demonstration> demonstrate(const FollowerTask& task,
                                       const std::shared_ptr<const FollowerModel>& student,
                                       const Stop& stop) {
  FollowerParams follower{.kind = FollowerKind::learned, .loaded = student};
  const Scenario scenario = with_follower(task, follower, 0.3);
  const auto plant = std::make_shared<KinematicPlant>(scenario, task.world, task.number);
  const auto demonstrator =
      std::make_shared<Demonstrator>(task, scenario, *plant, student == nullptr);
  simulate(scenario, task.world, {.plant = plant, .navigator = demonstrator}, {}, stop);
  return std::move(demonstrator->shown);
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/learning/demonstrations.hpp"

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/plant/plant.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/learning/follower_expert.hpp"
#include "microswarm/navigation/following/follower_model.hpp"
#include "microswarm/navigation/following/path_follower.hpp"
#include "microswarm/navigation/steering/steering_navigator.hpp"

namespace microswarm::learning {
namespace {

/// Beyond this angle answers are near the jump from π to −π, which no network can learn [rad].
constexpr double max_off_path = 2.5;

/// Computes the features of a learned follower and queries the expert.
class Demonstrator : public navigation::SteeringNavigator {
 public:
  Demonstrator(const FollowerTask& task, const experiment::Scenario& scenario, const Plant& plant,
               bool expert_drives)
      : navigation::SteeringNavigator(
            experiment::navigation_task(scenario),
            std::get<navigation::PathNavigatorParams>(scenario.navigator).speed),
        plant_(plant),
        path_(task.path),
        params_(std::get<navigation::PathNavigatorParams>(scenario.navigator)),
        follower_(params_.follower, swarm()),
        expert_(std::get<RibbonParams>(scenario.swarm), path_, params_.speed),
        expert_drives_(expert_drives) {}

  std::vector<Demonstration> shown;

 private:
  void update(const Observation& seen, const Stop&) override {
    wanted_ = expert_.command(plant_.ground_truth()->swarm.pose, seen.now);
    if (sees_swarm(seen)) follower_.update(seen, compensator());
  }
  navigation::Decision decide(const Moment& moment) override {
    const navigation::FollowerFeatures features =
        navigation::to_features(follower_.query(path_, position_, moment.pose, params_.speed));
    const double off = wrap(wanted_.heading - features.bearing);
    if (std::abs(off) < max_off_path)
      shown.push_back({features.features, {off, wanted_.speed / params_.speed}});
    if (expert_drives_) return {wanted_, NavigatorState::follow};
    return {
        follower_.command(path_, position_, moment.pose, params_.lookahead, params_.speed).command,
        NavigatorState::follow};
  }
  navigation::Decision finish(const navigation::Decision& decision,
                              const Observation& seen) override {
    expert_.note(seen.now, decision.command);
    return decision;
  }

  const Plant& plant_;
  const std::vector<Vec2>& path_;
  navigation::PathNavigatorParams params_;
  navigation::PathFollower follower_;
  FollowerExpert expert_;
  navigation::PathPosition position_;
  bool expert_drives_;
  Command wanted_;  ///< the expert's
};

}  // namespace

std::vector<Demonstration> demonstrate(
    const FollowerTask& task, const std::shared_ptr<const navigation::FollowerModel>& student,
    const Stop& stop) {
  navigation::FollowerParams follower{.kind = navigation::FollowerKind::learned, .loaded = student};
  const experiment::Scenario scenario = with_follower(task, follower, 0.3);
  const auto plant =
      std::make_shared<experiment::KinematicPlant>(scenario, task.world, task.number);
  const auto demonstrator =
      std::make_shared<Demonstrator>(task, scenario, *plant, student == nullptr);
  experiment::simulate(scenario, task.world, {.plant = plant, .navigator = demonstrator}, {}, stop);
  return std::move(demonstrator->shown);
}

}  // namespace microswarm::learning

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/make.hpp"

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/navigation/baselines/potential_field.hpp"
#include "microswarm/navigation/baselines/straight.hpp"
#include "microswarm/navigation/baselines/velocity_obstacle.hpp"
#include "microswarm/navigation/following/path_navigator.hpp"
#include "microswarm/navigation/gathering/aggregation_navigator.hpp"
#include "microswarm/navigation/global_input/plan_executor.hpp"
#include "microswarm/navigation/hierarchical/hierarchical.hpp"
#include "microswarm/navigation/predictive/predictive.hpp"
#include "microswarm/navigation/radar/radar.hpp"

namespace microswarm {
namespace {

using Made = std::unique_ptr<Navigator>;

/// A navigator that is not made below would otherwise be taken for its base.
template <class Forgotten>
Made make(const Forgotten& params, const Task& task, Rng rng) = delete;

Made make(const HierarchicalParams& p, const Task& task, Rng rng) {
  return std::make_unique<HierarchicalNavigator>(p, task.swarm, *task.goal, task.goal_tolerance,
                                                 rng, task.frame_timeout);
}

Made make(const PlanExecutorParams& p, const Task& task, Rng rng) {
  return std::make_unique<PlanExecutor>(p, *task.robots, task.goal_tolerance, task.tick, rng,
                                        task.frame_timeout);
}

Made make(const AggregationParams& p, const Task& task, Rng rng) {
  return std::make_unique<AggregationNavigator>(p, *task.robots, *task.goal, task.goal_tolerance,
                                                task.tick, rng, task.frame_timeout);
}

Made make(const RadarParams& p, const Task& task, Rng rng) {
  return std::make_unique<RadarNavigator>(p, task.swarm, *task.goal, task.goal_tolerance, rng,
                                          task.frame_timeout);
}

Made make(const StraightParams& p, const Task& task, Rng) {
  return std::make_unique<StraightNavigator>(p, task.swarm, *task.goal, task.goal_tolerance,
                                             task.frame_timeout);
}

Made make(const PotentialFieldParams& p, const Task& task, Rng) {
  return std::make_unique<PotentialFieldNavigator>(p, task.swarm, *task.goal, task.goal_tolerance,
                                                   task.frame_timeout);
}

Made make(const VelocityObstacleParams& p, const Task& task, Rng) {
  return std::make_unique<VelocityObstacleNavigator>(p, task.swarm, *task.goal, task.goal_tolerance,
                                                     task.frame_timeout);
}

Made make(const PredictiveParams& p, const Task& task, Rng rng) {
  return std::make_unique<PredictiveNavigator>(p, task.swarm, *task.goal, task.goal_tolerance, rng,
                                               task.frame_timeout);
}

Made make(const PathNavigatorParams& p, const Task& task, Rng) {
  return std::make_unique<PathNavigator>(p, task.swarm, *task.goal, task.goal_tolerance,
                                         task.frame_timeout);
}

}  // namespace

std::string_view unsupported_reason(const NavigatorParams& params, const Task& task) {
  return std::visit(
      Overloaded{
          [&](const OneOf<HierarchicalParams, RadarParams, StraightParams, PotentialFieldParams,
                          VelocityObstacleParams, PredictiveParams, PathNavigatorParams> auto&)
              -> std::string_view {
            if (task.robots) return "a swarm that is one body: it cannot steer robots one by one";
            return task.goal ? "" : "a goal";
          },
          [&](const PlanExecutorParams&) -> std::string_view {
            return task.robots && !task.robots->goals.empty() ? "" : "robots with a goal each";
          },
          [&](const AggregationParams&) -> std::string_view {
            if (!task.robots) return "robots";
            if (task.robots->contact != ContactRule::stop) return "robots that stop at walls";
            return task.goal ? "" : "one goal for all robots";
          }},
      params);
}

Issues validate(const NavigatorParams& params, const Task& task, const Map& map,
                const IsGiven& is_given) {
  return std::visit(
      Overloaded{
          [&](const HierarchicalParams& p) { return validate(p, is_given); },
          [&](const RadarParams& p) { return validate(p, task.swarm, map, is_given); },
          [](const OneOf<AggregationParams, PredictiveParams> auto& p) { return validate(p); },
          [](const OneOf<PlanExecutorParams, StraightParams, PotentialFieldParams,
                         VelocityObstacleParams, PathNavigatorParams> auto&) { return Issues(); }},
      params);
}

std::unique_ptr<Navigator> make_navigator(const NavigatorParams& params, const Task& task,
                                          Rng rng) {
  return std::visit([&](const auto& p) { return make(p, task, rng); }, params);
}

}  // namespace microswarm

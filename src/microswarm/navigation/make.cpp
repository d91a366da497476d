// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/make.hpp"

#include <fmt/format.h>

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

template <class OneBody>
std::string_view missing_requirement(const OneBody&, const Task& task) {
  if (task.robots) return "a swarm that is one body: it cannot steer robots one by one";
  return task.goal ? "" : "a goal";
}

std::string_view missing_requirement(const PlanExecutorParams&, const Task& task) {
  return task.robots && !task.robots->goals.empty() ? "" : "robots with a goal each";
}

std::string_view missing_requirement(const AggregationParams&, const Task& task) {
  if (!task.robots) return "robots";
  if (task.robots->contact != ContactRule::stop) return "robots that stop at walls";
  return task.goal ? "" : "one goal for all robots";
}

// Waypoints must be positions that the swarm can occupy.
Issues validate(const RadarParams& p, const Task& task, const Map& map, const IsGiven& is_given) {
  Issues issues = validate(p, is_given);
  issues.add(validate_step(p, task.swarm));
  const Snapshot walls = Snapshot::of(map);
  for (std::size_t i = 0; i < p.waypoints.size(); ++i)
    if (const auto why = walls.blocked_reason(p.waypoints[i], task.swarm.radius); !why.empty())
      issues.add(fmt::format("waypoints_um.{}", i), fmt::format("waypoint {} {}", i + 1, why));
  return issues;
}
/// An issue if a list without which nothing can be chosen is empty.
template <class Value>
void require_values(const std::vector<Value>& values, const char* key, Issues& issues) {
  if (values.empty()) issues.add(key, fmt::format("{} is empty, must have a value", key));
}

Issues validate(const HierarchicalParams& p, const Task&, const Map&, const IsGiven& is_given) {
  Issues issues = validate(p, is_given);
  const std::vector<double>& waits = p.tuning.wait_times;
  require_values(p.tuning.speed_shares, "tuning.speed_shares", issues);
  if (waits.empty() || waits.front() != 0 || !std::ranges::is_sorted(waits))
    issues.add("tuning.wait_times_s", "tuning.wait_times_s must ascend from 0");
  return issues;
}
/// An issue if the value of the first key is not less than that of the second.
void require_less(double a, double b, std::string_view first, std::string_view second,
                  Issues& issues) {
  constexpr std::string_view group = "prediction.tuning";
  if (a < b) return;
  issues.add(fmt::format("{}.{}", group, first),
             fmt::format("{0}.{1} must be less than {0}.{2}", group, first, second));
}

Issues validate(const MultiModelPredictorTuning& p) {
  Issues issues;
  const OscillationTuning& o = p.oscillation;
  require_less(o.short_window, o.medium_window, "oscillation.short_window_s",
               "oscillation.medium_window_s", issues);
  require_less(o.medium_window, o.long_window, "oscillation.medium_window_s",
               "oscillation.long_window_s", issues);
  require_less(o.min_frequency, o.max_frequency, "oscillation.min_frequency_per_s",
               "oscillation.max_frequency_per_s", issues);
  // A recurrence must lie in the past.
  require_less(p.recurrence.max_time_offset, p.recurrence.min_age, "recurrence.max_time_offset_s",
               "recurrence.min_age_s", issues);
  return issues;
}

Issues validate(const PredictiveParams& p, const Task&, const Map&, const IsGiven&) {
  Issues issues;
  require_values(p.tuning.speed_shares, "tuning.speed_shares", issues);
  issues.add(validate(p.prediction.tuning));
  return issues;
}
Issues validate(const AggregationParams& p, const Task&, const Map&, const IsGiven&) {
  Issues issues;
  require_values(p.rollout.tuning.change_lengths, "rollout.tuning.change_lengths", issues);
  return issues;
}
template <class Other>
Issues validate(const Other&, const Task&, const Map&, const IsGiven&) {
  return {};
}

}  // namespace

std::string_view unsupported_reason(const NavigatorParams& params, const Task& task) {
  return std::visit([&](const auto& p) { return missing_requirement(p, task); }, params);
}

Issues validate(const NavigatorParams& params, const Task& task, const Map& map,
                const IsGiven& is_given) {
  return std::visit([&](const auto& p) { return validate(p, task, map, is_given); }, params);
}

std::unique_ptr<Navigator> make_navigator(const NavigatorParams& params, const Task& task,
                                          Rng rng) {
  return std::visit([&](const auto& p) { return make(p, task, rng); }, params);
}

}  // namespace microswarm

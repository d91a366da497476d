// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/arena/driven_run.hpp"

#include <fmt/format.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/results/metrics.hpp"
#include "microswarm/experiment/run/contact_judge.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/planning/space_time/earliest_arrival.hpp"

namespace microswarm::reproduce {
namespace {

template <class Params>
navigation::NavigatorParams at_speed(const DrivenSwarm& swarm) {
  Params params;
  params.speed = swarm.speed;
  return params;
}

template <bool as_published>
navigation::NavigatorParams driven_drrt(const DrivenSwarm& swarm) {
  navigation::HierarchicalParams params;
  params.speed = swarm.speed;
  params.clearance = swarm.clearance;
  params.as_published = as_published;
  return params;
}

template <bool as_published>
navigation::NavigatorParams driven_radar(const DrivenSwarm& swarm) {
  navigation::RadarParams params;
  params.speed = swarm.speed;
  params.global_plan = true;
  params.planner.clearance = swarm.clearance;
  params.as_published = as_published;
  return params;
}

}  // namespace

std::vector<DrivenNavigator> driven_navigators() {
  return {{"safe interval", at_speed<navigation::SafeIntervalParams>, true},
          {"D-RRT*, ours", driven_drrt<false>},
          {"D-RRT*, as published", driven_drrt<true>},
          {"radar, ours", driven_radar<false>},
          {"radar, as published", driven_radar<true>},
          {"velocity obstacle", at_speed<navigation::VelocityObstacleParams>},
          {"potential field", at_speed<navigation::PotentialFieldParams>}};
}

DrivenRun drive(const experiment::Scenario& scenario, const World& world, const Stop& stop) {
  DrivenRun run;
  if (const Issues issues = experiment::validate(scenario, world); !issues.empty()) {
    run.refusal = InputError(issues).what();
    return run;
  }
  experiment::ContactLog log;
  experiment::RunListener* const listeners[] = {&log};
  const experiment::RunResult result = experiment::simulate(scenario, world, {}, listeners, stop);
  run.ran = result.status != Status::stopped;
  if (!run.ran) return run;
  run.status = result.status;
  run.time = result.metrics.time;
  run.length = result.metrics.length;
  run.turning = result.metrics.turning;
  run.contacts = static_cast<int>(log.contacts().size());
  for (const experiment::ContactVerdict& verdict :
       experiment::judge_contacts(scenario, world, 0, log))
    run.avoidable += verdict.avoidable ? 1 : 0;
  const experiment::TimeSummary steps = experiment::summarise(result.timing.steps);
  run.step_p50 = steps.p50;
  run.step_p99 = steps.p99;
  return run;
}

std::optional<double> find_optimum(const experiment::Scenario& scenario, const World& world,
                                   const Stop& stop) {
  const SwarmLimits swarm = swarm_limits(scenario.swarm);
  const planning::EarliestArrival found =
      planning::earliest_arrival(world,
                                 {.start = scenario.start->position,
                                  .goal = *scenario.goal,
                                  .tolerance = scenario.goal_tolerance,
                                  .radius = swarm.radius,
                                  .speed = swarm.max_speed,
                                  .horizon = scenario.time_limit},
                                 stop);
  return found.status == Status::solved ? std::optional(found.time) : std::nullopt;
}

std::string share_text(int count, int all) {
  const ShareInterval share = share_interval(count, all);
  return fmt::format("{} of {}; 95 %: {:.1f} – {:.1f}", count, all, 100 * share.low,
                     100 * share.high);
}

}  // namespace microswarm::reproduce

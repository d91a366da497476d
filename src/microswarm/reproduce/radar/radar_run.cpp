// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/radar/radar_run.hpp"

#include <algorithm>

#include "microswarm/experiment/session/session.hpp"
#include "microswarm/navigation/radar/radar.hpp"

namespace microswarm::reproduce {

RadarRun run_radar(const experiment::Scene& scene, const World& world, const Stop& stop,
                   std::uint32_t trial) {
  const experiment::Scenario& scenario = scene.scenario;
  const auto navigator = std::make_shared<navigation::RadarNavigator>(
      std::get<navigation::RadarParams>(scenario.navigator), experiment::navigation_task(scenario),
      Rng(scenario.seed, Purpose::planner, trial));
  experiment::Session session({scene, world, {}}, {.trial = trial, .navigator = navigator});
  RadarRun run;
  while (session.step(stop)) run.looks.push_back(navigator->last_look());
  run.record = session.record();
  run.record.navigator.clear();  // it is the scenario's
  run.record.phased_goals.clear();
  return run;
}

std::size_t frame_at(const experiment::Record& record, double t) {
  const auto after = std::find_if(record.frames.begin(), record.frames.end(),
                                  [t](const experiment::Frame& f) { return f.t > t + 1e-9; });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - record.frames.begin(), 1)) - 1;
}

std::vector<Period> periods_detected(const experiment::Record& record) {
  const double range = navigation::required_detection_range(record.scene.scenario.navigator);
  std::vector<Period> out;
  bool before = false;
  for (const experiment::Frame& f : record.frames) {
    const bool now = f.obstacle_clearance - f.radius < range;
    if (now && !before) out.push_back({f.t, f.t});
    if (now || before) out.back().to = f.t;
    before = now;
  }
  return out;
}

std::optional<double> cost_above(const experiment::Record& record, double cost) {
  for (const experiment::Frame& f : record.frames)
    if (f.avoidance_cost > cost) return f.t;
  return std::nullopt;
}

int side_passed(const experiment::Record& record) {
  const experiment::Scenario& scenario = record.scene.scenario;
  const experiment::Frame& nearest =
      *std::min_element(record.frames.begin(), record.frames.end(),
                        [](const experiment::Frame& a, const experiment::Frame& b) {
                          return a.obstacle_clearance < b.obstacle_clearance;
                        });
  const Vec2 obstacle = placement(scenario.obstacles.front().motion, nearest.t).pose.position;
  const Vec2 line = *scenario.goal - scenario.start->position;
  return cross(line, obstacle - nearest.pose.position) > 0 ? 1 : -1;
}

}  // namespace microswarm::reproduce

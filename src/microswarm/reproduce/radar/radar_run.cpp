// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/radar/radar_run.hpp"

#include <algorithm>

#include "microswarm/experiment/plant/plant.hpp"
#include "microswarm/navigation/radar/radar.hpp"

namespace microswarm::reproduce {
namespace {

/// Records the looks of the navigator.
class LookListener : public RunListener {
 public:
  explicit LookListener(const RadarNavigator& navigator) : navigator_(navigator) {}
  void on_tick(const Tick&) override { looks_.push_back(navigator_.last_look()); }
  std::vector<std::optional<RadarLook>> take() { return std::move(looks_); }

 private:
  const RadarNavigator& navigator_;
  std::vector<std::optional<RadarLook>> looks_;
};

}  // namespace

RadarRun run_radar(const Scene& scene, const World& world, const Stop& stop, std::uint32_t trial) {
  const Scenario& scenario = scene.scenario;
  KinematicPlant plant(scenario, world, trial);
  RadarNavigator navigator(std::get<RadarParams>(scenario.navigator), limits_of(scenario.swarm),
                           *scenario.goal, scenario.goal_tolerance,
                           Rng(scenario.seed, Purpose::planner, trial));
  Recorder recorder(scene, trial);
  LookListener looks(navigator);
  RunListener* const listeners[] = {&recorder, &looks};
  run(scenario, plant, navigator, listeners, stop);
  return {recorder.take(), looks.take()};
}

std::size_t frame_at(const Record& record, double t) {
  const auto after = std::find_if(record.frames.begin(), record.frames.end(),
                                  [t](const Frame& f) { return f.t > t + 1e-9; });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - record.frames.begin(), 1)) - 1;
}

std::vector<Period> periods_detected(const Record& record) {
  const double range = detection_range_of(record.scene.scenario.navigator);
  std::vector<Period> out;
  bool before = false;
  for (const Frame& f : record.frames) {
    const bool now = f.obstacle_clearance - f.radius < range;
    if (now && !before) out.push_back({f.t, f.t});
    if (now || before) out.back().to = f.t;
    before = now;
  }
  return out;
}

std::optional<double> cost_above(const Record& record, double cost) {
  for (const Frame& f : record.frames)
    if (f.avoidance_cost > cost) return f.t;
  return std::nullopt;
}

int side_passed(const Record& record) {
  const Scenario& scenario = record.scene.scenario;
  const Frame& nearest = *std::min_element(
      record.frames.begin(), record.frames.end(),
      [](const Frame& a, const Frame& b) { return a.obstacle_clearance < b.obstacle_clearance; });
  const Vec2 obstacle = placement(scenario.obstacles.front().motion, nearest.t).pose.position;
  const Vec2 line = *scenario.goal - scenario.start->position;
  return cross(line, obstacle - nearest.pose.position) > 0 ? 1 : -1;
}

}  // namespace microswarm::reproduce

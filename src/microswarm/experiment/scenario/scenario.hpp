// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/map_spec.hpp"
#include "microswarm/navigation/params.hpp"
#include "microswarm/swarm/body/swarm_params.hpp"
#include "microswarm/swarm/robots/robot_swarm_params.hpp"
#include "microswarm/world/obstacles/obstacle.hpp"

namespace microswarm {
class KeyLocations;
struct Settings;
}  // namespace microswarm

namespace microswarm::experiment {

/// Model of the camera and the image processing: delay, noise, missed and mistaken detections.
struct SensingParams {
  double observation_delay = 0.05;
  double hidden_delay = 0;
  double position_noise = 0;
  double heading_noise = 0;
  double missed_share = 0;
  double obstacle_noise = 0;
  double obstacle_missed_share = 0;
  double missed_time = 0;
  double swapped_share = 0;
  double obstacle_memory = 0.5;
  double frame_timeout = 0.5;

  /// True age of a frame when the navigator receives it [s].
  double age() const { return observation_delay + hidden_delay; }
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.observation_delay,
          s("observation_delay", 0, 10, "Age of a frame when the navigator receives it."));
    visit(self.hidden_delay,
          s("hidden_delay", 0, 10, "Further age of a frame, hidden from navigators."));
    visit(self.position_noise,
          um("position_noise", 0, 1e4, "Standard deviation of the swarm's position."));
    visit(self.heading_noise,
          deg("heading_noise", 0, 360, "Standard deviation of the swarm's heading."));
    visit(self.missed_share,
          plain("missed_share", 0, 1, "Share of frames in which no swarm is found."));
    visit(self.obstacle_noise,
          um("obstacle_noise", 0, 1e4, "Standard deviation of an obstacle's position."));
    visit(self.obstacle_missed_share, plain("obstacle_missed_share", 0, 1,
                                            "Share of frames in which an obstacle is not found."));
    visit(self.missed_time,
          s("missed_time", 0, 60, "Mean time for which sight stays lost; 0: one frame."));
    visit(self.swapped_share,
          plain("swapped_share", 0, 1, "Share of frames in which two obstacles swap identities."));
    visit(self.obstacle_memory,
          s("obstacle_memory", 0, 60, "Time for which an obstacle that is not found is kept."));
    visit(self.frame_timeout,
          s("frame_timeout", 0, 60, "Age of a frame above which the navigator holds."));
  }
};

/// Data that a record keeps besides the run.
struct RecordParams {
  bool diagnostics = false;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.diagnostics,
          plain("diagnostics", "Keep the diagnostics of each step, such as radar scans."));
  }
};

/// One experiment as data: world, swarm, start, goal and navigator. A swarm tracked as one body has
/// a start and a goal. Individually tracked robots have starts and either one common goal, where
/// they gather, or one goal each. `validate` checks this.
struct Scenario {
  std::string name{};
  std::string description{};
  formats::MapSpec map{};
  std::vector<Obstacle> obstacles{};
  SwarmParams swarm{};
  std::optional<RobotSwarmParams> robots{};
  SensingParams sensing{};
  std::optional<Pose2> start{};
  std::optional<Vec2> goal{};
  double goal_tolerance = 50;
  navigation::NavigatorParams navigator{};
  double tick = 0.1;
  double time_limit = 300;
  double hold_limit = 60;
  double hold_at_goal = 0;
  bool stop_at_contact = true;
  std::optional<double> detection_range{};
  RecordParams record{};
  std::uint64_t seed = 1;
  /// Keys of earlier versions.
  static constexpr std::array<MovedKey, 5> moved_keys{
      {{"navigator.frame_timeout_s", "sensing.frame_timeout_s"},
       {"navigator.rollout.commit", ""},
       {"navigator.tuning.route_cell_um", ""},
       {"swarm.field_amplitude_mt", ""},
       {"swarm.field_frequency_hz", ""}}};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.name, plain("name", "Name of the run."));
    visit(self.description, plain("description", "Description of the run."));
    visit(self.map, plain("map", "Walls.").needed());
    visit(self.obstacles, plain("obstacles", "Moving or changing obstacles."));
    visit(self.swarm, plain("swarm", "Body and motion of a swarm seen as one body."));
    visit(self.robots, plain("robots", "Individually tracked robots, in place of `swarm`."));
    visit(self.sensing, plain("sensing", "Noise and delay of the camera."));
    visit(self.start, plain("start", "Pose of the swarm at t = 0; not for robots."));
    visit(self.goal, um("goal", "Goal of the swarm, or where robots gather."));
    visit(self.goal_tolerance, um("goal_tolerance", 1e-3, 1e6,
                                  "Distance at which the goal counts as reached; robots: mean."));
    visit(self.navigator, plain("navigator", "Navigator and its parameters."));
    visit(self.tick, s("tick", 1e-3, 10, "Time between two commands."));
    visit(self.time_limit, s("time_limit", 0, 1e5, "Simulated time after which the run ends."));
    visit(self.hold_limit,
          s("hold_limit", 0, 1e5, "Longest uninterrupted hold before the run ends."));
    visit(self.hold_at_goal,
          s("hold_at_goal", 0, 1e6, "Time to hold the swarm at the goal before the end."));
    visit(self.stop_at_contact,
          plain("stop_at_contact", "End at the first contact, or count contacts and continue."));
    visit(self.detection_range,
          um("detection_range", 0, 1e6, "Gap below which an obstacle counts as being avoided."));
    visit(self.record, plain("record", "Data kept in the record."));
    visit(self.seed, plain("seed", "Seed of every random stream."));
  }
};

/// Reads a scenario; `settings` are applied after the file. `keys` receives the locations of its
/// keys. Throws InputError with file, line and column, one line per issue.
Scenario read_scenario(const std::filesystem::path& file, const Settings& settings,
                       KeyLocations& keys);
Scenario read_scenario(const std::filesystem::path& file, const Settings& settings);
Scenario read_scenario(const std::filesystem::path& file);

/// The scenario as YAML with every key; reading it gives equal fields.
std::string scenario_text(const Scenario& scenario);

/// JSON Schema of scenarios: every key with its unit, range, default and description.
std::string scenario_schema();

}  // namespace microswarm::experiment

namespace microswarm {

/// Compiled once, in scenario.cpp; describes the whole scenario.
extern template const Type& type_of<experiment::Scenario>();

}  // namespace microswarm

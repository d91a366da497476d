// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/messages.hpp"

namespace microswarm::experiment {
namespace {

Polygon bar(double x, double y, double width, double height) {
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, {}};
}

TEST(Scenario, TextReadsBackToTheSameFields) {
  const auto folder = empty_folder("scenario");
  const std::string text = scenario_text(small_flight());
  write_file_atomically(folder / "s.yaml", text);
  EXPECT_EQ(scenario_text(read_scenario(folder / "s.yaml")), text);
}

TEST(Scenario, TheFirstFlightIsFlown) {
  const std::filesystem::path folder = std::string(MICROSWARM_SOURCE_DIR) + "/scenarios";
  const Scenario scenario = read_scenario(folder / "first_flight.yaml");
  EXPECT_TRUE(validate(scenario, world_of(scenario)).empty());
  const Record record = record_of(scenario);
  EXPECT_EQ(record.result.status, Status::solved);
  EXPECT_GE(record.result.metrics.obstacles.clearance, 90);
  EXPECT_TRUE(replay(record).identical);
}

TEST(Scenario, AsPublishedLeavesNothingOfOursUnsaid) {
  const auto folder = empty_folder("scenario_published");
  const auto refusal = [&](const std::string& keys, const std::vector<std::string>& set = {}) {
    const std::string room =
        "map: {type: polygons, hi_um: [2000, 1000]}\ngoal_um: [1800, 500]\n"
        "start: {x_um: 200, y_um: 500}\nnavigator:\n";
    write_file_atomically(folder / "s.yaml", room + keys);
    const std::string what = error_of([&] {
      // What a record holds reads back, and is the same.
      const std::string text =
          scenario_text(open_experiment(folder / "s.yaml", {set, "--set"}).scenario());
      write_file_atomically(folder / "back.yaml", text);
      EXPECT_EQ(scenario_text(open_experiment(folder / "back.yaml").scenario()), text);
    });
    return what.substr(what.starts_with("--set") ? 0 : std::min(what.size(), what.find("s.yaml")));
  };
  const std::string radar = "  type: radar\n  as_published: true\n";
  EXPECT_EQ(refusal(radar), "");
  EXPECT_EQ(refusal(radar + "  retreat: false\n  safety_filter: {active: false}\n"), "");
  const std::string not_the_papers = " is not the paper's, and as_published is true";
  EXPECT_EQ(refusal(radar + "  retreat: true\n"), "s.yaml:7:12: retreat" + not_the_papers);
  EXPECT_EQ(refusal(radar + "  safety_filter: {active: true}\n"),
            "s.yaml:7:27: safety_filter.active" + not_the_papers);
  EXPECT_EQ(refusal(radar + "  safety_filter: {horizon_s: 4}\n"),
            "s.yaml:7:30: safety_filter.horizon_s" + not_the_papers);
  EXPECT_EQ(refusal(radar, {"navigator.compensate_delay=true"}),
            "--set navigator.compensate_delay: compensate_delay" + not_the_papers);
  const std::string drrt = "  type: hierarchical_drrt_star\n  as_published: true\n";
  EXPECT_EQ(refusal(drrt), "");
  EXPECT_EQ(refusal(drrt + "  guide: straight\n"), "");
  EXPECT_EQ(refusal(drrt + "  guide: route\n"), "s.yaml:7:10: guide" + not_the_papers);
  EXPECT_EQ(refusal(drrt + "  follower: {kind: learned}\n"),
            "s.yaml:7:20: follower.kind" + not_the_papers);
  EXPECT_EQ(refusal(drrt + "  planner: {straighten: true}\n"),
            "s.yaml:7:25: planner.straighten" + not_the_papers);
  EXPECT_EQ(refusal("  type: radar\n", {"navigator={type: radar, as_published: true, "
                                        "retreat: true}"}),
            "--set navigator: retreat" + not_the_papers);
  // The planner alone as published, within a navigator that is ours.
  EXPECT_EQ(refusal("  type: hierarchical_drrt_star\n"
                    "  planner: {as_published: true, straighten: true}\n"),
            "s.yaml:6:45: straighten" + not_the_papers);
}

TEST(Scenario, SettingsComeAfterTheFile) {
  const auto folder = empty_folder("scenario_set");
  write_file_atomically(folder / "s.yaml", scenario_text(open_room()));
  const Scenario scenario =
      read_scenario(folder / "s.yaml", {"seed=9", "swarm.radius_um=25", "goal_um=[7, 8]"});
  EXPECT_EQ(scenario.seed, 9u);
  EXPECT_EQ(std::get<RibbonParams>(scenario.swarm).radius, 25);
  EXPECT_EQ(scenario.goal, (Vec2{7, 8}));
}

TEST(Scenario, MistakesNameFileLineAndColumn) {
  const auto folder = empty_folder("scenario_mistakes");
  const auto message = [&](const std::string& text) {
    write_file_atomically(folder / "s.yaml", text);
    const std::string what = error_of([&] { read_scenario(folder / "s.yaml"); });
    return what.substr(std::min(what.size(), what.find("s.yaml")));
  };
  EXPECT_EQ(
      message("tik_s: 0.1\n").rfind("s.yaml:1:1: unknown key 'tik_s', did you mean 'tick_s'", 0),
      0u);
  EXPECT_EQ(message("tick_s: fast\n").rfind("s.yaml:1:9: ", 0), 0u);
  EXPECT_EQ(message("tick_s: 11\n").rfind("s.yaml:1:9: ", 0), 0u);
}

TEST(Scenario, AnUnknownTrackIsOneLine) {
  const auto folder = empty_folder("scenario_tracks");
  write_file_atomically(folder / "people.csv", "id,t_s,x_um,y_um\n7,0,1,2\n7,1,3,4\n");
  Scenario scenario = open_room();
  scenario.obstacles = {disc(10, Track{"people.csv", "7", nullptr})};
  const Scene scene = load_scene(scenario, folder);
  EXPECT_EQ(std::get<Track>(scene.scenario.obstacles[0].motion).samples->points[1], (Vec2{3, 4}));

  scenario.obstacles = {disc(10, Track{"people.csv", "8", nullptr})};
  EXPECT_EQ(error_of([&] { load_scene(scenario, folder); }),
            "obstacle 1: " + (folder / "people.csv").string() + " has no id '8'");
  scenario.obstacles = {disc(10, Track{"nobody.csv", "8", nullptr})};
  EXPECT_NE(error_of([&] { load_scene(scenario, folder); }).find("nobody.csv: cannot read"),
            std::string::npos);
}

// Of a file that the scenario names, the line tells where it is named.
TEST(Scenario, AFileThatCannotBeReadIsNamedWhereItStands) {
  const auto folder = empty_folder("scenario_files");
  const auto complaint = [&](const std::string& text) {
    write_file_atomically(folder / "s.yaml", text);
    const std::string what = error_of([&] { open_experiment(folder / "s.yaml", {}, {}); });
    return what.substr(std::min(what.size(), what.find("s.yaml")));
  };
  const std::string ends = "start: {x_um: 10, y_um: 10}\ngoal_um: [90, 90]\n";
  const std::string missing = ": cannot read: No such file or directory";
  EXPECT_EQ(complaint(ends + "map:\n  type: image\n  file: none.png\n  um_per_px: 5\n"),
            "s.yaml:5:9: " + (folder / "none.png").string() + missing);
  write_file_atomically(folder / "text.png", "no picture");
  EXPECT_TRUE(complaint(ends + "map: {type: image, file: text.png, um_per_px: 5}\n")
                  .starts_with("s.yaml:3:26: " + (folder / "text.png").string() + ": "));
  const std::string room = ends + "map: {type: polygons, hi_um: [100, 100]}\n";
  EXPECT_EQ(complaint(room + "obstacles:\n  - shape: {type: disc, radius_um: 5}\n"
                             "    motion: {type: track, file: no.csv, id: 1}\n"),
            "s.yaml:6:33: " + (folder / "no.csv").string() + missing);
  // Each line of a file with several mistakes.
  write_file_atomically(folder / "ros.yaml", "imag: a.pgm\nresolution: -1\n");
  std::istringstream lines(complaint(ends + "map: {type: ros, file: ros.yaml}\n"));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_NE(line.find("s.yaml:3:24: "), std::string::npos) << line;
  EXPECT_GE(count, 2);
}

TEST(Scenario, AnObstacleThatMakesNoSenseIsNamed) {
  Scenario scenario = open_room();
  scenario.obstacles = {{PolygonShape{{{0, 0}, {1, 1}}}, Still{}}};
  EXPECT_NE(error_of([&] { load_scene(scenario, {}); }).find("obstacle 1"), std::string::npos);
}

TEST(Scenario, EveryMistakeHasItsLine) {
  const auto folder = empty_folder("scenario_mistakes");
  const auto mistakes = [&](const std::string& text, const std::vector<std::string>& set = {}) {
    write_file_atomically(folder / "s.yaml", text);
    std::istringstream what(error_of([&] { open_experiment(folder / "s.yaml", {set, "--set"}); }));
    std::vector<std::string> lines;
    for (std::string line; std::getline(what, line);) {
      const auto name = line.find("s.yaml");
      lines.push_back(name == std::string::npos ? line : line.substr(name));
    }
    return lines;
  };
  // In keys and values, of the file and of --set.
  EXPECT_EQ(
      mistakes("map: {type: polygons, hi_um: [2000, 1000]}\n"
               "start: {x_um: 200, y_um: 500}\n"
               "goal_um: [1800, 500]\n"
               "tick_s: 0\n"
               "time_limt_s: 3\n"
               "navigator: {type: radar, speed_um_per_s: fast, safety_filter: {activ: true}}\n",
               {"hold_limit_s=-1"}),
      (std::vector<std::string>{
          "s.yaml:4:9: tick_s is 0 s, allowed 0.001..10 s",
          "s.yaml:5:1: unknown key 'time_limt_s', did you mean 'time_limit_s'?",
          "s.yaml:6:42: speed_um_per_s must be a number, not 'fast'",
          "s.yaml:6:64: unknown key 'activ', did you mean 'active'?",
          "--set hold_limit_s: hold_limit_s is -1 s, allowed 0..1e5 s"}));
  // In what values mean together, beside one that was misread.
  EXPECT_EQ(mistakes("map: {type: polygons, hi_um: [2000, 1000]}\n"
                     "start: {x_um: 200, y_um: 5000}\n"
                     "goal_um: [-1800, 500]\n"
                     "seed: -1\n"
                     "sensing: {observation_delay_s: 9}\n"
                     "navigator: {type: radar, angle_step_deg: 7}\n")
                .size(),
            5u);
  // Nothing is said of a world that was not read.
  EXPECT_EQ(mistakes("map: {type: polygons, hi_um: 2}\nstart: {x_um: -9, y_um: 9}\n"
                     "goal_um: [-1800, 500]\n")
                .size(),
            1u);
}

TEST(Scenario, KeysOfEarlierVersionsAreRead) {
  const auto folder = empty_folder("scenario_moved");
  const std::string room =
      "map: {type: polygons, hi_um: [2000, 1000]}\nstart: {x_um: 200, y_um: 500}\n"
      "goal_um: [1800, 500]\n";
  const auto opened = [&](const std::string& text, const std::vector<std::string>& set = {}) {
    write_file_atomically(folder / "s.yaml", room + text);
    return open_experiment(folder / "s.yaml", {set, "--set"}).scenario();
  };
  const std::string old = "navigator: {type: radar, frame_timeout_s: 0.3}\n";
  EXPECT_EQ(opened(old).sensing.frame_timeout, 0.3);
  EXPECT_EQ(opened(old + "sensing: {position_noise_um: 2}\n").sensing.frame_timeout, 0.3);
  EXPECT_EQ(opened("", {"navigator.frame_timeout_s=0.4"}).sensing.frame_timeout, 0.4);
  // What had no effect and is gone is ignored, in a file and on the command line.
  const std::string vortex = "swarm: {type: vortex, field_amplitude_mt: 8, field_frequency_hz: 5";
  EXPECT_EQ(
      std::get<VortexParams>(opened(vortex + ", radius_um: 90, moving_radius_um: 90}\n").swarm)
          .radius,
      90);
  EXPECT_NE(error_of([&] { opened(vortex + ", field_phase: 1}\n"); }).find("unknown key"),
            std::string::npos);
  const std::string small = "swarm: {type: vortex, radius_um: 90, moving_radius_um: 90}\n";
  EXPECT_NO_THROW(opened(small, {"swarm.field_amplitude_mt=8"}));
  // Given in both places, the old one is unknown; its line is told for what is wrong with it.
  EXPECT_NE(error_of([&] {
              opened(old + "sensing: {frame_timeout_s: 0.2}\n");
            }).find("s.yaml:4:26: unknown key"),
            std::string::npos);
  EXPECT_NE(error_of([&] {
              opened("navigator: {type: radar, frame_timeout_s: -1}\n");
            }).find("s.yaml:4:43: frame_timeout_s is -1"),
            std::string::npos);
}

TEST(Scenario, WhatComesOutLaterHasItsPlaceToo) {
  const auto folder = empty_folder("scenario_places");
  const auto message = [&](const std::string& text, const std::vector<std::string>& set = {}) {
    write_file_atomically(folder / "s.yaml", text);
    const std::string what = error_of([&] { open_experiment(folder / "s.yaml", {set, "--set"}); });
    return what.substr(what.starts_with("--set") ? 0 : std::min(what.size(), what.find("s.yaml")));
  };
  const std::string room =
      "map: {type: polygons, hi_um: [2000, 1000], walls_um: [[[900, 0], [1000, 0], [1000, 400]]]}\n"
      "start: {x_um: 200, y_um: 500}\n"
      "goal_um: [1800, 500]\n";
  EXPECT_EQ(message(room), "");
  EXPECT_EQ(message(room + "obstacles:\n"
                           "  - shape: {type: disc, radius_um: 5}\n"
                           "    motion: {type: still, position_um: [9, 9]}\n"
                           "  - motion: {type: still, position_um: [9, 9]}\n"
                           "    shape:\n"
                           "      type: breathing_disc\n"
                           "      min_radius_um: 90\n"
                           "      max_radius_um: 20\n"),
            "s.yaml:10:22: obstacle 2: min_radius_um is 90, more than max_radius_um, 20");
  EXPECT_TRUE(test::is_one_line_naming(message(room, {"start.y_um=100", "start.x_um=990"}),
                                       "--set start.x_um", {"start", "10 µm", "wall 1"}));
  EXPECT_TRUE(message("map: {type: polygons, hi_um: [2000, 0]}\n")
                  .starts_with("s.yaml:1:6: map: the map's bounds are empty: 0..2000 × 0..0 µm\n"));
  EXPECT_TRUE(
      test::is_one_line_naming(message(room + "navigator:\n  type: radar\n  angle_step_deg: 7\n"),
                               "s.yaml:6:19", {"navigator.angle_step_deg", "7", "360"}));
  EXPECT_TRUE(test::is_one_line_naming(
      message(room + "navigator:\n  type: radar\n  safety_distance_um: 50\n"), "s.yaml:6:23",
      {"navigator.detection_range_um", "70", "prediction_distance_um", "safety_distance_um",
       "75"}));
}

TEST(Scenario, SceneHashKnowsTheWorld) {
  const Scene scene = load_scene(small_flight(), {});
  Scene other = scene;
  other.map.walls[0].outer[0].x += 1e-9;
  EXPECT_NE(scene.hash(), other.hash());
}

TEST(ScenarioCheck, WhatCanBeFlownPasses) {
  EXPECT_EQ(check_error(open_room()), "");
  EXPECT_EQ(check_error(small_flight()), "");
}

TEST(ScenarioCheck, StartInAWall) {
  Scenario scenario = open_room();
  std::get<formats::PolygonsMap>(scenario.map).walls = {bar(0, 0, 212, 1000).outer};
  EXPECT_TRUE(
      test::is_one_line_naming(check_error(scenario), "s.yaml", {"start", "12 µm", "wall 1"}));
}

TEST(ScenarioCheck, StartTooNearToAnObstacleOrOutside) {
  Scenario scenario = open_room();
  scenario.obstacles = {disc(50, Still{{283, 500}, 0})};
  EXPECT_TRUE(test::is_one_line_naming(check_error(scenario), "s.yaml",
                                       {"start", "33 µm", "obstacle 1", "40 µm"}));
  scenario = open_room();
  scenario.start->position = {-10, 500};
  EXPECT_EQ(check_error(scenario).rfind("s.yaml: start is outside the map", 0), 0u);
}

TEST(ScenarioCheck, GoalInAWall) {
  Scenario scenario = open_room();
  std::get<formats::PolygonsMap>(scenario.map).walls = {bar(1700, 400, 200, 200).outer};
  EXPECT_TRUE(
      test::is_one_line_naming(check_error(scenario), "s.yaml", {"goal", "100 µm inside wall 1"}));
}

TEST(ScenarioCheck, ListsWithoutWhichNothingCanBeChosen) {
  Scenario scenario = open_room();
  navigation::HierarchicalParams drrt;
  drrt.tuning.speed_shares.clear();
  scenario.navigator = drrt;
  EXPECT_EQ(check_error(scenario), "s.yaml: tuning.speed_shares is empty, must have a value");
  drrt = {};
  drrt.tuning.wait_times = {8, 0};
  scenario.navigator = drrt;
  EXPECT_EQ(check_error(scenario), "s.yaml: tuning.wait_times_s must ascend from 0");
}

TEST(ScenarioCheck, TuningOfThePredictionMustAscend) {
  Scenario scenario = open_room();
  navigation::SafeIntervalParams params;
  params.prediction.tuning.oscillation.medium_window = 10;
  scenario.navigator = params;
  EXPECT_TRUE(test::is_one_line_naming(
      check_error(scenario), "s.yaml",
      {"prediction.tuning.oscillation.medium_window_s", "oscillation.long_window_s"}));
  params = {};
  params.prediction.tuning.recurrence.min_age = 0.1;
  scenario.navigator = params;
  EXPECT_TRUE(test::is_one_line_naming(check_error(scenario), "s.yaml",
                                       {"recurrence.max_time_offset_s", "recurrence.min_age_s"}));
}

TEST(ScenarioCheck, GoalCutOff) {
  Scenario scenario = open_room();
  std::get<formats::PolygonsMap>(scenario.map).walls = {bar(1000, 0, 20, 1000).outer};
  EXPECT_TRUE(
      test::is_one_line_naming(check_error(scenario), "s.yaml", {"goal", "start", "walls"}));
  // For a swarm thinner than the search for ways can see, too.
  std::get<RibbonParams>(scenario.swarm).radius = 0.5;
  std::get<navigation::HierarchicalParams>(scenario.navigator).clearance = 1;
  EXPECT_TRUE(
      test::is_one_line_naming(check_error(scenario), "s.yaml", {"goal", "start", "walls"}));
}

TEST(ScenarioCheck, FramesThatAreAlwaysTooOld) {
  Scenario scenario = open_room();
  scenario.sensing.observation_delay = 1;
  EXPECT_TRUE(test::is_one_line_naming(
      check_error(scenario), "s.yaml",
      {"sensing.observation_delay_s", "1", "sensing.frame_timeout_s", "0.5"}));
}

TEST(ScenarioCheck, SwarmWiderThanEveryPassage) {
  Scenario scenario = open_room();
  std::get<formats::PolygonsMap>(scenario.map).walls = {bar(1000, 0, 20, 500).outer,
                                                        bar(1000, 560, 20, 440).outer};
  const std::string expected =
      "s.yaml: swarm is 80 µm wide, wider than every passage to the goal: the widest is about ";
  EXPECT_EQ(check_error(scenario).substr(0, expected.size()), expected);
  std::get<RibbonParams>(scenario.swarm).radius = 29;
  std::get<navigation::HierarchicalParams>(scenario.navigator).clearance = 29;
  EXPECT_EQ(check_error(scenario), "");
}

TEST(ScenarioCheck, APassageDecidesToATenThousandth) {
  Scenario scenario = open_room();
  std::get<formats::PolygonsMap>(scenario.map).walls = {bar(1000, 0, 20, 500).outer,
                                                        bar(1000, 560, 20, 440).outer};
  for (const double r : {29.997, 30.003}) {
    std::get<RibbonParams>(scenario.swarm).radius = r;
    std::get<navigation::HierarchicalParams>(scenario.navigator).clearance = r;
    EXPECT_EQ(check_error(scenario).empty(), r < 30) << r;
  }
}

/// A room with a block, turned, across the way to the goal, and a start at its left face.
Scenario start_beside_block(double gap, double angle) {
  Scenario s = open_room();
  const Vec2 corner{900, 250}, u = unit_vector(angle), v = perpendicular(u);
  std::get<formats::PolygonsMap>(s.map).walls = {
      {corner, corner + 60 * u, corner + 60 * u + 500 * v, corner + 500 * v}};
  s.start->position = corner - gap * u + 220 * v;
  return s;
}

TEST(ScenarioCheck, AStartBesideAFaceIsAllowedAtEveryDistance) {
  for (const double angle : {0.0, 0.1, radians(30)})
    for (int gap = 41; gap <= 101; gap += angle == 0 && gap < 60 ? 1 : 10) {
      Scenario s = start_beside_block(gap, angle);
      EXPECT_EQ(check_error(s), "") << angle << ' ' << gap;
      s.navigator = navigation::SafeIntervalParams{};
      EXPECT_EQ(check_error(s), "") << angle << ' ' << gap;
    }
}

TEST(ScenarioCheck, ASwarmThatTouchesAFaceMayStart) {
  for (const double angle : {0.0, 0.1, radians(30)}) {
    Scenario s = start_beside_block(40, angle);
    while (!world_of(s).map->is_free(s.start->position, 40))
      s.start->position -= 1e-13 * unit_vector(angle);
    EXPECT_EQ(check_error(s), "") << angle;
    s.navigator = navigation::SafeIntervalParams{};
    EXPECT_EQ(check_error(s), "") << angle;
    std::swap(s.start->position, *s.goal);
    s.goal_tolerance = 1e-3;
    EXPECT_EQ(check_error(s), "") << angle;
  }
}

TEST(ScenarioCheck, MarginWiderThanEveryPassage) {
  Scenario scenario = open_room();
  std::get<formats::PolygonsMap>(scenario.map).walls = {bar(1000, 0, 20, 500).outer,
                                                        bar(1000, 600, 20, 400).outer};
  const std::string expected =
      "s.yaml: navigator.clearance_um is 90, wider than the passages to the goal allow: about ";
  EXPECT_EQ(check_error(scenario).substr(0, expected.size()), expected);
  std::get<navigation::HierarchicalParams>(scenario.navigator).clearance = 49;
  EXPECT_EQ(check_error(scenario), "");
}

TEST(ScenarioCheck, GoalNearerToAWallThanTheMargin) {
  Scenario scenario = open_room();
  scenario.goal = Vec2{1700, 60};
  scenario.goal_tolerance = 20;
  EXPECT_TRUE(test::is_one_line_naming(
      check_error(scenario), "s.yaml",
      {"goal", "60 µm", "90 µm", "navigator.clearance_um", "0.9", "goal_tolerance_um", "18 µm"}));
  scenario.goal_tolerance = 34;
  EXPECT_EQ(check_error(scenario), "");
}

}  // namespace
}  // namespace microswarm::experiment

// SPDX-License-Identifier: Apache-2.0
// Every bad scenario, record or command line is one line and exit code 2.
#include "inputs.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

class BadScenarios : public CommandLine {};

TEST_F(BadScenarios, NotANumber) {
  run_refused(with(two_rooms(), "radius_um", "  radius_um: .nan"),
              "flight.yaml:9:14: radius_um is .nan, must be finite");
  write("flight.yaml", two_rooms());
  refused({"run", "flight.yaml", "--set", "swarm.radius_um=nan"},
          naming("--set swarm.radius_um", {"radius_um", "nan"}));
}

TEST_F(BadScenarios, NotANumberInTracks) {
  write("tracks.csv", "id,t_s,x_um,y_um\n1,0,500,200\n1,1,nan,200\n");
  run_refused(two_rooms() +
                  "obstacles:\n"
                  "  - shape: {type: disc, radius_um: 30}\n"
                  "    motion: {type: track, file: tracks.csv, id: 1}\n",
              naming("flight.yaml:18:33", {"tracks.csv:3", "x_um", "nan"}));
}

TEST_F(BadScenarios, StartInAWall) {
  run_refused(with(two_rooms(), "start:", "start: {x_um: 1012, y_um: 100, heading_deg: 0}"),
              naming("flight.yaml:11:8", {"start", "12 µm", "wall 3"}));
}

TEST_F(BadScenarios, WiderThanEveryPassage) {
  run_refused(two_rooms(60), naming("flight.yaml:9:14", {"80 µm", "goal", "60 µm", "1000", "400"}));
}

TEST_F(BadScenarios, GoalCutOff) {
  run_refused(two_rooms(0), naming("flight.yaml:12:10", {"goal", "start", "walls"}));
}

TEST_F(BadScenarios, APlannerAsPublishedBesideAKeyOfOurs) {
  write("room.csv", "x_um,y_um,width_um,height_um\n400,400,100,100\n");
  refused({"plan", "room.csv", "--start", "100,100", "--goal", "800,800", "--set",
           "planner.type=drrt_star", "--set", "planner.as_published=true", "--set",
           "planner.straighten=true"},
          naming("--set planner.straighten", {"straighten", "as_published"}));
}

TEST_F(BadScenarios, KeysThatDoNotFitTogether) {
  const std::string radar = two_rooms() + "navigator:\n  type: radar\n";
  run_refused(radar + "  angle_step_deg: 7\n",
              naming("flight.yaml:18:19", {"navigator.angle_step_deg", "7", "360"}));
  run_refused(radar + "  waypoints_um: [[1030, 700]]\n",
              naming("flight.yaml:18:18", {"waypoint 1", "30 µm", "wall 4"}));
  run_refused(radar + "  detection_range_um: 300\n  prediction_distance_um: 200\n",
              naming("flight.yaml:19:27", {"navigator.prediction_distance_um", "200", "swarm",
                                           "safety_distance_um", "105"}));
  run_refused(two_rooms() +
                  "obstacles:\n"
                  "  - shape: {type: valve, span_um: 100, min_gap_um: 120}\n"
                  "    motion: {type: still, position_um: [500, 200]}\n",
              naming("flight.yaml:17:52", {"obstacle 1", "min_gap_um", "120", "span_um", "100"}));
  refused({"run", "flight.yaml", "--set", "obstacles=[]", "--set", "start.y_um=100", "--set",
           "start.x_um=1012"},
          naming("--set start.x_um", {"start", "12 µm", "wall 3"}));
}

TEST_F(BadScenarios, CoordinatesBeyondMeasure) {
  const std::string discs =
      two_rooms() + "obstacles:\n  - shape: {type: disc, radius_um: 30}\n    motion: ";
  run_refused(discs + "{type: harmonic_line, centre_um: [0, 0], amplitude_um: [0, 1e308]}\n",
              naming("flight.yaml:18:72", {"amplitude_um", "1e308 µm", "-1e9..1e9 µm"}));
  run_refused(discs + "{type: straight, start_um: [1e300, 0], velocity_um_per_s: [0, 0]}\n",
              naming("flight.yaml:18:41", {"start_um", "1e300 µm", "-1e9..1e9 µm"}));
}

TEST_F(BadScenarios, UnknownKey) {
  run_refused(with(two_rooms(), "radius_um", "  radus_um: 40"),
              naming("flight.yaml:9:3", {"radus_um", "radius_um"}));
  write("flight.yaml", two_rooms());
  refused({"run", "flight.yaml", "--set", "swarn.radius_um=3"},
          naming("--set swarn.radius_um", {"swarn", "swarm"}));
}

TEST_F(BadScenarios, WrongType) {
  run_refused(with(two_rooms(), "radius_um", "  radius_um: thick"),
              naming("flight.yaml:9:14", {"radius_um", "thick"}));
  run_refused(with(two_rooms(), "goal_um", "goal_um: 5"),
              naming("flight.yaml:12:10", {"goal_um", "[x, y]", "5"}));
}

TEST_F(BadScenarios, OutOfRange) {
  run_refused(with(two_rooms(), "radius_um", "  radius_um: -3"),
              naming("flight.yaml:9:14", {"radius_um", "-3 µm", "0.001..1e5 µm"}));
}

TEST_F(BadScenarios, MicrometresPerPixelMissing) {
  write("room.pgm", pgm(60, 40, [](int, int) { return 255; }));
  run_refused("map: {type: image, file: room.pgm}\nstart: {x_um: 1, y_um: 1}\ngoal_um: [2, 2]\n",
              naming("flight.yaml:1:6", {"missing", "um_per_px"}));
}

TEST_F(BadScenarios, Settings) {
  write("flight.yaml", two_rooms());
  const auto set = [&](const std::string& setting, const Complaint& line) {
    refused({"run", "flight.yaml", "--set", setting}, line);
  };
  set("swarm", naming("--set 'swarm'", {"KEY", "VALUE"}));
  set("swarm.radius_um=", naming("--set swarm.radius_um", {"radius_um", "empty"}));
  set("navigator.type=pilot",
      naming("--set navigator.type", {"pilot", "hierarchical_drrt_star", "plan_player",
                                      "aggregation", "radar", "straight_stop", "potential_field",
                                      "velocity_obstacle", "follow_path", "safe_interval"}));
  set("goal_um=[1]", naming("--set goal_um", {"goal_um", "[x, y]", "1"}));
}

TEST_F(BadScenarios, Records) {
  write("text.h5", "no record at all");
  refused({"replay", "text.h5"}, naming("text.h5", {"HDF5", "damaged"}));
  write("flight.yaml", two_rooms());
  good({"run", "flight.yaml", "--out", "out", "--no-report"});
  refused({"run", "out/run.h5", "--rig", "rig.yaml"}, naming("out/run.h5", {"record"}));
  refused({"sweep", "out/run.h5"},
          naming("out/run.h5", {"record", "`microswarm report`", "`microswarm replay`"}));
  const std::string whole = read("out/run.h5");
  for (const std::size_t bytes : {std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    write("cut.h5", whole.substr(0, bytes));
    refused({"replay", "cut.h5"}, naming("cut.h5", {"HDF5", "damaged"}));
    refused({"report", "cut.h5", "--out", "page"}, naming("cut.h5", {"HDF5", "damaged"}));
  }
}

TEST_F(BadScenarios, CommandLine) {
  refused({}, naming("", {"missing", "run, plan, global", "bench, schema", "microswarm --help"}));
  refused({"fly"}, naming("", {"fly", "run, plan, global", "bench, schema", "microswarm --help"}));
  refused({"rnu"}, naming("", {"rnu", "run", "microswarm --help"}));
  refused({"map", "chek"}, naming("", {"chek", "check", "microswarm map --help"}));
  refused({"run", "a.yaml", "--sead", "1"},
          naming("", {"--sead", "--seed", "microswarm run --help"}));
  refused({"run"}, naming("", {"scenario", "microswarm run --help"}));
  refused({"run", "a.yaml", "b.yaml"}, naming("", {"b.yaml", "microswarm run --help"}));
  refused({"run", "a.yaml", "--seed", "-1"},
          naming("--seed", {"0..18446744073709551615", "-1", "microswarm run --help"}));
  refused({"run", "a.yaml", "--trials", "0"},
          naming("--trials", {"1..1000000", "0", "microswarm run --help"}));
  refused({"plan", "a.png", "--start", "1,x", "--goal", "1,1"},
          naming("--start", {"1,x", "microswarm plan --help"}));
}

TEST_F(BadScenarios, PaperFigureGroup) {
#ifdef MICROSWARM_HAS_LEARNING
  const std::string follower = ", follower";
#else
  const std::string follower;
#endif
  refused({"reproduce", "drtt"},
          naming("reproduce", {"drtt", "drrt", "global", "radar", "gather"}));
  refused({"reproduce", "drrt/fig9"},
          "reproduce drrt: unknown figure 'fig9', did you mean 'fig3'? Allowed: fig3, fig5a, "
          "fig5b, comparison" +
              follower);
  refused({"bench", "speed"},
          naming("bench", {"speed", "planning", "swarm", "global", "radar", "vision"}));
}

}  // namespace
}  // namespace microswarm::test

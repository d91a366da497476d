// SPDX-License-Identifier: Apache-2.0
// Maps and paths through files: read, checked, converted there and back, drawn.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "inputs.hpp"
#include "microswarm/config/type.hpp"
#include "microswarm/planning/path/planner_params.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

constexpr double cell = 10;

class Maps : public CommandLine {
 protected:
  /// 600 × 400 µm: a wall at x from 300 to 320 with a gap of 160 µm at the bottom, and a block.
  Maps() {
    write("room.pgm", pgm(60, 40, [](int x, int y) {
            const bool wall = (x == 30 || x == 31) && y < 24;
            const bool block = x >= 50 && x < 53 && y >= 30 && y < 32;
            return wall || block ? 0 : 255;
          }));
  }
  Json about(const char* command, const std::string& map, bool scaled) const {
    Arguments words{"map", command, map, "--json"};
    if (scaled) words.insert(words.end(), {"--um-per-px", "10"});
    return Json::parse(good(words));
  }
};

TEST_F(Maps, Info) {
  const Json info = about("info", "room.pgm", true);
  EXPECT_EQ(info.at("lo_um"), Json({0, 0}));
  EXPECT_EQ(info.at("hi_um"), Json({600, 400}));
  EXPECT_EQ(info.at("walls"), 2);
  EXPECT_EQ(info.at("vertices"), 8);
  EXPECT_TRUE(
      good({"map", "info", "room.pgm", "--um-per-px", "10"}).starts_with("room.pgm: 600 × 400 µm"));
}

TEST_F(Maps, Check) {
  const Json check = about("check", "room.pgm", true);
  EXPECT_EQ(check.at("free_pieces"), 1);
  EXPECT_EQ(check.at("wall_pieces"), 2);
  EXPECT_EQ(check.at("free_area_um2"), 600 * 400 - 20 * 240 - 30 * 20);
  EXPECT_NEAR(check.at("narrowest_passage_um"), 160, 1.5 * check.at("resolution_um").get<double>());
  const std::string text = good({"map", "check", "room.pgm", "--um-per-px", "10"});
  EXPECT_NE(text.find("narrowest passage"), std::string::npos) << text;
}

TEST_F(Maps, WithoutItsModuleTheProgramReadsAllButPhotographs) {
  at.program = (at.folder / "bin" / "microswarm").string();
  fs::create_directory(at.folder / "bin");
  fs::copy_file(MICROSWARM_PROGRAM, at.program);
  EXPECT_EQ(about("info", "room.pgm", true).at("walls"), 2);
  std::string bmp = "BM";
  bmp.resize(54 + 4);
  bmp[10] = 54, bmp[14] = 40, bmp[18] = 1, bmp[22] = 1, bmp[26] = 1, bmp[28] = 24;
  write("a.bmp", bmp);
  refused({"map", "info", "a.bmp", "--um-per-px", "1"}, {"libmicroswarm_media.so", {"BMP"}});
  at.program = MICROSWARM_PROGRAM;
  EXPECT_EQ(run({"map", "info", "a.bmp", "--um-per-px", "1", "--set", "map.free=dark"}).code, 0);
}

TEST_F(Maps, ThereAndBack) {
  const Json room = about("info", "room.pgm", true);
  const auto convert = [&](const std::string& from, const std::string& to, Arguments more) {
    more.insert(more.begin(), {"map", "convert", from, to});
    EXPECT_EQ(good(more), "wrote " + to + "\n");
  };
  convert("room.pgm", "a.geojson", {"--um-per-px", "10"});
  convert("a.geojson", "b.png", {"--cell", "10"});
  convert("b.png", "c.geojson", {"--um-per-px", "10"});
  convert("c.geojson", "d.map", {"--cell", "10"});
  convert("d.map", "e.yaml", {"--um-per-px", "10"});
  EXPECT_EQ(read("a.geojson"), read("c.geojson"));
  for (const std::string map : {"a.geojson", "b.png", "c.geojson", "d.map"})
    EXPECT_EQ(about("info", map, !map.ends_with("geojson")).at("hash"), room.at("hash")) << map;
  const Json ros = about("info", "e.yaml", false);
  EXPECT_EQ(ros.at("hi_um"), room.at("hi_um"));
  EXPECT_EQ(ros.at("vertices"), room.at("vertices"));
  refused({"map", "convert", "a.geojson", "f.png"}, naming("f.png", {"missing", "--cell"}));
}

TEST_F(Maps, PlanInPictures) {
  const std::vector<std::pair<std::string, std::string>> kinds{
      {"path.png", "\x89PNG"}, {"path.svg", "<?xml"}, {"path.pdf", "%PDF"}};
  for (const auto& [picture, begin] : kinds) {
    const std::string said = good({"plan", "room.pgm", "--um-per-px", "10", "--start",
                                   "100,300,-90", "--goal", "500,300", "--picture", picture});
    EXPECT_TRUE(said.starts_with("path of ")) << said;
    EXPECT_TRUE(read(picture).starts_with(begin)) << picture;
  }
}

TEST_F(Maps, EveryPlanner) {
  std::vector<std::string> planners;
  for (const std::string_view word : type_of<planning::PlannerParams>().words)
    planners.emplace_back(word);
  for (const std::string& planner : planners) {
    const Json plan = Json::parse(
        good({"plan", "room.pgm", "--um-per-px", "10", "--start", "100,300", "--goal", "500,300",
              "--set", "planner.type=" + planner, "--set", "planner.clearance_um=30", "--json"}));
    EXPECT_EQ(plan.at("status"), "solved") << planner;
    EXPECT_GT(plan.at("length_um"), 400) << planner;
    EXPECT_EQ(plan.at("path_um").front(), Json({100.0, 300.0})) << planner;
  }
  std::vector<std::string> named = planners;
  named.emplace_back("rrt**");
  refused({"plan", "room.pgm", "--um-per-px", "10", "--start", "100,300", "--goal", "500,300",
           "--set", "planner.type=rrt**"},
          naming("--set planner.type", named));
}

/// One rule for every command and planner: a goal in a wall is refused, one near a wall is noted
/// with the distance to where the path ends.
TEST_F(Maps, AGoalInAWallIsRefusedByEveryCommand) {
  const std::string inside = "is 10 µm inside wall";
  for (const std::string_view planner : type_of<planning::PlannerParams>().words)
    refused({"plan", "room.pgm", "--um-per-px", "10", "--start", "100,300", "--goal", "310,300",
             "--set", "planner.type=" + std::string(planner), "--set", "planner.clearance_um=10"},
            naming("room.pgm", {"goal", inside}));
  refused({"plan", "room.pgm", "--um-per-px", "10", "--start", "100,300", "--goal", "700,300"},
          naming("room.pgm", {"goal", "outside the map"}));
  refused({"global", "room.pgm", "--um-per-px", "10", "--robots", "100,300", "--goals", "310,300"},
          naming("room.pgm", {"goal", inside}));
  refused({"gather", "room.pgm", "--map-um-per-px", "10", "--goal", "310,300"},
          naming("room.pgm", {"goal", inside}));
  const std::string scenario =
      "map: {type: image, file: room.pgm, um_per_px: 10}\nstart: {x_um: 100, y_um: 300}\n"
      "swarm: {type: ribbon, radius_um: 20}\ngoal_tolerance_um: 60\n"
      "navigator: {type: straight_stop}\n";
  write("in_wall.yaml", scenario + "goal_um: [310, 300]\n");
  refused({"run", "in_wall.yaml"}, naming("in_wall.yaml:6:10", {"goal", inside}));
  write("near_wall.yaml", scenario + "goal_um: [290, 300]\n");
  const Outcome near = run({"run", "near_wall.yaml", "--json"});
  EXPECT_NE(near.err.find("note: goal is 10 µm from wall"), std::string::npos) << near.err;
  EXPECT_NE(near.err.find("µm from it"), std::string::npos) << near.err;
}

TEST_F(Maps, APathThatEndsBesideItsGoalIsNoted) {
  const Outcome made =
      run({"plan", "room.pgm", "--um-per-px", "10", "--start", "100,300", "--goal", "290,300",
           "--set", "planner.clearance_um=40", "--set", "planner.goal_tolerance_um=50", "--json"});
  EXPECT_EQ(made.code, 0);
  const Json notes = Json::parse(made.out).at("notes");
  ASSERT_EQ(notes.size(), 1u);
  const std::string note = notes[0];
  EXPECT_NE(note.find("goal is 10 µm from wall"), std::string::npos) << note;
  const std::string_view before = "the path ends ";
  const std::size_t at_number = note.find(before);
  ASSERT_NE(at_number, std::string::npos) << note;
  EXPECT_NEAR(std::stod(note.substr(at_number + before.size())), 30, 2) << note;
  EXPECT_EQ(made.err, "note: " + note + "\n");
}

TEST_F(Maps, KeysOfTheMapOnEveryCommand) {
  write("dark.pgm", pgm(60, 40, [](int x, int y) {
          const bool wall = (x == 30 || x == 31) && y < 24;
          return wall ? 90 : 20;
        }));
  const Arguments keys{"--um-per-px", "10", "--set", "map.free=dark", "--set", "map.threshold=60"};
  const auto with_keys = [&](Arguments words) {
    words.insert(words.end(), keys.begin(), keys.end());
    return words;
  };
  EXPECT_EQ(Json::parse(good(with_keys({"map", "info", "dark.pgm", "--json"}))).at("walls"), 1);
  good(with_keys({"map", "check", "dark.pgm"}));
  good(with_keys({"map", "convert", "dark.pgm", "light.geojson"}));
  EXPECT_EQ(about("info", "light.geojson", false).at("vertices"), 4);
  const Json path = Json::parse(
      good(with_keys({"plan", "dark.pgm", "--start", "100,300", "--goal", "500,300", "--json"})));
  EXPECT_GT(path.at("length_um"), 410);
  good(with_keys({"global", "dark.pgm", "--robots", "100,300", "--goals", "200,300"}));
  refused({"map", "info", "dark.pgm", "--um-per-px", "10"},
          naming("dark.pgm", {"90", "128", "map.threshold to 45"}));
  refused({"map", "info", "room.pgm", "--um-per-px", "10", "--set", "planner.type=rrt"},
          naming("--set planner.type", {"map"}));
}

/// The library says what is missing, this program by which option.
TEST_F(Maps, AMessageNamesTheOption) {
  write("a.geojson", R"({"type":"LineString","coordinates":[[0,0],[3,0]]})");
  const Outcome map = run({"map", "info", "a.geojson", "--set", "map.line_width_um=1", "--json"});
  EXPECT_TRUE(names(map.err, "give --um-per-unit, the µm for a unit")) << map.err;
  EXPECT_EQ(map.err, "note: " + Json::parse(map.out).at("notes")[0].get<std::string>() + "\n");
  const Outcome png = run({"map", "convert", "a.geojson", "a.png", "--um-per-unit", "1", "--set",
                           "map.line_width_um=1"});
  EXPECT_EQ(png.err, "microswarm: a.png: the size of a cell is missing: give --cell\n");
  write("s.yaml",
        "map: {type: geojson, file: a.geojson, line_width_um: 1, hi_um: [9, 9]}\n"
        "start: {x_um: 50, y_um: 50}\ngoal_um: [350, 50]\n");
  const Outcome flight = run({"run", "s.yaml"});
  EXPECT_FALSE(names(flight.err, "--um-per-unit")) << flight.err;  // `run` has none
}

TEST_F(Maps, WhatAReaderAssumesIsNoted) {
  write("m.txt", "1 1 1 1\n1 0 0 1\n1 1 1 1\n");
  const Outcome made = run({"map", "info", "m.txt", "--um-per-px", "10", "--json"});
  const Json info = Json::parse(made.out);
  EXPECT_EQ(info.at("walls"), 1);
  EXPECT_EQ(info.at("hi_um"), Json({40, 30}));
  ASSERT_EQ(info.at("notes").size(), 1u);
  EXPECT_EQ(made.err, "note: " + info.at("notes")[0].get<std::string>() + "\n");
  const Arguments said{"map", "info", "m.txt", "--um-per-px", "10", "--set", "map.wall=one"};
  EXPECT_EQ(run(said).err, "");
  write("s.yaml",
        "map: {type: matrix, file: m.txt, um_per_cell: 100}\nstart: {x_um: 50, y_um: 50}\n"
        "swarm: {type: ribbon, radius_um: 20}\nnavigator: {type: straight_stop}\n"
        "goal_um: [350, 50]\n");
  const Outcome ran = run({"run", "s.yaml"});
  EXPECT_NE(ran.err.find("map.wall=one"), std::string::npos) << ran.err;
}

/// A vessel of 8 px that forks.
bool in_vessel(int x, int y) {
  const double trunk = std::abs(y - 150 - 20 * std::sin(x / 60.0));
  const double fork = 150 + 20 * std::sin(200 / 60.0);
  return trunk < 4 || (x > 200 && std::abs(y - fork - 0.6 * (x - 200)) < 4);
}

TEST_F(Maps, Segment) {
  write("photo.pgm", pgm(400, 300, [](int x, int y) {
          return (in_vessel(x, y) ? 90 : 150) + (x * 7 + y * 13) % 5;
        }));
  write("truth.pgm", pgm(400, 300, [](int x, int y) { return in_vessel(x, y) ? 255 : 0; }));
  const Json found = Json::parse(good({"map", "segment", "photo.pgm", "--um-per-px", "5", "--out",
                                       "maps/vessels.geojson", "--truth", "truth.pgm", "--json"}));
  EXPECT_EQ(found.at("map"), "maps/vessels.geojson");
  EXPECT_GT(found.at("dice"), 0.8) << found;
  EXPECT_TRUE(read("maps/vessels-overlay.png").starts_with("\x89PNG"));
  const Json check = about("check", "maps/vessels.geojson", false);
  EXPECT_EQ(check.at("free_pieces"), 1);
  EXPECT_GT(check.at("widest_um"), 30);
  EXPECT_EQ(found.at("method"), "regions");
  EXPECT_EQ(found.at("polarity"), "dark");
  EXPECT_GT(found.at("two_level_share"), 0.9);
  EXPECT_GT(found.at("polarity_odds"), 1);
  const std::string told =
      good({"map", "segment", "photo.pgm", "--um-per-px", "5", "--out", "v.geojson"});
  EXPECT_NE(told.find("method: regions, dark"), std::string::npos) << told;
  refused({"map", "segment", "photo.pgm", "--um-per-px", "5", "--set", "min_widt_px=6"},
          naming("--set min_widt_px", {"min_widt_px", "min_width_px"}));
}

/// Noise of standard deviation 25, from a hash of the pixel's number.
int noise_at(int x, int y) {
  auto n = static_cast<std::uint32_t>(400 * y + x);
  n = (n ^ 61) ^ (n >> 16);
  n *= 9;
  n ^= n >> 4;
  n *= 0x27d4eb2d;
  n ^= n >> 15;
  int sum = -510;
  for (int k = 0; k < 4; ++k) sum += static_cast<int>((n >> (8 * k)) & 255);
  return sum * 25 / 148;
}

TEST_F(Maps, VesselsFainterThanTheNoiseAreTold) {
  const auto photo = [&](int contrast) {
    write("photo.pgm", pgm(400, 300, [&](int x, int y) {
            return std::clamp(130 - (in_vessel(x, y) ? contrast : 0) + noise_at(x, y), 0, 255);
          }));
  };
  const Arguments segment{"map", "segment", "photo.pgm", "--um-per-px",
                          "5",   "--out",   "v.geojson", "--json"};
  photo(6);
  refused(segment, naming("photo.pgm: no vessels found", {"fainter than the noise"}));
  photo(60);
  EXPECT_TRUE(Json::parse(good(segment)).at("notes").empty());
}

TEST_F(Maps, Graph) {
  write("chip.pgm", pgm(300, 200, [](int x, int y) {
          return std::abs(y - 100) < 10 || (x > 140 && x < 156 && y > 100 && y < 180) ? 255 : 0;
        }));
  const Json found = Json::parse(
      good({"map", "graph", "chip.pgm", "--um-per-px", "2", "--out", "out/chip", "--json"}));
  EXPECT_EQ(found.at("branches"), 3);
  EXPECT_EQ(found.at("nodes"), 4);
  EXPECT_EQ(found.at("networks"), 1);
  const std::string branches = read("out/chip-branches.csv");
  EXPECT_EQ(std::count(branches.begin(), branches.end(), '\n'), 4) << branches;
  EXPECT_NE(branches.find("junction-end"), std::string::npos) << branches;
  EXPECT_TRUE(
      read("out/chip-nodes.csv").starts_with("node,network,type,degree,x_um,y_um,width_um"));
  write("wall.pgm", pgm(30, 20, [](int, int) { return 0; }));
  refused({"map", "graph", "wall.pgm", "--um-per-px", "2"}, naming("wall.pgm", {"wall"}));
  refused({"map", "graph", "chip.pgm", "--um-per-px", "2", "--cell", "0.001"},
          naming("map in cells of 0.001 µm", {"400000", "16384"}));
}

}  // namespace
}  // namespace microswarm::test

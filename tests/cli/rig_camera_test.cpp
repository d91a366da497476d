// SPDX-License-Identifier: Apache-2.0
// What a rig's camera shows, through the program: its scale, and what is seen in a picture.
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "microswarm/formats/images/image.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

class RigCamera : public CommandLine {
 protected:
  /// A picture of 320 × 240 pixels, dark where `dark` says.
  void draw(const std::string& name, const std::function<bool(int x, int y)>& dark) {
    std::string pixels;
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 320; ++x) pixels += static_cast<char>(dark(x, y) ? 60 : 120);
    write(name, "P5\n320 240\n255\n" + pixels);
  }
};

TEST_F(RigCamera, ScaleFromTwoPoints) {
  draw("slide.pgm", [](int, int) { return false; });
  const Json told = Json::parse(good({"rig", "scale", "slide.pgm", "--points", "10,20,40,60",
                                      "--distance", "500", "--out", "scale.yaml", "--json"}));
  EXPECT_EQ(told["scale"]["um_per_px"], 10);
  EXPECT_EQ(told["scale"]["origin_px"], (Json{-0.5, 239.5}));
  EXPECT_NE(read("scale.yaml").find("um_per_px: 10"), std::string::npos);
}

TEST_F(RigCamera, ScaleFromAGridOfDots) {
  draw("slide.pgm", [](int x, int y) {
    return std::hypot((x + 15) % 30 - 15, (y + 15) % 30 - 15) < 6 && x > 15 && x < 285 && y > 15 &&
           y < 195;
  });
  const Json told =
      Json::parse(good({"rig", "scale", "slide.pgm", "--grid", "9x6", "--pitch", "100", "--json"}));
  EXPECT_NEAR(told["scale"]["um_per_px"].get<double>(), 100 / 30.0, 1e-3);
  EXPECT_EQ(told["points"], 54);
  EXPECT_LT(told["worst_um"].get<double>(), 1);
  const Outcome other = run({"rig", "scale", "slide.pgm", "--grid", "9x7", "--pitch", "100"});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(is_one_line_naming(other.err, "microswarm: slide.pgm: grid", {"54", "9x6", "9x7"}));
}

TEST_F(RigCamera, ScaleOfAMirroredPicture) {
  draw("slide.pgm", [](int x, int y) {
    return std::hypot((x + 15) % 30 - 15, (y + 15) % 30 - 15) < 6 && x > 15 && x < 285 && y > 15 &&
           y < 195;
  });
  const Json grid = Json::parse(good(
      {"rig", "scale", "slide.pgm", "--grid", "9x6", "--pitch", "100", "--mirrored", "--json"}));
  EXPECT_NEAR(grid["scale"]["um_per_px"].get<double>(), 100 / 30.0, 1e-3);
  EXPECT_EQ(grid["scale"]["y_up"], false);
  EXPECT_NEAR(grid["scale"]["origin_px"][0].get<double>(), 30, 0.1);  // its upper left point
  EXPECT_NEAR(grid["scale"]["origin_px"][1].get<double>(), 30, 0.1);
  EXPECT_LT(grid["worst_um"].get<double>(), 1);
  const Json points = Json::parse(good({"rig", "scale", "slide.pgm", "--points", "10,20,40,60",
                                        "--distance", "500", "--mirrored", "--json"}));
  EXPECT_EQ(points["scale"]["origin_px"], (Json{-0.5, -0.5}));
}

TEST_F(RigCamera, SeesASwarmAndDrawsIt) {
  draw("frame.pgm", [](int x, int y) { return std::hypot(x - 100, y - 90) < 25; });
  // A smooth disc, where swarms have grain.
  const Json told = Json::parse(good({"rig", "see", "frame.pgm", "--out", "seen.png", "--json",
                                      "--set", "scene.swarm.look.min_texture=0"}));
  EXPECT_EQ(told["swarm"], "found");
  EXPECT_NEAR(told["candidates"][0]["centre_px"][0].get<double>(), 100, 0.1);
  EXPECT_NEAR(told["candidates"][0]["radius_px"].get<double>(), 25, 0.5);
  EXPECT_TRUE(exists("seen.png"));
  EXPECT_EQ(Json::parse(good({"rig", "see", "frame.pgm", "--json"}))["swarm"], "found");
  draw("empty.pgm", [](int, int) { return false; });
  const Outcome empty = run({"rig", "see", "empty.pgm"});
  EXPECT_EQ(empty.code, 3);
  EXPECT_TRUE(names(empty.out, "min_contrast")) << empty.out;
}

TEST_F(RigCamera, SaysWhySomethingIsNotTheSwarm) {
  draw("two.pgm", [](int x, int y) {
    return std::hypot(x - 80, y - 90) < 25 || std::hypot(x - 220, y - 90) < 20 ||
           std::hypot(x - 150, y - 180) < 4;
  });
  const Outcome seen = run({"rig", "see", "two.pgm", "--out", "seen.png"});
  EXPECT_EQ(seen.code, 3);
  EXPECT_TRUE(names(seen.out, "texture 0.0 < 5 (scene.swarm.look.min_texture)")) << seen.out;
  EXPECT_TRUE(names(seen.out, "< 8 (scene.swarm.look.min_radius_px)")) << seen.out;
  const Json told = Json::parse(run({"rig", "see", "two.pgm", "--json"}).out);
  ASSERT_EQ(told["not_swarm"].size(), 3U);
  for (const Json& no : told["not_swarm"]) {
    EXPECT_LT(no["value"].get<double>(), no["limit"].get<double>());
    EXPECT_TRUE(no["key"].get<std::string>().starts_with("scene.swarm.look."));
  }
  const Outcome several = run({"rig", "see", "two.pgm", "--set", "scene.swarm.look.min_texture=0"});
  EXPECT_TRUE(names(several.out, "swarm: several")) << several.out;
  EXPECT_TRUE(names(several.out, "(80.00, 90.00) px, radius 24.87 px")) << several.out;
  EXPECT_TRUE(names(several.out, "(220.00, 90.00) px, radius 20.17 px")) << several.out;
}

TEST_F(RigCamera, RefusesInOneLine) {
  draw("slide.pgm", [](int, int) { return false; });
  refused({"rig", "scale", "slide.pgm", "--points", "10,20,400,60", "--distance", "500"},
          naming("--points", {"400,60", "slide.pgm", "320 × 240"}));
  refused({"rig", "scale", "slide.pgm", "--points", "0,0,0.5,0", "--distance", "1e7"},
          naming("scale", {"2e7 µm", "pixel", "1e-6..1e6"}));
  refused(
      {"rig", "scale", "slide.pgm", "--points", "1,2,3,4", "--distance", "9", "--pattern", "dots"},
      naming("", {"--pattern", "--grid", "microswarm rig scale --help"}));
  refused({"rig", "scale", "slide.pgm", "--points", "1,2,3,4", "--grid", "3x3"},
          naming("", {"--points", "--grid", "microswarm rig scale --help"}));
  write("small.pgm", "P5\n2 1\n255\nab");
  refused({"rig", "see", "slide.pgm", "--still", "small.pgm"},
          naming("small.pgm", {"2 × 1", "picture", "320 × 240"}));
  refused({"rig", "see", "slide.pgm", "--set", "scene.swarm.look.max_radius_px=5"},
          naming("", {"max_radius_px", "5", "min_radius_px", "8"}));
  refused({"rig", "see", "slide.pgm", "--out", "seen.txt"},
          naming("--out", {"seen.txt", "microswarm rig see --help"}));
}

/// Of a picture with 320 × 240 pixels of 6 µm.
const char* const seen_rig =
    "coils: coils.yaml\ndriver: {type: simulated}\ncamera: {type: v4l2}\n"
    "scale: {um_per_px: 6, origin_px: [-0.5, 239.5]}\n"
    "perception: {scene: {swarm: {look: {min_texture: 0}}}}\n";

TEST_F(RigCamera, AScenarioIsDrawnWhereTheCameraSeesIt) {
  draw("frame.pgm", [](int x, int y) { return std::hypot(x - 40, y - 40) < 25; });
  write("coils.yaml", "coils: {type: helmholtz}\n");
  write("rig.yaml", seen_rig);
  write("flight.yaml",
        "map: {type: polygons, lo_um: [0, 0], hi_um: [1920, 1440], walls_um: [[[1407, 651], [1503, "
        "651], [1503, 747], [1407, 747]]]}\n"
        "start: {x_um: 501, y_um: 699}\ngoal_um: [1005, 699]\n"
        "swarm: {type: vortex}\nnavigator: {type: radar}\n");
  const Arguments see{"rig", "see", "frame.pgm", "--rig", "rig.yaml", "--out", "seen.png"};
  good(see);
  const formats::Image without = formats::read_image(at.folder / "seen.png");
  Arguments with = see;
  with.insert(with.end(), {"--scenario", "flight.yaml"});
  const Outcome off = run(with);
  EXPECT_EQ(off.code, 0);
  EXPECT_TRUE(names(off.out, "px (560.9 µm) from the start")) << off.out;
  EXPECT_TRUE(is_one_line_naming(off.err, "note", {"start", "60 px", "scene.swarm.jump_px"}));
  const formats::Image drawn = formats::read_image(at.folder / "seen.png");
  const auto colour = [&](const formats::Image& image, int x, int y) {
    const std::size_t i = image.index(x, y);
    return std::array<int, 3>{image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
  };
  // The start is at pixel (83, 123), the goal at (167, 123), the wall from (234, 131) to (250,
  // 115).
  EXPECT_EQ(colour(drawn, 87, 127), (std::array<int, 3>{86, 180, 233}));
  EXPECT_EQ(colour(drawn, 171, 127), (std::array<int, 3>{204, 121, 167}));
  EXPECT_EQ(colour(drawn, 242, 131), (std::array<int, 3>{213, 94, 0}));
  EXPECT_EQ(colour(drawn, 234, 123), (std::array<int, 3>{213, 94, 0}));
  for (const auto& [x, y] : {std::pair{242, 123}, {40, 40}, {120, 200}})
    EXPECT_EQ(colour(drawn, x, y), colour(without, x, y));
}

TEST_F(RigCamera, WhatCannotBeDrawnIsSaid) {
  draw("frame.pgm", [](int x, int y) { return std::hypot(x - 100, y - 90) < 25; });
  write("coils.yaml", "coils: {type: helmholtz}\n");
  write("rig.yaml", seen_rig);
  write("flight.yaml",
        "map: {type: polygons, lo_um: [0, 0], hi_um: [90000, 90000]}\n"
        "start: {x_um: 500, y_um: 500}\ngoal_um: [80000, 80000]\n"
        "swarm: {type: vortex}\nnavigator: {type: radar}\n");
  const Outcome outside = run({"rig", "see", "frame.pgm", "--rig", "rig.yaml", "--out", "seen.png",
                               "--scenario", "flight.yaml"});
  EXPECT_EQ(outside.code, 0) << outside.err;
  EXPECT_TRUE(names(outside.err, "1 of 2")) << outside.err;
  refused({"rig", "see", "frame.pgm", "--scenario", "flight.yaml", "--out", "other.png"},
          naming("", {"--scenario", "--rig", "--out"}));
  write("rig.yaml", "coils: coils.yaml\ndriver: {type: simulated}\ncamera: {type: v4l2}\n");
  refused({"rig", "see", "frame.pgm", "--rig", "rig.yaml", "--scenario", "flight.yaml", "--out",
           "other.png"},
          naming("rig.yaml", {"scale"}));
}

TEST_F(RigCamera, ALensThatBendsIsTold) {
  // Dots of a grid of 26 px, seen by a lens with k1 = 0.04: true = seen (1 + k1 r²).
  draw("bent.pgm", [](int x, int y) {
    const double dx = x - 159.5, dy = y - 119.5;
    const double stretch = 1 + 0.04 * (dx * dx + dy * dy) / (200 * 200);
    const double u = stretch * dx + 4 * 26, v = stretch * dy + 3 * 26;
    const double column = std::round(u / 26), row = std::round(v / 26);
    return column >= 0 && column < 9 && row >= 0 && row < 7 &&
           std::hypot(u - 26 * column, v - 26 * row) < 6;
  });
  const Arguments scale{"rig", "scale", "bent.pgm", "--grid", "9x7", "--pitch", "100"};
  Arguments as_json = scale;
  as_json.push_back("--json");
  const Json lens = Json::parse(good(as_json))["lens_distortion"];
  EXPECT_NEAR(lens["k1"].get<double>(), 0.04, 0.01);
  EXPECT_NEAR(lens["corner_shift_px"].get<double>(), 8, 2);
  EXPECT_TRUE(lens["found"].get<bool>());
  const std::string told = good(scale);
  EXPECT_TRUE(names(told, "barrel") && names(told, "px")) << told;
}

TEST_F(RigCamera, NoSuchCameraIsAHardwareError) {
  const Outcome none = run({"rig", "see", "/dev/video97"});
  EXPECT_EQ(none.code, 4);
  EXPECT_EQ(none.err, "microswarm: /dev/video97: cannot open: No such file or directory\n");
}

}  // namespace
}  // namespace microswarm::test

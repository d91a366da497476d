// SPDX-License-Identifier: Apache-2.0
// What a rig's camera shows, through the program: its scale, and what is seen in a picture.
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

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
  EXPECT_EQ(other.err,
            "microswarm: slide.pgm: grid: 54 points of a grid of 9x6 are seen, asked for is one of "
            "9x7\n");
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
                                      "--set", "scene.swarm.look.min_grain=0"}));
  EXPECT_EQ(told["swarm"], "found");
  EXPECT_NEAR(told["candidates"][0]["centre_px"][0].get<double>(), 100, 0.1);
  EXPECT_NEAR(told["candidates"][0]["radius_px"].get<double>(), 25, 0.5);
  EXPECT_TRUE(exists("seen.png"));
  draw("empty.pgm", [](int, int) { return false; });
  EXPECT_EQ(run({"rig", "see", "empty.pgm"}).code, 3);
}

TEST_F(RigCamera, RefusesInOneLine) {
  draw("slide.pgm", [](int, int) { return false; });
  refused({"rig", "scale", "slide.pgm", "--points", "10,20,400,60", "--distance", "500"},
          "--points: 400,60 is outside slide.pgm, which is 320 × 240 px");
  refused({"rig", "scale", "slide.pgm", "--points", "0,0,0.5,0", "--distance", "1e7"},
          "scale: 2e7 µm a pixel, allowed 1e-6..1e6");
  refused(
      {"rig", "scale", "slide.pgm", "--points", "1,2,3,4", "--distance", "9", "--pattern", "dots"},
      "--pattern requires --grid (see microswarm rig scale --help)");
  refused({"rig", "scale", "slide.pgm", "--points", "1,2,3,4", "--grid", "3x3"},
          "--points excludes --grid (see microswarm rig scale --help)");
  write("small.pgm", "P5\n2 1\n255\nab");
  refused({"rig", "see", "slide.pgm", "--still", "small.pgm"},
          "small.pgm: is 2 × 1 px, the picture is 320 × 240 px");
  refused({"rig", "see", "slide.pgm", "--set", "scene.swarm.look.max_radius_px=5"},
          "max_radius_px is 5, min_radius_px 8: nothing is found");
  refused({"rig", "see", "slide.pgm", "--out", "seen.txt"},
          "--out: must be a file .png, not 'seen.txt' (see microswarm rig see --help)");
}

TEST_F(RigCamera, NoSuchCameraIsAHardwareError) {
  const Outcome none = run({"rig", "see", "/dev/video97"});
  EXPECT_EQ(none.code, 4);
  EXPECT_EQ(none.err, "microswarm: /dev/video97: cannot open: No such file or directory\n");
}

}  // namespace
}  // namespace microswarm::test

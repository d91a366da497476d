// SPDX-License-Identifier: Apache-2.0
// Every bad picture or map is one line and exit code 2.
#include "inputs.hpp"
#include "program.hpp"
#include "tests/formats/png.hpp"

namespace microswarm::test {
namespace {

class BadMaps : public CommandLine {
 protected:
  void info_refused(const std::string& file, const std::string& line) const {
    refused({"map", "info", file, "--um-per-px", "5"}, file + ": " + line);
  }
};

std::string white(int width, int height) {
  return pgm(width, height, [](int, int) { return 255; });
}

TEST_F(BadMaps, NoFile) {
  info_refused("none.png", "cannot read: No such file or directory");
  refused({"map", "check", "none.geojson"}, "none.geojson: cannot read: No such file or directory");
  refused({"map", "segment", "none.png", "--um-per-px", "5"},
          "none.png: cannot read: No such file or directory");
  refused({"run", "none.yaml"}, "none.yaml: cannot read: No such file or directory");
  refused({"replay", "none.h5"}, "none.h5: cannot read: No such file or directory");
  refused({"report", "none.h5"}, "none.h5: cannot read: No such file or directory");
}

TEST_F(BadMaps, NotAnImage) {
  write("text.png", "hello, I am a picture\n");
  info_refused("text.png", "not an image (PNG, JPEG, BMP, PGM, PPM or PBM)");
  write("empty.png", "");
  info_refused("empty.png", "empty file");
}

TEST_F(BadMaps, NoKnownForm) {
  write("map.docx", "walls");
  refused({"map", "info", "map.docx"},
          "map.docx: no map that is known: a picture, ROS .yaml, MovingAI .map, GeoJSON or a .csv "
          "expected");
}

TEST_F(BadMaps, TruncatedImage) {
  write("cut.pgm", white(60, 40).substr(0, 1213));
  info_refused("cut.pgm", "truncated: 2400 bytes of pixels expected, 1200 there");
  const std::string rows(40 * 61, '\0');
  write("cut.png", png(60, 40, 8, grey, rows).substr(0, 1000));
  const Outcome cut = run({"map", "info", "cut.png", "--um-per-px", "5"});
  EXPECT_EQ(cut.code, 2);
  EXPECT_TRUE(cut.err.starts_with("microswarm: cut.png: damaged PNG: ")) << cut.err;
}

TEST_F(BadMaps, NoPixels) {
  write("zero.pgm", "P5\n0 0\n255\n");
  info_refused("zero.pgm", "0 × 0 pixels, at least 1 × 1");
  write("zero.png", png(0, 0, 8, grey, ""));
  info_refused("zero.png", "damaged PNG: invalid image width");
}

TEST_F(BadMaps, TooManyPixels) {
  write("huge.pgm", "P5\n20000 20000\n255\n");
  info_refused("huge.pgm", "20000 × 20000 pixels, at most 16384 a side");
  write("huge.png", png(20000, 20000, 8, grey, ""));
  info_refused("huge.png", "20000 × 20000 pixels, at most 16384 a side");
}

TEST_F(BadMaps, AllBlocked) {
  write("black.pgm", pgm(60, 40, [](int, int) { return 0; }));
  const Arguments scale{"--um-per-px", "5"};
  refused({"map", "check", "black.pgm", "--um-per-px", "5"},
          "black.pgm: all of the map is blocked");
  refused({"plan", "black.pgm", "--um-per-px", "5", "--start", "12,100", "--goal", "200,100"},
          "black.pgm: start is 12 µm inside wall 1");
}

TEST_F(BadMaps, MicrometresPerPixel) {
  write("room.pgm", white(60, 40));
  const std::string missing = "room.pgm: µm per px is missing: give --um-per-px";
  refused({"map", "info", "room.pgm"}, missing);
  refused({"map", "segment", "room.pgm"}, missing);
  refused({"plan", "room.pgm", "--start", "100,100", "--goal", "200,100"}, missing);
  write("flight.yaml", two_rooms());
  refused({"run", "flight.yaml", "--photo", "room.pgm", "--out", "out"}, missing);
  refused({"map", "info", "room.pgm", "--um-per-px", "0"},
          "--um-per-px: is 0, allowed 1e-6..1e6 (see microswarm map info --help)");
  refused({"map", "info", "room.pgm", "--um-per-px", "nan"},
          "--um-per-px: must be a number, not 'nan' (see microswarm map info --help)");
}

TEST_F(BadMaps, EndsThatAreNotFree) {
  write("room.pgm", pgm(60, 40, [](int x, int) { return x < 10 ? 0 : 255; }));
  const auto plan = [&](const std::string& start, const std::string& goal,
                        const std::string& line) {
    refused({"plan", "room.pgm", "--um-per-px", "10", "--start", start, "--goal", goal, "--picture",
             "path.png"},
            line);
  };
  plan("88,200", "400,200", "room.pgm: start is 12 µm inside wall 1");
  plan("588,200", "400,200", "room.pgm: start is 12 µm from the border, needs 40 µm");
  plan("400,200", "-200,200", "room.pgm: goal is outside the map (0..600 × 0..400 µm)");
}

TEST_F(BadMaps, NoWayToTheGoal) {
  const auto wall = [](int gap) {
    return pgm(60, 40, [gap](int x, int y) { return x == 30 && y >= gap ? 0 : 255; });
  };
  const Arguments ends{"--um-per-px", "10", "--start", "100,200", "--goal", "500,200"};
  const auto plan = [&](const std::string& map, const std::string& line) {
    Arguments words{"plan", map};
    words.insert(words.end(), ends.begin(), ends.end());
    refused(words, line);
  };
  write("closed.pgm", wall(0));
  plan("closed.pgm", "closed.pgm: goal is cut off from the start by walls");
  write("narrow.pgm", wall(5));
  plan("narrow.pgm",
       "narrow.pgm: swarm is 80 µm wide, wider than every passage to the goal: the widest is about "
       "49.9 µm, at (293, 375.1) µm");
}

}  // namespace
}  // namespace microswarm::test

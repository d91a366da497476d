// SPDX-License-Identifier: Apache-2.0
// Every bad picture or map is one line and exit code 2.
#include "inputs.hpp"
#include "program.hpp"
#include "tests/formats/png.hpp"

namespace microswarm::test {
namespace {

class BadMaps : public CommandLine {
 protected:
  void info_refused(const std::string& file, const Complaint& complaint) const {
    refused({"map", "info", file, "--um-per-px", "5"}, complaint.in(file));
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

TEST_F(BadMaps, APictureNamedInAScenario) {
  write("flight.yaml",
        "start: {x_um: 10, y_um: 10}\ngoal_um: [90, 90]\nmap:\n  type: image\n  file: none.png\n"
        "  um_per_px: 5\n");
  const std::string why = "none.png: cannot read: No such file or directory";
  refused({"run", "flight.yaml"}, "flight.yaml:5:9: " + why);
  refused({"run", "flight.yaml", "--set", "map.file=lost.png"},
          "--set map.file: lost.png: cannot read: No such file or directory");
}

TEST_F(BadMaps, NotAnImage) {
  write("text.png", "hello, I am a picture\n");
  info_refused("text.png", naming("", {"PNG", "JPEG", "BMP", "PGM", "PPM", "PBM"}));
  write("empty.png", "");
  info_refused("empty.png", "empty file");
}

TEST_F(BadMaps, NoKnownForm) {
  write("map.docx", "walls");
  refused({"map", "info", "map.docx"}, naming("map.docx", {"ROS", "MovingAI", "GeoJSON"}));
}

TEST_F(BadMaps, TruncatedImage) {
  write("cut.pgm", white(60, 40).substr(0, 1213));
  info_refused("cut.pgm", naming("", {"truncated", "2400", "bytes", "1200"}));
  const std::string rows(40 * 61, '\0');
  write("cut.png", png(60, 40, 8, grey, rows).substr(0, 1000));
  const Outcome cut = run({"map", "info", "cut.png", "--um-per-px", "5"});
  EXPECT_EQ(cut.code, 2);
  EXPECT_TRUE(cut.err.starts_with("microswarm: cut.png: damaged PNG: ")) << cut.err;
}

TEST_F(BadMaps, NoPixels) {
  write("zero.pgm", "P5\n0 0\n255\n");
  info_refused("zero.pgm", naming("", {"0 × 0", "pixels", "1 × 1"}));
  write("zero.png", png(0, 0, 8, grey, ""));
  info_refused("zero.png", naming("", {"PNG", "width"}));
}

TEST_F(BadMaps, TooManyPixels) {
  write("huge.pgm", "P5\n20000 20000\n255\n");
  info_refused("huge.pgm", naming("", {"20000 × 20000", "pixels", "16384", "side"}));
  write("huge.png", png(20000, 20000, 8, grey, ""));
  info_refused("huge.png", naming("", {"20000 × 20000", "pixels", "16384", "side"}));
}

TEST_F(BadMaps, AllBlocked) {
  write("black.pgm", pgm(60, 40, [](int, int) { return 0; }));
  const Arguments scale{"--um-per-px", "5"};
  const auto advice = naming("black.pgm", {"all", "wall", "map.threshold", "map.free"});
  refused({"map", "check", "black.pgm", "--um-per-px", "5"}, advice);
  refused({"plan", "black.pgm", "--um-per-px", "5", "--start", "12,100", "--goal", "200,100"},
          advice);
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
          naming("--um-per-px", {"0", "1e-6..1e6", "microswarm map info --help"}));
  refused({"map", "info", "room.pgm", "--um-per-px", "nan"},
          naming("--um-per-px", {"nan", "microswarm map info --help"}));
}

TEST_F(BadMaps, EndsThatAreNotFree) {
  write("room.pgm", pgm(60, 40, [](int x, int) { return x < 10 ? 0 : 255; }));
  const auto plan = [&](const std::string& start, const std::string& goal, const Complaint& line) {
    refused({"plan", "room.pgm", "--um-per-px", "10", "--start", start, "--goal", goal, "--picture",
             "path.png"},
            line);
  };
  plan("88,200", "400,200", naming("room.pgm", {"start", "12 µm", "wall 1"}));
  plan("588,200", "400,200", naming("room.pgm", {"start", "12 µm", "40 µm"}));
  plan("400,200", "-200,200", naming("room.pgm", {"goal", "0..600", "0..400 µm"}));
}

TEST_F(BadMaps, NoWayToTheGoal) {
  const auto wall = [](int gap) {
    return pgm(60, 40, [gap](int x, int y) { return x == 30 && y >= gap ? 0 : 255; });
  };
  const Arguments ends{"--um-per-px", "10", "--start", "100,200", "--goal", "500,200"};
  const auto plan = [&](const std::string& map, const Complaint& line) {
    Arguments words{"plan", map};
    words.insert(words.end(), ends.begin(), ends.end());
    refused(words, line);
  };
  write("closed.pgm", wall(0));
  plan("closed.pgm", naming("closed.pgm", {"goal", "start", "walls"}));
  write("narrow.pgm", wall(5));
  plan("narrow.pgm", naming("narrow.pgm", {"80 µm", "goal", "49.9 µm", "293", "375.1"}));
}

}  // namespace
}  // namespace microswarm::test

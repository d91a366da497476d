// SPDX-License-Identifier: Apache-2.0
// Coil systems through the program: fields, currents, limits, maps, calibrations.
#include <cmath>
#include <nlohmann/json.hpp>

#include "inputs.hpp"
#include "program.hpp"
#include "tests/cases.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

class Rig : public CommandLine {
 protected:
  /// Helmholtz pairs of one radius and 100 turns: (4/5)^(3/2) µ0 n / R each.
  Rig() {
    write("rig.yaml",
          "name: bench\ncoils: {type: helmholtz, radius_um: [50000, 50000, 50000], turns: [100, "
          "100, 100]}\ndrives: [{max_current_a: 2}]\n");
  }
  static constexpr double mt_per_a = 0.71554175 * 1256.63706212 * 100 / 50000;
};

TEST_F(Rig, FieldOfCurrentsAndCurrentsOfAField) {
  const Json made =
      Json::parse(good({"rig", "field", "rig.yaml", "--currents", "1,0,-0.5", "--json"}));
  EXPECT_NEAR(made["field_mt"][0].get<double>(), mt_per_a, 1e-6);
  EXPECT_NEAR(made["field_mt"][2].get<double>(), -0.5 * mt_per_a, 1e-6);
  EXPECT_EQ(made["scale"], 1);
  EXPECT_EQ(made["limits"].size(), 0u);
  const Json back = Json::parse(
      good({"rig", "field", "rig.yaml", "--at", "0,0,0", "--field", "0,1,0", "--json"}));
  EXPECT_NEAR(back["currents_a"][1].get<double>(), 1 / mt_per_a, 1e-6);
  EXPECT_EQ(back["reached"], true);
  EXPECT_NE(good({"rig", "field", "rig.yaml", "--field", "0,1,0"}).find("bench at (0, 0, 0) µm"),
            std::string::npos);
}

TEST_F(Rig, SaysWhichLimitBites) {
  const Outcome outcome = run({"rig", "field", "rig.yaml", "--currents", "4,1,0", "--json"});
  EXPECT_EQ(outcome.code, 3);
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["scale"], 0.5);
  EXPECT_EQ(json["currents_a"], Json({2, 0.5, 0}));
  EXPECT_EQ(
      json["limits"],
      Json::array(
          {{{"limit", "current"}, {"coil", "x"}, {"unit", "a"}, {"asked", 4}, {"allowed", 2}}}));
  const Outcome text = run({"rig", "field", "rig.yaml", "--currents", "4,1,0"});
  EXPECT_TRUE(names(text.out, "coil x") && names(text.out, "4 A") && names(text.out, "2 A"))
      << text.out;
}

TEST_F(Rig, MapsAsPictureAndTable) {
  const Json json = Json::parse(good({"rig", "map", "rig.yaml", "--field", "0,0,1", "--points",
                                      "21", "--out", "even.png", "--json"}));
  EXPECT_LT(json["largest_deviation"].get<double>(), 0.02);
  EXPECT_EQ(read("even.png").substr(1, 3), "PNG");
  good({"rig", "map", "rig.yaml", "--plane", "xz", "--points", "5", "--out", "even.csv"});
  const std::string table = read("even.csv");
  EXPECT_TRUE(table.starts_with("x_um,y_um,z_um,bx_mt,by_mt,bz_mt,deviation\n-10000,0,-10000,"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 26);
}

TEST_F(Rig, AMapOfAMeasuredSystemStaysWhereItWasMeasured) {
  // Two coils whose fields were measured in a cube of 2 x 2 x 2 mm.
  for (const bool along_x : {true, false}) {
    std::string grid = "8\n2 2 2\n-0.001 0.001\n-0.001 0.001\n-0.001 0.001\n";
    for (const char* x : {"-0.001 ", "0.001 "})
      for (const char* y : {"-0.001 ", "0.001 "})
        for (const char* z : {"-0.001 ", "0.001 "})
          grid += std::string(x) + y + z + (along_x ? "0.002 0 0\n" : "0 0.002 0\n");
    write(along_x ? "x.txt" : "y.txt", grid);
  }
  write("grids.yaml", "coils: {type: vfield, files: [x.txt, y.txt]}\n");
  const Json json = Json::parse(good({"rig", "map", "grids.yaml", "--points", "5", "--json"}));
  EXPECT_LE(json["half_width_um"].get<double>(), 1000);
  EXPECT_GT(json["half_width_um"].get<double>(), 800);
  EXPECT_EQ(run({"rig", "map", "grids.yaml", "--half-width", "1001"}).code, 2);
}

TEST_F(Rig, AMapSaysWhatCannotBe) {
  const Outcome strong = run({"rig", "map", "rig.yaml", "--field", "50,0,0", "--points", "5"});
  EXPECT_EQ(strong.code, 0);
  EXPECT_TRUE(strong.err.starts_with("note: ") && names(strong.err, "limits")) << strong.err;
  EXPECT_EQ(strong.out.find("e-1"), std::string::npos) << strong.out;  // rounding
}

TEST_F(Rig, RoundingIsNotShownAsAGradient) {
  const std::string text = good({"rig", "field", "rig.yaml", "--at", "0,0,0", "--field", "3,0,0"});
  EXPECT_NE(text.find("field (3, 0, 0) mT, 3 mT in all\ngradients dBx/dx 0, dBx/dy 0, dBx/dz 0, "
                      "dBy/dy 0, dBy/dz 0 T/m\n"),
            std::string::npos)
      << text;
}

TEST_F(Rig, CalibrationGivesASystemThatIsReadAgain) {
  write("measured.csv",
        "i_a_a,i_b_a,i_c_a,bx_mt,by_mt,bz_mt\n1,0,0,2,0,0\n0,1,0,0,3,0\n0,0,1,0,0.5,4\n1,1,1,2,3.5,"
        "4\n");
  const Outcome said = run({"rig", "calibrate", "measured.csv", "--out", "fitted.yaml"});
  EXPECT_EQ(said.code, 0);
  EXPECT_TRUE(names(said.out, "4 measurements") && names(said.out, "3 coils")) << said.out;
  for (const char* coil : {"a", "b", "c"}) EXPECT_TRUE(names(said.out, coil)) << said.out;
  EXPECT_TRUE(is_one_line_naming(said.err, "note", {"fitted.yaml", "limits", "drives"}));
  const Json json =
      Json::parse(good({"rig", "field", "fitted.yaml", "--field", "2,3.5,4", "--json"}));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(json["currents_a"][i].get<double>(), 1, 1e-9);
}

TEST_F(Rig, RefusesInOneLine) {
  refused({"rig", "field", "rig.yaml"}, "rig field: give either --currents or --field");
  refused({"rig", "field", "rig.yaml", "--currents", "1,2"}, naming("", {"--currents", "2", "3"}));
  refused({"rig", "field", "none.yaml", "--field", "1,0,0"},
          "none.yaml: cannot read: No such file or directory");
  write("bad.yaml", "coils: {type: helmholtz, radus_um: [1, 2, 3]}\n");
  refused({"rig", "field", "bad.yaml", "--field", "1,0,0"},
          naming("bad.yaml:1:26", {"radus_um", "radius_um"}));
  write("few.csv", "i_a_a,i_b_a,bx_mt,by_mt,bz_mt\n1,0,2,0,0\n2,0,4,0,0\n");
  refused({"rig", "calibrate", "few.csv", "--out", "x.yaml"},
          naming("few.csv", {"2", "fields", "b"}));
  refused({"rig", "map", "rig.yaml", "--currents", "0,0,0"}, naming("", {"field", "centre", "0"}));
  refused({"rig", "map", "rig.yaml", "--out", "even.bmp"},
          naming("--out", {"even.bmp", "microswarm rig map --help"}));
  refused({"rig", "map", "rig.yaml", "--json=3"},
          naming("", {"json", "microswarm rig map --help"}));
}

class WholeRig : public CommandLine {
 protected:
  static std::string rig(const char* name) {
    return std::string(MICROSWARM_SOURCE_DIR "/scenarios/rigs/") + name;
  }
};

TEST_F(WholeRig, IsCheckedInWordsAndInJson) {
  const std::string words = good({"rig", "check", rig("vortex.yaml"), "--seconds", "0.2"});
  EXPECT_NE(words.find("everything is as it should be"), std::string::npos) << words;
  const Outcome outcome = run({"rig", "check", rig("vortex.yaml"), "--seconds", "0.2", "--json",
                               "--set", "driver.full_scale_a=0.1"});
  EXPECT_EQ(outcome.code, 4);
  const Json told = Json::parse(outcome.out);
  EXPECT_EQ(told["ok"], false);
  EXPECT_EQ(told["answers"][1],
            Json({{"what", "limits"},
                  {"ok", false},
                  {"answer", "the coils' limits weaken the field to 0.27 mT, 8 mT is meant"}}));
}

TEST_F(WholeRig, ItsMapIsCheckedAgainstThePicture) {
  const auto check = [&](const std::string& setting) {
    return run({"rig", "check", rig("vortex.yaml"), "--seconds", "0.1", "--scenario",
                MICROSWARM_SOURCE_DIR "/scenarios/papers/radar/micromaze.yaml", "--set",
                "camera.type=simulated", "--set", "camera.microscope." + setting});
  };
  EXPECT_EQ(check("noise=3").code, 0);
  const Outcome turned = check("turn_deg=5");
  EXPECT_EQ(turned.code, 4);
  EXPECT_TRUE(names(turned.out, "turned by 5.0° clockwise")) << turned.out;
  const Outcome scaled = check("scale_error=0.02");
  EXPECT_EQ(scaled.code, 4);
  EXPECT_TRUE(names(scaled.out, "2.0 % larger than expected")) << scaled.out;
}

TEST_F(WholeRig, TheBenchToStartFromIsWholeButForItsDevices) {
  good({"rig", "check", rig("bench.yaml"), "--set", "driver.type=simulated", "--set",
        "driver.waveforms=true", "--set", "camera.type=simulated", "--seconds", "0.1"});
  const Outcome outcome = run({"rig", "check", rig("bench.yaml"), "--seconds", "0.1", "--set",
                               "driver.port=/dev/none", "--set", "camera.device=/dev/none"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_NE(outcome.out.find("NO   camera    /dev/none: cannot open: No such file or directory"),
            std::string::npos)
      << outcome.out;
}

TEST_F(WholeRig, ADryRunSaysSoAndTheLogEndsWithZero) {
  const std::string scenario = MICROSWARM_SOURCE_DIR "/scenarios/papers/radar/single.yaml";
  const Outcome outcome = run({"rig", "run", scenario, "--rig", rig("vortex.yaml"), "--dry-run",
                               "--seconds", "0.5", "--out", "dry"});
  EXPECT_NE(outcome.err.find("dry run: no current is sent to the coils"), std::string::npos);
  EXPECT_NE(read("dry/index.html").find(", dry run<"), std::string::npos);
  const std::string dry = read("dry/commands.csv");
  EXPECT_EQ(dry.find("driven"), std::string::npos);
  EXPECT_TRUE(dry.ends_with(",,0,0,0,0,0,0,0,1,,dry,,,\n")) << dry.substr(dry.size() - 200);
  run({"rig", "run", scenario, "--rig", rig("vortex.yaml"), "--seconds", sanitized ? "5" : "1",
       "--out", "wet"});
  const std::string wet = read("wet/commands.csv");
  EXPECT_NE(wet.find(",driven,"), std::string::npos);
  EXPECT_TRUE(wet.ends_with(",1,,zero,,,\n")) << wet.substr(wet.size() - 200);
}

TEST_F(WholeRig, ARunTellsHowLongPicturesWaitForTheirCurrents) {
  const std::string scenario = MICROSWARM_SOURCE_DIR "/scenarios/papers/radar/single.yaml";
  const Outcome outcome =
      run({"rig", "run", scenario, "--rig", rig("vortex.yaml"), "--seconds", "1", "--set",
           "tick_s=0.02", "--set-rig", "camera.rate_hz=50", "--set-rig", "safety.max_pause_s=3",
           "--set-rig", "safety.missed_deadlines=1000", "--json"});
  const auto timing = nlohmann::json::parse(outcome.out)["rig_timing"];
  const auto& times = timing["camera_to_current"];
  EXPECT_GT(times["p50_ms"].get<double>(), 0);
  EXPECT_LE(times["p50_ms"].get<double>(), times["p99_ms"].get<double>());
  EXPECT_LE(times["p99_ms"].get<double>(), times["longest_ms"].get<double>());
  EXPECT_LE(timing["late_currents"].get<int>(), timing["frames_read"].get<int>());
}

TEST_F(WholeRig, ADeviceThatIsNotThereLeavesNoEmptyFolder) {
  const std::string scenario = MICROSWARM_SOURCE_DIR "/scenarios/papers/radar/single.yaml";
  const Outcome outcome = run({"rig", "run", scenario, "--rig", rig("bench.yaml"), "--set-rig",
                               "camera.device=none", "--dry-run", "--out", "a/b"});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_FALSE(exists("a"));
}

TEST_F(WholeRig, ARehearsalOnTheBenchIsRefusedBeforeItBegins) {
  const std::string scenario = MICROSWARM_SOURCE_DIR "/scenarios/papers/radar/single.yaml";
  refused({"rig", "simulate", scenario, "--rig", rig("bench.yaml")},
          rig("bench.yaml") + ":8:9: the camera is not simulated: set camera.type");
}

TEST_F(WholeRig, WhatIsWrongIsToldWhereItWasGiven) {
  refused({"rig", "check", rig("vortex.yaml"), "--set", "drive_rate_hz=20"},
          naming("--set drive_rate_hz", {"drive_rate_hz", "20", "16", "160"}));
  write("flight.yaml", two_rooms());
  refused({"run", "flight.yaml", "--rig", rig("vortex.yaml"), "--set-rig", "camera.foo=3"},
          naming("--set-rig camera.foo", {"foo", "microscope", "speed_error"}));
  refused({"run", "flight.yaml", "--rig", rig("ribbon.yaml"), "--set-rig", "drive_rate_hz=20"},
          naming("--set-rig drive_rate_hz", {"drive_rate_hz", "20", "16", "160"}));
}

}  // namespace
}  // namespace microswarm::test

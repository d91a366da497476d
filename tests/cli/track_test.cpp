// SPDX-License-Identifier: Apache-2.0
// Videos in, tracks out.
#include <cmath>
#include <nlohmann/json.hpp>

#include "inputs.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

class Track : public CommandLine {
 protected:
  /// Twelve dark discs of 9 px, 40 px apart, that move by a pixel a frame to the right and down.
  void film(const std::string& folder, int frames, int width = 200) const {
    fs::create_directories(at.folder / folder);
    for (int k = 0; k < frames; ++k)
      write(folder + "/f" + std::to_string(k) + ".pgm", pgm(width, 160, [&](int x, int y) {
              int grey = 200;
              for (int i = 0; i < 12; ++i) {
                const double dx = x - (30 + 40 * (i % 4) + k);
                const double dy = y - (30 + 40 * (i / 4) + k);
                if (dx * dx + dy * dy < 20) grey = 90;
              }
              return grey;
            }));
  }
};

TEST_F(Track, PicturesBecomeTables) {
  film("video", 12);
  const std::string text =
      good({"track", "video", "--um-per-px", "0.5", "--rate", "10", "--out", "out"});
  EXPECT_TRUE(text.starts_with("12 frames, 12.0 robots in each\n")) << text;
  EXPECT_NE(text.find("  events    0 merges, 0 splits\n"), std::string::npos) << text;
  EXPECT_NE(text.find("wrote out/tracks.csv, tracks.h5, events.csv and overlay"), std::string::npos)
      << text;
  const std::string csv = read("out/tracks.csv");
  EXPECT_TRUE(
      csv.starts_with("frame,id,t_s,x_um,y_um,vx_um_per_s,vy_um_per_s,radius_um,mass,"
                      "signal,eccentricity,particle,x,y\n0,0,0,15.25,64.75,"))
      << csv.substr(0, 200);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 12 * 12);
  EXPECT_TRUE(read("out/tracks.h5").starts_with("\x89HDF"));
  EXPECT_TRUE(read("out/events.csv").starts_with("frame,t_s,event,id,other\n0,0,birth,0,\n"));
  for (const std::string& name : files()) EXPECT_EQ(name.find(".tmp-"), std::string::npos) << name;
}

/// Noise without robots but for three dark discs.
std::function<int(int, int)> noisy(int k) {
  return [k](int x, int y) {
    const unsigned seed = static_cast<unsigned>(x * 7919 + y * 104729 + k * 15485863);
    const unsigned mixed = (seed ^ (seed >> 13)) * 2654435761U;
    int grey = 180 + static_cast<int>((mixed >> 20) % 9);
    for (int i = 0; i < 3; ++i) {
      const double dx = x - (40 + 50 * i + k);
      const double dy = y - 80;
      if (dx * dx + dy * dy < 20) grey -= 80;
    }
    return grey;
  };
}

TEST_F(Track, TablesHaveTheColumnsOfTrackpy) {
  film("video", 6);
  good({"track", "video", "--um-per-px", "0.5", "--rate", "10", "--out", "out"});
  write("read.py", R"(import csv
rows = list(csv.DictReader(open("out/tracks.csv", newline="")))
assert len(rows) == 6 * 12
for row in rows:
    frame, particle = int(row["frame"]), int(row["particle"])
    assert particle == int(row["id"])
    x, y = float(row["x"]), float(row["y"])
    assert abs(x - (30 + 40 * (particle % 4) + frame)) < 0.1, row
    assert abs(float(row["x_um"]) - 0.5 * (x + 0.5)) < 1e-9
    assert abs(float(row["y_um"]) - 0.5 * (160 - 0.5 - y)) < 1e-9
    assert abs(float(row["t_s"]) - frame / 10) < 1e-9
try:
    import pandas
except ImportError:
    raise SystemExit
table = pandas.read_csv("out/tracks.csv")
assert {"frame", "particle", "x", "y"} <= set(table.columns)
assert (table.groupby("particle").frame.count() == 6).all()
)");
  const std::string in_folder = "cd " + at.folder.string() + " && python3 read.py";
  EXPECT_EQ(std::system(in_folder.c_str()), 0);
}

TEST_F(Track, SuggestsWhatSeparatesRobotsFromNoise) {
  fs::create_directories(at.folder / "noisy");
  for (int k = 0; k < 8; ++k)
    write("noisy/f" + std::to_string(k) + ".pgm", pgm(200, 160, noisy(k)));
  const Json json = Json::parse(good({"track", "noisy", "--suggest", "--json"}));
  EXPECT_EQ(json.at("pictures"), 8);
  EXPECT_EQ(json.at("robots"), 3);
  EXPECT_GT(json.at("features"), 6);
  const std::string text = good({"track", "noisy", "--suggest", "--out", "masses"});
  EXPECT_NE(text.find("\n" + json.at("options").get<std::string>() + "\n"), std::string::npos);
  EXPECT_EQ(read("masses/masses.png").substr(1, 3), "PNG");
  const Outcome plain = run({"track", "noisy", "--um-per-px", "1", "--rate", "10", "--out", "a"});
  EXPECT_EQ(plain.code, 0);
  EXPECT_TRUE(is_one_line_naming(plain.err, "note", {"tracks", "frame", "--suggest"})) << plain.err;
  const Outcome set =
      run({"track", "noisy", "--um-per-px", "1", "--rate", "10", "--out", "b", "--set",
           "find.min_mass=" + std::to_string(json.at("min_mass").get<int>())});
  EXPECT_EQ(set.err, "");
  EXPECT_NE(set.out.find("8 frames, 3.0 robots in each"), std::string::npos) << set.out;
  write("noisy/f8.pgm", pgm(3, 2, [](int, int) { return 99; }));
  const Outcome odd = run({"track", "noisy", "--suggest"});
  EXPECT_EQ(odd.code, 0);
  EXPECT_TRUE(is_one_line_naming(odd.err, "note", {"f8.pgm", "3x2"})) << odd.err;
  refused({"track", "noisy", "--um-per-px", "1"}, naming("track", {"--out"}));
  refused({"track", "none.mp4", "--suggest"}, naming("none.mp4", {"No such file"}));
}

TEST_F(Track, LoneFastRobotsNeedARange) {
  fs::create_directories(at.folder / "fast");
  for (int k = 0; k < 9; ++k)
    write("fast/f" + std::to_string(k) + ".pgm", pgm(200, 40, [&](int x, int y) {
            const double dx = x - (20 + 18 * k);
            const double dy = y - 20;
            return dx * dx + dy * dy < 20 ? 220 : 40;
          }));
  const Arguments words{"track",  "fast",  "--um-per-px",      "0.5",   "--rate",
                        "10",     "--set", "find.tone=bright", "--out", "out",
                        "--json", "--set", "find.min_mass=100"};
  const Outcome alone = run(words);
  EXPECT_TRUE(is_one_line_naming(alone.err, "note", {"9 of 9", "2.5 µm", "track.search_range_um"}))
      << alone.err;
  EXPECT_EQ(Json::parse(alone.out).at("tracks_1_frame"), 9);
  Arguments wide = words;
  wide.insert(wide.end(), {"--set", "track.search_range_um=10"});
  const Outcome one = run(wide);
  EXPECT_EQ(one.err, "");
  EXPECT_EQ(Json::parse(one.out).at("tracks"), 1);
  EXPECT_EQ(Json::parse(one.out).at("search_range_um"), 10);
}

TEST_F(Track, OnlyInARegionOrAMask) {
  film("video", 12);
  const Arguments words{"track", "video", "--um-per-px", "0.5",    "--rate",
                        "10",    "--out", "out",         "--json", "--no-overlay"};
  const auto tracks = [&](Arguments more) {
    Arguments all = words;
    all.insert(all.end(), more.begin(), more.end());
    return Json::parse(good(all)).at("tracks").get<int>();
  };
  EXPECT_EQ(tracks({}), 12);
  EXPECT_EQ(tracks({"--region", "50,50,75,100"}), 4);  // two columns and two rows
  EXPECT_EQ(tracks({"--set", "region.x_px=50", "--set", "region.y_px=50", "--set",
                    "region.width_px=75", "--set", "region.height_px=100"}),
            4);
  write("mask.pgm", pgm(200, 160, [](int x, int) { return x < 60 ? 255 : 0; }));
  EXPECT_EQ(tracks({"--mask", "mask.pgm"}), 3);
  write("small.pgm", pgm(20, 10, [](int, int) { return 255; }));
  const auto bad = [&](Arguments more, const Complaint& line) {
    Arguments all = words;
    all.insert(all.end(), more.begin(), more.end());
    refused(all, line);
  };
  bad({"--mask", "small.pgm"}, naming("mask", {"20x10", "200x160"}));
  bad({"--region", "50,50,160,20"}, naming("region", {"210", "200x160"}));
  bad({"--region", "50,50,60"}, naming("--region", {"50,50,60", "X,Y,WIDTH,HEIGHT"}));
  bad({"--region", "50,50,0.5,9"}, naming("--region", {"whole pixels"}));
}

TEST_F(Track, SeveralVideosGetAFolderEach) {
  film("a/one", 6);
  film("b/one", 4);
  write("bad.mp4", std::string(3000, 'v'));
  const Outcome outcome = run({"track", "a/one", "bad.mp4", "b/one", "--um-per-px", "0.5", "--rate",
                               "10", "--out", "out", "--no-overlay"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(names(outcome.err, "bad.mp4: is no video that can be read")) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "1 of 3 videos")) << outcome.err;
  EXPECT_TRUE(read("out/one/tracks.csv").starts_with("frame,"));
  EXPECT_TRUE(read("out/one-2/tracks.csv").starts_with("frame,"));
  const std::string summary = read("out/summary.csv");
  EXPECT_NE(summary.find("\na/one,one,6,72,12,"), std::string::npos) << summary;
  EXPECT_NE(summary.find("\nb/one,one-2,4,48,12,"), std::string::npos) << summary;
  EXPECT_NE(summary.find("\nbad.mp4,bad,"), std::string::npos) << summary;
  const Json all = Json::parse(good({"track", "a/one", "b/one", "--um-per-px", "0.5", "--rate",
                                     "10", "--out", "out", "--no-overlay", "--json"}));
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].at("video"), "b/one");
  EXPECT_EQ(all[1].at("features"), 48);
}

TEST_F(Track, MotionIsWrittenAndDrawn) {
  film("video", 12);
  const Outcome outcome = run({"track", "video", "--um-per-px", "0.5", "--rate", "10", "--out",
                               "out", "--no-overlay", "--motion", "--json"});
  const Json motion = Json::parse(outcome.out).at("motion");
  EXPECT_NEAR(motion.at("msd_exponent"), 2, 0.01);
  EXPECT_NEAR(motion.at("median_speed_um_per_s"), 5 * std::sqrt(2.0), 0.05);
  EXPECT_TRUE(read("out/msd.csv")
                  .starts_with("lag,lag_s,msd_um2,standard_error_um2,tracks,displacements\n1,0."))
      << read("out/msd.csv");
  EXPECT_TRUE(read("out/drift.csv").starts_with("frame,t_s,x_um,y_um,robots\n0,0,0,0,0\n1,0.1,"))
      << read("out/drift.csv");
  EXPECT_TRUE(read("out/robots.csv").starts_with("id,first_frame,frames,duration_s,path_um,"));
  for (const std::string file : {"trajectories.png", "motion.png"})
    EXPECT_EQ(read("out/" + file).substr(1, 3), "PNG") << file;
  // All move alike, so nothing is left without the drift.
  const Outcome still = run({"track", "video", "--um-per-px", "0.5", "--rate", "10", "--out", "out",
                             "--no-overlay", "--motion", "--remove-drift"});
  EXPECT_EQ(still.code, 0) << still.err;
  EXPECT_NE(still.out.find("msd.csv"), std::string::npos) << still.out;
  refused({"track", "video", "--um-per-px", "1", "--out", "out", "--remove-drift"},
          naming("track", {"--remove-drift", "--motion"}));
}

TEST_F(Track, CentresThatDidNotSettleAreTold) {
  fs::create_directories(at.folder / "large");
  for (int k = 0; k < 2; ++k)
    write("large/f" + std::to_string(k) + ".pgm", pgm(300, 200, [&](int x, int y) {
            const double dx = x - 150;
            const double dy = y - 100;
            return (dx * dx + dy * dy < 50 * 50 ? 60 : 180) + (x * 7919 + y * 104729 + k) % 5;
          }));
  const Arguments words{"track",
                        "large",
                        "--um-per-px",
                        "1",
                        "--rate",
                        "10",
                        "--json",
                        "--set",
                        "find.diameter_px=115",
                        "--out",
                        "out",
                        "--set",
                        "find.min_mass=10000"};
  const Outcome free = run(words);
  EXPECT_EQ(free.err, "");
  EXPECT_EQ(Json::parse(free.out).at("unsettled"), 0);
  EXPECT_EQ(Json::parse(free.out).at("features"), 2);
  Arguments limited = words;
  limited.insert(limited.end(), {"--set", "find.max_moves=1"});
  const Outcome stopped = run(limited);
  EXPECT_TRUE(is_one_line_naming(stopped.err, "note", {"2 of 2", "find.max_moves=1"}))
      << stopped.err;
  EXPECT_EQ(Json::parse(stopped.out).at("unsettled"), 2);
}

TEST_F(Track, JsonTellsDriftAndSpeed) {
  film("video", 12);
  const Json json = Json::parse(good({"track", "video", "--um-per-px", "0.5", "--rate", "10",
                                      "--out", "out", "--json", "--no-overlay"}));
  EXPECT_EQ(json.at("frames"), 12);
  EXPECT_EQ(json.at("features"), 144);
  EXPECT_EQ(json.at("tracks"), 12);
  EXPECT_EQ(json.at("tracks_10_frames"), 12);
  EXPECT_NEAR(json.at("drift_um")[0], 5.5, 0.01);
  EXPECT_NEAR(json.at("drift_um")[1], -5.5, 0.01);
  EXPECT_NEAR(json.at("mean_speed_um_per_s"), 5 * std::sqrt(2.0), 0.01);
  EXPECT_FALSE(exists("out/overlay.mp4"));
}

TEST_F(Track, ShortTracksTellNoSpeed) {
  film("video", 8);
  const Arguments words{"track", "video", "--um-per-px", "0.5",         "--rate",
                        "10",    "--out", "out",         "--no-overlay"};
  EXPECT_NE(good(words).find("drift     –, speed –: no track is long enough"), std::string::npos);
  Arguments in_json = words;
  in_json.push_back("--json");
  const Json json = Json::parse(good(in_json));
  EXPECT_TRUE(json.at("drift_um").is_null());
  EXPECT_TRUE(json.at("mean_speed_um_per_s").is_null());
  EXPECT_EQ(json.at("frames_promised"), 8);
}

TEST_F(Track, NeverWritesOverWhatItReads) {
  film("out/overlay", 3);
  const auto before = read("out/overlay/f0.pgm");
  refused({"track", "out/overlay", "--um-per-px", "1", "--rate", "10", "--out", "out"},
          "out/overlay: is the input, which would be lost");
  EXPECT_EQ(read("out/overlay/f0.pgm"), before);
  write("out/overlay.mp4", "an older one");
  film("video", 3);
  good({"track", "video", "--um-per-px", "1", "--rate", "10", "--out", "out", "--no-overlay"});
  EXPECT_FALSE(exists("out/overlay.mp4"));  // it shows other tracks
}

TEST_F(Track, WhatAKilledOneLeftIsClearedAway) {
  film("video", 3);
  fs::create_directories(at.folder / "out");
  const std::string alive = "out/tracks.tmp-microswarm-" + std::to_string(::getpid()) + "-0.h5";
  write("out/tracks.tmp-microswarm-999999999-0.h5", "of a program that is no more");
  write(alive, "of one that runs");
  write("out/mine.tmp-1999-12-31.csv", "of the user");
  good({"track", "video", "--um-per-px", "1", "--rate", "10", "--out", "out", "--no-overlay"});
  EXPECT_FALSE(exists("out/tracks.tmp-microswarm-999999999-0.h5"));
  EXPECT_TRUE(exists(alive));
  EXPECT_TRUE(exists("out/mine.tmp-1999-12-31.csv"));
}

TEST_F(Track, TheSameVideoGivesTheSameBytes) {
  film("video", 11);
  write("track.yaml", "um_per_px: 0.5\nrate_hz: 10\nfind:\n  diameter_px: 9\n");
  good({"track", "video", "--config", "track.yaml", "--out", "a", "--no-overlay"});
  good({"track", "video", "--config", "track.yaml", "--out", "b", "--no-overlay"});
  for (const std::string name : {"tracks.csv", "tracks.h5", "events.csv"})
    EXPECT_EQ(read("a/" + name), read("b/" + name)) << name;
}

TEST_F(Track, BadInputIsRefused) {
  film("video", 3);
  const auto bad = [&](Arguments more, const Complaint& line) {
    Arguments words{"track"};
    words.insert(words.end(), more.begin(), more.end());
    refused(words, line);
  };
  bad({"video", "--out", "out"}, naming("video", {"missing", "--um-per-px"}));
  bad({"none.mp4", "--um-per-px", "1", "--out", "out"},
      "none.mp4: cannot read: No such file or directory");
  write("zero.yaml", "um_per_px: 0\n");
  const Outcome zero = run({"track", "video", "--config", "zero.yaml", "--out", "out"});
  EXPECT_EQ(zero.code, 2);
  EXPECT_TRUE(zero.err.starts_with("microswarm: zero.yaml:1:")) << zero.err;
  EXPECT_EQ(run({"track", "video", "--um-per-px", "0", "--out", "out"}).code, 2);
  write("video.mp4", std::string(3000, 'v'));
  bad({"video.mp4", "--um-per-px", "1", "--out", "out"}, "video.mp4: is no video that can be read");
  fs::create_directories(at.folder / "nothing");
  bad({"nothing", "--um-per-px", "1", "--out", "out"},
      naming("nothing", {"PNG", "JPEG", "BMP", "PGM", "PPM"}));
}

TEST_F(Track, TimesOfATableAreThoseOfTheTracks) {
  film("video", 12);
  std::string times = "picture;t_s\n";
  for (int k = 0; k < 12; ++k)
    times += std::to_string(k) + ";" + std::to_string(5 + (k < 6 ? 0.1 * k : 0.5 * k - 2)) + "\n";
  write("times.csv", times);
  const Arguments words{"track", "video",   "--um-per-px", "0.5",   "--out",
                        "out",   "--times", "times.csv",   "--json"};
  const Json json = Json::parse(good(words));
  EXPECT_EQ(json.at("notes"), Json::array());
  // 0.5 µm a picture each way, in 3.5 - 0 = 3.5 s for eleven steps.
  EXPECT_NEAR(json.at("mean_speed_um_per_s"), 11 * 0.5 * std::sqrt(2.0) / 3.5, 0.01);
  const std::string csv = read("out/tracks.csv");
  EXPECT_NE(csv.find("\n0,0,5,"), std::string::npos);
  EXPECT_NE(csv.find("\n11,0,8.5,"), std::string::npos);
  EXPECT_TRUE(read("out/events.csv").starts_with("frame,t_s,event,id,other\n0,5,birth,0,\n"));
  Arguments both = words;
  both.insert(both.end(), {"--rate", "10"});
  refused(both, naming("times.csv", {"rate"}));
  write("times.csv", "0\n1\n");
  refused(words, "times.csv: 2 times, there are 12 pictures");
  write("times.csv", "0\n1\n1\n");
  refused(words, "times.csv:3: time 1 s is not after 1 s");
}

TEST_F(Track, GapsInNamesAreGapsInTimeAndTold) {
  film("video", 12);
  for (int k = 11; k >= 6; --k)
    fs::rename(at.folder / ("video/f" + std::to_string(k) + ".pgm"),
               at.folder / ("video/f" + std::to_string(k + 20) + ".pgm"));
  const Outcome outcome = run({"track", "video", "--um-per-px", "0.5", "--rate", "10", "--out",
                               "out", "--no-overlay", "--json"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(is_one_line_naming(outcome.err, "note", {"1 gap", "f5.pgm and f26.pgm"}))
      << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out).at("notes").size(), 1U);
  // The gap is longer than the memory of tracks, so others begin after it.
  EXPECT_NE(read("out/tracks.csv").find("\n6,12,2.6,"), std::string::npos);
}

TEST_F(Track, NamesOfSeveralNumbersAskForTimes) {
  film("video", 12);
  for (int k = 0; k < 12; ++k)
    fs::rename(at.folder / ("video/f" + std::to_string(k) + ".pgm"),
               at.folder / ("video/f" + std::to_string(k / 4) + "_" + std::to_string(k) + ".pgm"));
  const Outcome outcome =
      run({"track", "video", "--um-per-px", "0.5", "--rate", "10", "--out", "out", "--no-overlay"});
  EXPECT_TRUE(names(outcome.err, "gaps need --times")) << outcome.err;
}

TEST_F(Track, APictureThatCannotBeReadEndsAFolder) {
  film("video", 3, 300);
  write("video/f9.pgm", pgm(20, 20, [](int, int) { return 7; }));
  const Outcome outcome =
      run({"track", "video", "--um-per-px", "1", "--rate", "10", "--out", "out"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(names(outcome.err, "the tracks end at picture 3: video/f9.pgm: ")) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("3 frames, ")) << outcome.out;
  EXPECT_TRUE(exists("out/tracks.csv"));
}

TEST_F(Track, CtrlCKeepsWhatThereIs) {
  film("video", 1, 300);
  for (int k = 1; k < 3000; ++k)
    fs::create_symlink("f0.pgm", at.folder / "video" / ("f" + std::to_string(k) + ".pgm"));
  Program program({"track", "video", "--um-per-px", "1", "--rate", "10", "--out", "out", "--json"},
                  at);
  program.let_work(700);
  ASSERT_TRUE(program.running());
  program.send(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const int frames = Json::parse(outcome.out).at("frames");
  EXPECT_GT(frames, 0);
  EXPECT_LT(frames, 3000);
  EXPECT_TRUE(exists("out/tracks.csv"));
  EXPECT_TRUE(exists("out/tracks.h5"));
  for (const std::string& name : files()) EXPECT_EQ(name.find(".tmp-"), std::string::npos) << name;
}

}  // namespace
}  // namespace microswarm::test

// SPDX-License-Identifier: Apache-2.0
// The console of a rig in real time: what drives the coils, and all that sets them to zero.
#include <fmt/format.h>

#include "microswarm/experiment/record/record.hpp"
#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;

ServerOptions with_rig() {
  const fs::path scenarios = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  return {.opening = Opening{
              .file = scenarios / "first_rig.yaml",
              .options = {.rig = scenarios / "rigs/vortex.yaml",
                          // A busy computer is no fault here.
                          .rig_settings = {"safety.lost_swarm_s=20", "safety.max_frame_age_s=20",
                                           "safety.deadman_s=20", "safety.max_pause_s=20",
                                           "safety.missed_deadlines=1000"}},
              .live = RigOpening{}}};
}

const auto is_armed = [](const Json& rig) { return rig["state"] == "armed"; };
const auto is_at_zero = [](const Json& rig) { return rig["state"] == "ended"; };
const auto drives = [](const Json& rig) {
  return rig["state"] == "armed" && rig.contains("currents_a") && !rig["currents_a"].empty();
};

class LabRig : public testing::Test {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the thread sanitizer does not see into OpenCV's threads";
#endif
    lab.emplace(with_rig());
    session = open(*lab, Json::object());
  }

  /// A page with the controls whose messages are read until the coils are driven. On a busy
  /// computer it may have been silent for too long, which stops it: then once more.
  void arm(TestPage& page) {
    for (int attempt = 0; attempt < 10; ++attempt) {
      page.say(R"({"do": "beat"})");
      page.does({{"do", "arm"}});
      const Json rig =
          beat_until(page, [](const Json& one) { return drives(one) || one["state"] == "ended"; });
      if (drives(rig)) return;
    }
    FAIL() << page.latest["rig"];
  }
  /// The rig in a state, if it is not in it already.
  Json rig_in(TestPage& page, const std::string& state) {
    if (page.latest.contains("rig") && page.latest["rig"]["state"] == state)
      return page.latest["rig"];
    return page.until("rig", [&](const Json& rig) { return rig["state"] == state; });
  }
  /// Says every message that it is there, until the rig is as asked.
  template <class Is>
  Json beat_until(TestPage& page, Is&& is) {
    return page.until("rig", [&](const Json& rig) {
      page.say(R"({"do": "beat"})");
      return is(rig);
    });
  }
  /// Seconds until the coils are at zero, as another page hears it.
  double seconds_to_zero(TestPage& watcher, Stop::Clock::time_point began) {
    const Json rig = rig_in(watcher, "ended");
    const double took = seconds_since(began);
    EXPECT_EQ(rig["zero_confirmed"], true) << rig;
    why = rig.value("why", "");
    std::printf("coils at zero after %.3f s: %s\n", took, why.c_str());
    return took;
  }

  std::optional<Lab> lab;
  std::uint64_t session = 0;
  std::string why;
  static constexpr const char* silence = "no word from the page for 0.4 s";
  static constexpr double soon = 5;  // [s] even on a busy computer
};

TEST_F(LabRig, BeginsAsADryRunWithPictures) {
  TestPage page(*lab, session);
  const Json hello = page.next();
  EXPECT_EQ(hello["type"], "hello");
  EXPECT_EQ(hello["live"], true);
  EXPECT_EQ(hello["playback"], false);
  EXPECT_EQ(hello["rig_info"]["coils"].size(), 3u);
  EXPECT_EQ(hello["rig_info"]["real_coils"], false);
  const Json picture = page.until("picture");
  EXPECT_EQ(picture["to_um"].size(), 6u);
  const auto& jpeg = picture["jpeg"].get_binary();
  ASSERT_GT(jpeg.size(), 100u);
  EXPECT_EQ(jpeg[0], 0xFF);
  EXPECT_EQ(jpeg[1], 0xD8);
  const Json rig = page.until("rig", [](const Json& one) { return one.value("ticks", 0) > 3; });
  EXPECT_EQ(rig["state"], "dry");
  // Its record is not copied for a branch, which cannot be.
  const Json asked{{"branch", session}, {"frame", 0}};
  const Reply refused = ask(*lab, http::verb::post, "/api/sessions", asked.dump());
  EXPECT_NE(refused.body().find("a run on a rig cannot be repeated"), std::string::npos)
      << refused.body();
  // The swarm stays where it is.
  const Json frame = page.until("frame", [](const Json& one) { return one["number"] > 5; });
  EXPECT_NEAR(frame["frame"]["x_um"].get<double>(), 1100, 2);
  EXPECT_EQ(page.latest["controls"]["holds"], true);
  const Json listed = Json::parse(get(*lab, "/api/sessions").body())["sessions"];
  EXPECT_GE(listed[0]["t_s"], frame["frame"]["t_s"]);
  TestPage watcher(*lab, session);
  watcher.does({{"do", "ping"}});
}

TEST_F(LabRig, DrivesOnlyWhenArmedAndStopsAtOnce) {
  TestPage page(*lab, session);
  EXPECT_EQ(page.issues({{"do", "arm"}}).size(), 1u);  // it was silent
  arm(page);
  const auto began = Stop::Clock::now();
  page.ask({{"do", "stop"}});
  EXPECT_LT(seconds_to_zero(page, began), soon);
  EXPECT_TRUE(why == "a page stopped it" || why == silence) << why;
  // It can be armed again, and looked back at.
  page.does({{"do", "seek"}, {"number", 0}});
  arm(page);
  page.does({{"do", "dry"}});
  EXPECT_EQ(rig_in(page, "dry")["why"], "");
}

TEST_F(LabRig, TheRecordSoFarIsKeptWhileItDrives) {
  ServerOptions options = with_rig();
  const test::Folder folder;
  options.opening->live->out = folder / "runs";
  std::vector<std::string> faults;
  options.opening->live->ended = [&](const std::string& fault) { faults.push_back(fault); };
  lab.emplace(options);
  session = open(*lab, Json::object());
  TestPage page(*lab, session);
  arm(page);
  const fs::path runs = page.latest["rig"]["folder"].get<std::string>();
  EXPECT_EQ(runs.parent_path(), folder / "runs");
  beat_until(page, [&](const Json&) { return fs::exists(runs / "run.part.h5"); });
  EXPECT_FALSE(experiment::read_record(runs / "run.part.h5").frames.empty());
  page.does({{"do", "stop"}});
  rig_in(page, "ended");
  EXPECT_FALSE(fs::exists(runs / "run.part.h5"));
  const experiment::Record record = experiment::read_record(runs / "run.h5");
  EXPECT_GT(record.frames.size(), 10u);
  // Who presses STOP ends it; that is no fault.
  EXPECT_EQ(record.result.status, Status::stopped);
  EXPECT_EQ(faults, std::vector<std::string>{""});
  EXPECT_EQ(page.latest["rig"]["why"], "a page stopped it");
}

TEST_F(LabRig, SteersByHand) {
  TestPage page(*lab, session);
  arm(page);
  ASSERT_FALSE(beat_until(page, drives).is_null());
  const double x = page.latest["frame"]["frame"]["x_um"].get<double>();
  page.does({{"do", "manual"}, {"on", true}});
  const Json moved = page.until("frame", [&](const Json& frame) {
    page.say(R"({"do": "beat"})");
    page.say(R"({"do": "steer", "heading": 3.14159, "speed": 40})");
    return frame["frame"]["x_um"] < x - 10;
  });
  EXPECT_FALSE(moved.is_null());
}

TEST_F(LabRig, APageThatClosesStopsIt) {
  std::optional<TestPage> page(std::in_place, *lab, session);
  page->next();
  // A second page takes nothing away.
  TestPage watcher(*lab, session);
  EXPECT_EQ(watcher.issues({{"do", "arm"}})[0]["text"], "another page has the controls");
  EXPECT_EQ(watcher.issues({{"do", "hold"}, {"on", true}}).size(), 1u);
  EXPECT_EQ(watcher.issues({{"do", "control"}}).size(), 1u);
  arm(*page);
  const auto began = Stop::Clock::now();
  page.reset();
  EXPECT_LT(seconds_to_zero(watcher, began), soon);
  EXPECT_TRUE(why == "the page with the controls is gone" || why == silence) << why;
  // It may still be there for the lab.
  for (int i = 0; i < 1000 && watcher.issues({{"do", "control"}}).size() == 1; ++i) {
  }
  EXPECT_EQ(watcher.latest["controls"]["holds"], true);
}

TEST_F(LabRig, APageThatOnlyWatchesCanStopIt) {
  TestPage page(*lab, session), watcher(*lab, session);
  watcher.next();
  arm(page);
  const auto began = Stop::Clock::now();
  watcher.ask({{"do", "stop"}});
  EXPECT_LT(seconds_to_zero(watcher, began), soon);
}

TEST_F(LabRig, SilenceStopsIt) {
  TestPage page(*lab, session), watcher(*lab, session);
  watcher.next();
  arm(page);
  // The stream stays open, as when a network is cut.
  const auto began = Stop::Clock::now();
  EXPECT_LT(seconds_to_zero(watcher, began), soon);
  EXPECT_EQ(why, silence);
}

TEST_F(LabRig, AFloodAndAPageThatNeverReadsDoNotDelayAStop) {
  TestPage page(*lab, session);
  TestPage deaf(*lab, session, {}, 4096);
  arm(page);
  for (int i = 0; i < 2000; ++i) deaf.say(i % 2 ? "garbage" : R"({"do": "beat"})");
  beat_until(page, drives);
  const auto began = Stop::Clock::now();
  page.ask({{"do", "stop"}});
  EXPECT_LT(seconds_to_zero(page, began), soon);
}

TEST_F(LabRig, AStopAfterArmingIsNotUndoneByIt) {
  TestPage page(*lab, session);
  page.say(R"({"do": "beat"})");
  page.ask({{"do", "arm"}});
  page.ask({{"do", "stop"}});
  const Json rig = page.until("rig", is_at_zero);
  EXPECT_NE(rig["why"], "");
}

TEST_F(LabRig, ClosingTheSessionOrTheLabStopsIt) {
  TestPage page(*lab, session);
  arm(page);
  EXPECT_EQ(ask(*lab, http::verb::delete_, fmt::format("/api/sessions/{}", session)).result(),
            http::status::ok);
  while (!page.next().is_null()) {
  }
  session = 0;
  for (int i = 0; i < 100 && session == 0; ++i) {
    const Reply reply = ask(*lab, http::verb::post, "/api/sessions", "{}");
    if (reply.result() == http::status::ok) session = Json::parse(reply.body())["session"];
    std::this_thread::sleep_for(50ms);
  }
  TestPage again(*lab, session);
  arm(again);
  EXPECT_LT(lab->end(), soon);
}

TEST_F(LabRig, DownloadsWaitForTheEndOfARunThatDrives) {
  TestPage page(*lab, session);
  const std::string record = fmt::format("/api/sessions/{}/record.h5", session);
  EXPECT_EQ(get(*lab, record).result(), http::status::ok);
  arm(page);
  EXPECT_EQ(get(*lab, record).result(), http::status::conflict);
  page.ask({{"do", "stop"}});
  rig_in(page, "ended");
  const Reply reply = get(*lab, record);
  ASSERT_EQ(reply.result(), http::status::ok);
  EXPECT_EQ(experiment::read_record(lab->folder.with("run.h5", reply.body())).result.status,
            Status::stopped);
}

TEST_F(LabRig, OneRigIsOneSession) { EXPECT_EQ(open(*lab, Json::object()), session); }

}  // namespace
}  // namespace microswarm::lab

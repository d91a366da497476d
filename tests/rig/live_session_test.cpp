// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/session/live_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "tests/files.hpp"

namespace microswarm::rig {
namespace {

RigExperiment open_simulated(const std::vector<std::string>& rig_settings = {}) {
  const std::filesystem::path scenarios =
      std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  return open_rig_experiment(scenarios / "papers/radar/single.yaml", {},
                             scenarios / "rigs/vortex.yaml", {rig_settings, ""});
}

TEST(LiveSession, TellsOnceWhatIsNoLongerKeptAndThatTheDiskIsNearlyFull) {
  const test::Folder folder;
  double free = 1e12;
  LiveSession live(open_simulated(), {.dry = true,
                                      .folder = folder / "",
                                      .max_logged = 5,
                                      .free_space = [&](const auto&) { return free; }});
  free = 1e6;
  std::vector<std::string> notes;
  for (int tick = 0; tick < 15; ++tick) {
    if (!live.session().step()) break;
    for (std::string& note : live.take_notes()) notes.push_back(std::move(note));
  }
  live.close();
  for (const char* of : {"values of the currents", "sightings", "1 MB"})
    EXPECT_EQ(
        std::ranges::count_if(notes, [&](const auto& note) { return note.find(of) != note.npos; }),
        1)
        << of;
  live.session().record_to(folder / "run.h5");
  const experiment::RigLog log = experiment::read_record(folder / "run.h5").rig_log;
  ASSERT_TRUE(log.currents_until && log.seen_until);
  EXPECT_EQ(*log.currents_until, log.driven_at.back());
  EXPECT_EQ(*log.seen_until, log.seen_at.back());
}

TEST(LiveSession, IsRefusedWithoutSpaceForItsLongestRun) {
  const test::Folder folder;
  LiveOptions options{
      .dry = true, .folder = folder / "", .free_space = [](const auto&) { return 1e6; }};
  EXPECT_THROW(LiveSession(open_simulated(), options), InputError);
  options.seconds = 5;  // a short one is not
  EXPECT_NO_THROW(LiveSession(open_simulated(), options));
}

// A camera that is 8 px off from the start: refused before the first current, told in a dry run.
TEST(LiveSession, AMapThatDoesNotLieOverThePictureIsRefused) {
  const std::vector<std::string> displaced{"camera.type=simulated",
                                           "camera.microscope.shift_px=[8, 0]"};
  int driven = 0;
  const std::string refusal = test::error_of(
      [&] { LiveSession(open_simulated(displaced), {.driven = [&] { ++driven; }}); });
  EXPECT_NE(refusal.find("the walls are up to 8.0 px"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("microswarm rig scale"), std::string::npos) << refusal;
  EXPECT_EQ(driven, 0);
  const auto warnings = [&](const std::string& setting, bool dry) {
    std::vector<std::string> settings = displaced;
    settings.push_back(setting);
    return LiveSession(open_simulated(settings), {.dry = dry}).warnings();
  };
  ASSERT_EQ(warnings("safety.max_map_shift_px=5", true).size(), 1u);
  ASSERT_EQ(warnings("safety.max_map_shift_px=0", false).size(), 1u);
  EXPECT_NE(warnings("safety.max_map_shift_px=0", false).front().find("there is no limit"),
            std::string::npos);
  EXPECT_EQ(warnings("camera.microscope.shift_px=[1, 0]", false).size(), 0u);
}

TEST(LiveSession, ABumpOfTheCameraEndsTheRunAndIsInItsRecord) {
  const test::Folder folder;
  LiveSession live(
      open_simulated({"camera.type=simulated", "camera.microscope.um_per_px=6",
                      "camera.microscope.shift_px=[8, 0]", "camera.microscope.moved_after_s=2",
                      "safety.deadman_s=5", "safety.max_frame_age_s=5", "safety.max_pause_s=5",
                      "safety.lost_swarm_s=5"}),
      {.folder = folder / ""});
  EXPECT_TRUE(live.warnings().empty());
  for (int tick = 0; tick < 200 && live.session().step(); ++tick) {
  }
  live.close();
  EXPECT_NE(live.fault().find("from their place in the picture"), std::string::npos)
      << live.fault();
  live.session().record_to(folder / "run.h5");
  const experiment::RigLog log = experiment::read_record(folder / "run.h5").rig_log;
  ASSERT_GE(log.pictures.size(), 3u);
  EXPECT_LT(log.pictures.front().shift_px, 1);
  EXPECT_NEAR(log.pictures.front().light, 1, 0.01);
  EXPECT_NEAR(log.pictures.front().focus, 1, 0.05);
  EXPECT_LT(log.pictures.back().t, 20);
  EXPECT_GT(live.live().look_times().count(), 1u);
  EXPECT_GT(live.live().picture_state().largest_shift_px, 6);
}

}  // namespace
}  // namespace microswarm::rig

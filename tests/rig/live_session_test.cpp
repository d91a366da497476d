// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/session/live_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "tests/files.hpp"

namespace microswarm::rig {
namespace {

RigExperiment open_simulated() {
  const std::filesystem::path scenarios =
      std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  return open_rig_experiment(scenarios / "papers/radar/single.yaml", {},
                             scenarios / "rigs/vortex.yaml", {});
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

}  // namespace
}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/session/open_on_rig.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "tests/files.hpp"

namespace microswarm::rig {
namespace {

namespace fs = std::filesystem;

const fs::path shipped = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios";
const fs::path s_channel = shipped / "papers/drrt/s_channel.yaml";

std::string hash_of(experiment::Session& session) {
  session.finish();
  return session.record().hash();
}

TEST(OpenOnRig, AShippedScenarioRunsThroughARigAndWithout) {
  const RigSessionOptions options{.settings = {"time_limit_s=1"},
                                  .rig = shipped / "rigs/ribbon.yaml"};
  const auto plain = open_on_rig(s_channel, {.settings = options.settings});
  const auto rig = open_on_rig(s_channel, options);
  EXPECT_NE(hash_of(*plain), hash_of(*rig));
  EXPECT_EQ(plain->record().rig, "");
  EXPECT_FALSE(rig->record().rig.empty());
}

TEST(OpenOnRig, TheTrialSelectsTheStreamsOfTheRigToo) {
  const RigExperiment on =
      open_rig_experiment(s_channel, {"time_limit_s=1"}, shipped / "rigs/ribbon.yaml", {});
  EXPECT_EQ(hash_of(*open_on_rig(on, 1)), hash_of(*open_on_rig(on, 1)));
  EXPECT_NE(hash_of(*open_on_rig(on, 1)), hash_of(*open_on_rig(on, 2)));
}

TEST(OpenOnRig, ADisplacedCameraIsRefusedUnlessThereIsNoLimit) {
  const std::vector<std::string> displaced{"camera.type=simulated",
                                           "camera.microscope.shift_px=[8, 0]"};
  const auto open = [&](const char* setting) {
    std::vector<std::string> settings = displaced;
    settings.push_back(setting);
    open_on_rig(open_rig_experiment(s_channel, {"time_limit_s=1"}, shipped / "rigs/ribbon.yaml",
                                    {settings, ""}));
  };
  EXPECT_NE(test::error_of([&] { open("camera.microscope.noise=3"); }).find("8.0 px"),
            std::string::npos);
  EXPECT_NO_THROW(open("safety.max_map_shift_px=0"));
  EXPECT_NO_THROW(open("camera.microscope.moved_after_s=1"));
}

TEST(OpenOnRig, ValuesOfARigNeedARigAndRecordsNone) {
  EXPECT_THROW(open_on_rig(s_channel, {.rig_settings = {"drive_rate_hz=100"}}), InputError);
  const test::Folder folder;
  const auto session = experiment::open_session(s_channel, {"time_limit_s=1"});
  session->record_to(folder / "run.h5");
  EXPECT_TRUE(open_on_rig(folder / "run.h5", {})->is_playback());
  EXPECT_THROW(open_on_rig(folder / "run.h5", {.rig = "rig.yaml"}), InputError);
}

}  // namespace
}  // namespace microswarm::rig

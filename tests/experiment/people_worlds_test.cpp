// SPDX-License-Identifier: Apache-2.0
// People who avoid one another (ORCA), and recorded discs (DynaBARN).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <variant>
#include <vector>

#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/scenes/avoidance_worlds.hpp"
#include "microswarm/scenes/dynabarn.hpp"
#include "microswarm/scenes/orca.hpp"
#include "microswarm/scenes/orca_crowd.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::experiment {
namespace {

using scenes::OrcaAgent;

TEST(Orca, AloneItHasThePreferredVelocityUpToItsLimit) {
  const std::vector<OrcaAgent> alone{{.preferred = {3, 4}, .radius = 1, .max_speed = 10}};
  EXPECT_EQ(scenes::orca_velocities(alone, 5, 0.1)[0], (Vec2{3, 4}));
  const std::vector<OrcaAgent> slow{{.preferred = {3, 4}, .radius = 1, .max_speed = 1}};
  EXPECT_NEAR(norm(scenes::orca_velocities(slow, 5, 0.1)[0] - Vec2{0.6, 0.8}), 0, 1e-12);
}

/// Both do half of the change that the cut-off disc of the velocity obstacle asks for.
TEST(Orca, TwoThatMeetDoHalfEach) {
  const std::vector<OrcaAgent> pair{
      {.position = {0, 0}, .velocity = {1, 0}, .preferred = {1, 0}, .radius = 1, .max_speed = 2},
      {.position = {4, 0}, .velocity = {-1, 0}, .preferred = {-1, 0}, .radius = 1, .max_speed = 2}};
  const std::vector<Vec2> velocities = scenes::orca_velocities(pair, 1, 0.1);
  // 4 µm apart, 2 µm/s of approach: after 1 s they touch, which is allowed.
  EXPECT_NEAR(norm(velocities[0] - Vec2{1, 0}), 0, 1e-12);
  std::vector<OrcaAgent> near = pair;
  near[1].position.x = 3.5;
  const std::vector<Vec2> slower = scenes::orca_velocities(near, 1, 0.1);
  EXPECT_NEAR(norm(slower[0] + slower[1]), 0, 1e-12);
  EXPECT_LE(norm(slower[0]), 1 + 1e-12);
  // The relative velocity leaves the obstacle: after 1 s they touch at most.
  EXPECT_GE(norm(Vec2{3.5, 0} - (slower[0] - slower[1])), 2 - 1e-9);
}

TEST(OrcaCrowd, PeopleReachTheOtherSideWithoutContact) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const Scenario s = scenes::orca_crowd_scenario(seed);
    ASSERT_EQ(s.obstacles.size(), 5u);
    std::vector<const Samples*> tracks;
    for (const Obstacle& person : s.obstacles)
      tracks.push_back(find_track(person.motion)->samples.get());
    for (const Samples* a : tracks) {
      EXPECT_LT(distance(a->points.front(), -a->points.back()), 5);
      for (const Samples* b : tracks)
        for (std::size_t k = 0; a != b && k < a->points.size(); ++k)
          EXPECT_GE(distance(a->points[k], b->points[k]), 60) << k;
      for (std::size_t k = 1; k < a->points.size(); ++k)
        EXPECT_LE(distance(a->points[k], a->points[k - 1]), 100 * 0.25 + 1e-9);
    }
    EXPECT_TRUE(validate(s, scenes::avoidance_world(s)).empty());
  }
}

// A disc is not swept from the end of its lap to the begin of the next one.
TEST(Dynabarn, DiscsAppearAgainWhereTheirLapBegins) {
  const test::Folder folder;
  folder.with("tracks.csv", "plugin,t_s,x_m,y_m\nhardlibobs_1,0,1,2\nhardlibobs_1,10,3,2\n");
  folder.with("worlds.csv", "world,plugin\n0,hardlibobs_1\n");
  const std::vector<scenes::DynabarnWorld> worlds = scenes::read_dynabarn(folder / "");
  ASSERT_EQ(worlds.size(), 1u);
  EXPECT_EQ(worlds[0].level, scenes::DynabarnLevel::hard);
  const Scenario s = scenes::dynabarn_scenario(worlds[0], 200);
  for (const double t : {0.0, 5.0, 10.0, 15.0, 47.0, 99.9}) {
    std::vector<Placement> present;
    for (const Obstacle& disc : s.obstacles) {
      EXPECT_LE(top_speed(disc.motion), 20 + 1e-9);
      if (const Placement at = placement(disc.motion, t); at.present) present.push_back(at);
    }
    ASSERT_EQ(present.size(), 1u) << t;
    EXPECT_NEAR(present[0].pose.position.x, 100 + 20 * std::fmod(t, 10), 1e-6) << t;
    EXPECT_EQ(present[0].pose.position.y, 200);
  }
  EXPECT_TRUE(validate(s, scenes::avoidance_world(s)).empty());
}

TEST(Dynabarn, BadFilesAreNamed) {
  const test::Folder folder;
  folder.with("worlds.csv", "world,plugin\n0,hardlibobs_2\n");
  const auto complaint = [&](const char* tracks) {
    folder.with("tracks.csv", tracks);
    return test::error_of([&] { scenes::read_dynabarn(folder / ""); });
  };
  const std::string tracks = (folder / "tracks.csv").string();
  EXPECT_TRUE(test::is_one_line_naming(complaint("plugin,t_s,x_m,y_m\na,0,1\n"), tracks + ":2",
                                       {"3 cells"}));
  EXPECT_TRUE(
      test::is_one_line_naming(complaint("plugin,t_s,x_m,y_m\na,0,1,x\n"), tracks + ":2", {"'x'"}));
  EXPECT_TRUE(
      test::is_one_line_naming(complaint("h\na,1,1,1\na,1,1,1\n"), tracks + ":3", {"ascend"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint("h\na,1,1,1\n"),
                                       (folder / "worlds.csv").string() + ":2",
                                       {"hardlibobs_2", "no track"}));
  EXPECT_TRUE(test::is_one_line_naming(complaint("h\nhardlibobs_2,1,1,1\n"),
                                       (folder / "worlds.csv").string() + ":2",
                                       {"hardlibobs_2", "0.1 s"}));
}

TEST(Dynabarn, TheSixtyWorldsAreTaken) {
  const char* data = std::getenv("MICROSWARM_DATA");
  if (!data) GTEST_SKIP() << "no folder MICROSWARM_DATA";
  const auto worlds = scenes::read_dynabarn(std::filesystem::path(data) / "dynabarn");
  EXPECT_EQ(worlds.size(), 60u);
  for (const scenes::DynabarnWorld& world : worlds) {
    const Scenario s = scenes::dynabarn_scenario(world, 100);
    EXPECT_TRUE(validate(s, scenes::avoidance_world(s)).empty());
  }
}

}  // namespace
}  // namespace microswarm::experiment

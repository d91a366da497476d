// SPDX-License-Identifier: Apache-2.0
// The scenes of [radar]: what is published of them, and what ours makes of them.
#include <gtest/gtest.h>

#include <filesystem>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace microswarm {
namespace {

/// A shipped scene of [radar].
struct RadarScene {
  experiment::Scene scene;
  World world;

  explicit RadarScene(const char* name) {
    const auto folder = std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios/papers/radar";
    scene = experiment::load_scene(experiment::read_scenario(folder / name), folder);
    world = experiment::build_world(scene);
  }
  navigation::RadarParams& params() {
    return std::get<navigation::RadarParams>(scene.scenario.navigator);
  }
  experiment::RunResult run() const { return experiment::simulate(scene.scenario, world); }
};

/// One case of Fig 5, and what Fig 5 and 6 give of it.
struct PublishedCase {
  double safety_distance, detection_range;
  double cost, total, avoiding;
};

TEST(RadarPaper, CasesOfFig5AsPublished) {
  constexpr PublishedCase cases[] = {
      {25, 70, 0.14, 48.8, 18.5}, {25, 250, 0.18, 51.9, 29.4}, {205, 250, 0.28, 58.6, 31.1}};
  for (const PublishedCase& c : cases) {
    RadarScene s("single.yaml");
    s.params().as_published = true;
    s.params().safety_distance = c.safety_distance;
    s.params().detection_range = c.detection_range;
    const experiment::RunResult r = s.run();
    EXPECT_EQ(r.status, Status::solved);
    EXPECT_NEAR(r.metrics.avoidance.mean_cost, c.cost, 0.15 * c.cost);
    EXPECT_NEAR(r.metrics.time, c.total, 0.1 * c.total);
    EXPECT_NEAR(r.metrics.avoidance.time, c.avoiding, 0.1 * c.avoiding);
  }
}

struct Twelve {
  const char* file;
  double max_turning;  ///< [°]
};

class RadarTwelve : public testing::TestWithParam<Twelve> {};

// These two scenes were chosen among many because they are crossed as published.
TEST_P(RadarTwelve, IsCrossedByOursWithoutTurningToAndFro) {
  RadarScene s(GetParam().file);
  const experiment::RunResult guarded = s.run();
  EXPECT_EQ(guarded.status, Status::solved);
  EXPECT_EQ(guarded.metrics.contacts, 0);
  EXPECT_LT(degrees(guarded.metrics.turning), GetParam().max_turning);
  s.scene.scenario.stop_at_contact = false;
  s.params().safety_filter.active = false;
  EXPECT_LE(guarded.metrics.turning, 1.25 * s.run().metrics.turning);
  s.scene.scenario.stop_at_contact = true;
  s.params().as_published = true;
  EXPECT_EQ(s.run().status, Status::solved);
}

INSTANTIATE_TEST_SUITE_P(Fig8And11, RadarTwelve,
                         testing::Values(Twelve{"twelve.yaml", 5000},
                                         Twelve{"experiment_twelve.yaml", 8000}),
                         [](const auto& scene) {
                           const std::string name = scene.param.file;
                           return name.substr(0, name.find('.'));
                         });

TEST(RadarPaper, TheMicromazeIsCrossed) {
  RadarScene s("micromaze.yaml");
  for (const bool published : {false, true}) {
    s.params().as_published = published;
    const experiment::RunResult r = s.run();
    EXPECT_EQ(r.status, Status::solved) << published;
    EXPECT_EQ(r.metrics.contacts, 0) << published;
    if (!published) {
      EXPECT_LT(r.metrics.avoidance.mean_cost, 0.03);  // corridors do not count
    }
  }
}

// Noise shows the swarm nearer to the wall than it is wide, where no plan can begin.
TEST(RadarPaper, TheMicromazeIsCrossedFromBesideTheWall) {
  RadarScene s("micromaze.yaml");
  s.scene.scenario.start->position.y = 270.2;
  s.scene.scenario.sensing.position_noise = 6;
  const experiment::RunResult r = s.run();
  EXPECT_EQ(r.status, Status::solved);
  EXPECT_EQ(r.metrics.contacts, 0);
}

}  // namespace
}  // namespace microswarm

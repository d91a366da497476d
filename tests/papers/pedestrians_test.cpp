// SPDX-License-Identifier: Apache-2.0
// Recorded pedestrians as moving obstacles, scaled so that all are slower than the swarm.
#include <gtest/gtest.h>

#include <filesystem>

#include "microswarm/experiment/trials.hpp"
#include "microswarm/formats/tracks.hpp"
#include "tests/files.hpp"

namespace microswarm {
namespace {

constexpr double um_per_m = 150;
constexpr double slower = 8;  // median 22 µm/s, fastest 50 µm/s, the swarm 60 µm/s
constexpr double pedestrian_radius = 45;

std::filesystem::path recorded_file() {
  return test::data_folder() / "moving_obstacles" / "ucy_zara01_obsmat.txt";
}

experiment::Scenario street(const formats::Tracks& tracks) {
  experiment::Scenario s;
  s.map = formats::PolygonsMap{.lo = {-1300, 550}, .hi = {1150, 3300}, .walls = {}, .discs = {}};
  for (const auto& [id, samples] : tracks) {
    Track track;
    track.samples = std::make_shared<const Samples>(samples);
    s.obstacles.push_back({DiscShape{pedestrian_radius}, track});
  }
  std::get<RibbonParams>(s.swarm).radius = 40;
  std::get<RibbonParams>(s.swarm).max_speed = 60;
  navigation::HierarchicalParams navigator;
  navigator.clearance = 60;
  navigator.speed = 60;
  s.navigator = navigator;
  s.goal_tolerance = 30;
  s.time_limit = 240;
  s.hold_limit = 120;
  s.stop_at_contact = false;
  return s;
}

Samples begun_at(const Samples& samples, double t) {
  Samples out = samples;
  for (double& time : out.times) time -= t;
  return out;
}

// Another moment of the recording, and a start and a goal that are free then and far apart.
void vary_within(double recording, experiment::Scenario& s, std::uint32_t trial) {
  Rng rng(s.seed, Purpose::start_goal, trial);
  const double begin = rng.uniform(0, recording - s.time_limit);
  for (Obstacle& o : s.obstacles) {
    auto& track = std::get<Track>(o.motion);
    track.samples = std::make_shared<const Samples>(begun_at(*track.samples, begin));
  }
  const World world{
      std::make_shared<const Map>(Box{{-1300, 550}, {1150, 3300}}, std::vector<Polygon>{}),
      s.obstacles};
  const Snapshot first = world.at(0);
  for (int i = 0; i < 1000; ++i) {
    s.start = Pose2{{rng.uniform(-1000, 850), rng.uniform(850, 3000)}, rng.uniform(-3, 3)};
    s.goal = Vec2{rng.uniform(-1000, 850), rng.uniform(850, 3000)};
    if (first.is_free(s.start->position, 120) && distance(s.start->position, *s.goal) > 900) return;
  }
}

/// Walks among the recorded ones, which lasted for `recording` s, in so many trials. No contact may
/// be one that holding would have avoided.
void expect_safe(const std::filesystem::path& file, double recording, int trials, int least) {
  const experiment::Scenario scenario = street(formats::read_ucy_obsmat(file, um_per_m, slower));
  const World world{
      std::make_shared<const Map>(Box{{-1300, 550}, {1150, 3300}}, std::vector<Polygon>{}),
      scenario.obstacles};
  const auto vary = [&](experiment::Scenario& s, std::uint32_t trial) {
    vary_within(recording, s, trial);
  };
  const auto results =
      experiment::run_trials(scenario, world, {.trials = trials, .jobs = 2, .vary = vary});
  int arrived = 0;
  int contacts = 0;
  int avoidable = 0;
  for (const experiment::TrialResult& r : results) {
    arrived += r.result.status == Status::solved;
    contacts += r.result.metrics.contacts;
    avoidable += r.result.metrics.avoidable_contacts;
  }
  std::printf("pedestrians: %d of %d arrived, %d contacts, %d of them while driving\n", arrived,
              trials, contacts, avoidable);
  EXPECT_EQ(avoidable, 0);
  EXPECT_GE(arrived, least);
}

TEST(PedestriansSample, NoContactThatHoldingWouldHaveAvoided) {
  expect_safe(test::sample_folder() / "walkers.txt", 300, 12, 11);
}

TEST(Pedestrians, NoContactThatHoldingWouldHaveAvoided) {
  const auto file = recorded_file();
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  expect_safe(file, 2800, 50, 45);
}

}  // namespace
}  // namespace microswarm

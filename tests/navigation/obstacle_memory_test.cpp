// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/obstacle_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/world/obstacles/obstacle.hpp"
#include "tests/navigation/discs.hpp"

namespace microswarm::navigation {
namespace {

constexpr double remembered = 0.5;  // [s]

/// Frames of two discs and a valve, any of which may not be found.
struct Film {
  std::vector<Obstacle> obstacles{
      moving_disc(Straight{{100, 200}, {60, -20}}),
      {Valve{.span = 400, .thickness = 40, .min_gap = 20, .max_gap = 200, .period = 8},
       Still{{800, 300}, 0.7}},
      moving_disc(Straight{{1500, 900}, {-30, 0}})};
  ObstacleMemory memory{remembered};
  std::shared_ptr<const Map> map =
      std::make_shared<const Map>(Box{{-5000, -5000}, {5000, 5000}}, std::vector<Polygon>{});
  Snapshot frame{map};

  Observation update(double t, std::vector<std::uint32_t> lost = {}) {
    std::vector<Body> bodies;
    for (std::uint32_t i = 0; i < obstacles.size(); ++i)
      if (std::find(lost.begin(), lost.end(), i) == lost.end())
        append_bodies(obstacles[i], i, t, bodies);
    frame = Snapshot(map, t, std::move(bodies));
    return memory.complete(
        {.now = t, .seen = t, .swarm = {}, .robots = {}, .world = borrowed(frame)});
  }
};

std::vector<const Body*> of(const Observation& seen, std::uint32_t obstacle) {
  std::vector<const Body*> out;
  for (const Body& body : seen.world->moving().bodies())
    if (body.obstacle == obstacle) out.push_back(&body);
  return out;
}

TEST(ObstacleMemory, LeavesCompleteFramesAsTheyAre) {
  Film film;
  for (int k = 0; k < 20; ++k) EXPECT_EQ(film.update(0.1 * k).world.get(), &film.frame);
}

TEST(ObstacleMemory, AnObstacleThatIsNotFoundGoesOnAsItMovedForAWhile) {
  Film film;
  for (int k = 0; k < 20; ++k) film.update(0.1 * k);
  for (int k = 20; k < 24; ++k) {
    const Observation seen = film.update(0.1 * k, {0});
    ASSERT_EQ(of(seen, 0).size(), 1u) << k;
    const Vec2 is = std::get<Disc>(of(seen, 0).front()->shape).centre;
    EXPECT_LT(distance(is, Vec2{100, 200} + 0.1 * k * Vec2{60, -20}), 1e-6);
    EXPECT_EQ(seen.world->time(), film.frame.time());
    EXPECT_EQ(of(seen, 1).size(), 2u);
    EXPECT_EQ(of(seen, 2).size(), 1u);
  }
  EXPECT_TRUE(of(film.update(2.7, {0}), 0).empty()) << "for ever";
}

TEST(ObstacleMemory, AnObstacleThatIsFoundAgainIsThereOnce) {
  Film film;
  for (int k = 0; k < 20; ++k)
    film.update(0.1 * k, k % 3 == 2 ? std::vector{0u, 1u} : std::vector{2u});
  const Observation seen = film.update(2);
  EXPECT_EQ(seen.world.get(), &film.frame);
}

TEST(ObstacleMemory, BothLeavesOfAValveAreRemembered) {
  Film film;
  for (int k = 0; k < 20; ++k) film.update(0.1 * k);
  EXPECT_EQ(of(film.update(2, {1}), 1).size(), 2u);
}

TEST(ObstacleMemory, TheSameFrameTwiceAndOneFromBeforeAreNoTrouble) {
  Film film;
  for (int k = 0; k < 20; ++k) film.update(0.1 * k);
  const Vec2 once = std::get<Disc>(of(film.update(2, {0}), 0).front()->shape).centre;
  const Vec2 twice = std::get<Disc>(of(film.update(2, {0}), 0).front()->shape).centre;
  EXPECT_EQ(once, twice);
  EXPECT_EQ(film.update(1, {0, 1, 2}).world.get(), &film.frame);
}

TEST(ObstacleMemory, RemembersNothingWhenAskedTo) {
  Film film;
  film.memory = ObstacleMemory(0);
  for (int k = 0; k < 20; ++k) film.update(0.1 * k);
  EXPECT_EQ(film.update(2, {0}).world.get(), &film.frame);
}

}  // namespace
}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/simulation/microscope.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::rig {
namespace {

std::shared_ptr<const Map> room() {
  return std::make_shared<const Map>(
      Box{{-100, 50}, {300, 250}},
      std::vector<Polygon>{{{{200, 50}, {300, 50}, {300, 150}, {200, 150}}, {}}});
}

MicroscopeParams plain_microscope() {
  MicroscopeParams p;
  p.um_per_px = 1;
  p.light_gradient = p.light_drift = p.noise = p.blur = 0;
  return p;
}

std::uint8_t grey_at(const Microscope& m, const formats::Image& picture, Vec2 position) {
  const Vec2 at = m.scale().to_picture(position);
  return picture.pixels[picture.index(static_cast<int>(std::lround(at.x)),
                                      static_cast<int>(std::lround(at.y)))];
}

TEST(Microscope, ShowsWallsObstaclesAndRobotsWhereTheyAre) {
  const auto map = room();
  Microscope microscope(plain_microscope(), *map, 1, 0);
  EXPECT_EQ(microscope.width(), 400 + 2 * 16);
  EXPECT_EQ(microscope.height(), 200 + 2 * 16);
  const Snapshot world(map, 0,
                       {{.shape = Disc{{0, 100}, 20}},
                        {.shape = Polygon{{{100, 180}, {140, 180}, {140, 200}, {100, 200}}, {}}}});
  const std::vector<Vec2> robots{{50, 60}};
  const formats::Image& picture = microscope.look(world, std::nullopt, robots);
  EXPECT_EQ(grey_at(microscope, picture, {0, 200}), 180);
  EXPECT_EQ(grey_at(microscope, picture, {250, 100}), 117);  // wall
  EXPECT_EQ(grey_at(microscope, picture, {-108, 60}), 117);  // beyond the map
  EXPECT_EQ(grey_at(microscope, picture, {0, 118}), 126);
  EXPECT_EQ(grey_at(microscope, picture, {0, 123}), 180);
  EXPECT_EQ(grey_at(microscope, picture, {102, 198}), 126);
  EXPECT_EQ(grey_at(microscope, picture, {97, 198}), 180);
  EXPECT_EQ(grey_at(microscope, picture, {50, 60}), 63);
}

TEST(Microscope, TheSwarmIsADarkCloudOfItsRadius) {
  const auto map = room();
  Microscope microscope(plain_microscope(), *map, 1, 0);
  const formats::Image& picture = microscope.look(Snapshot(map), SwarmPose{{{50, 150}, 0}, 40}, {});
  double sum = 0;
  double x = 0;
  double farthest = 0;
  for (int row = 16; row < microscope.height() - 16; ++row)
    for (int column = 16; column < microscope.width() - 16; ++column) {
      const Vec2 position = microscope.scale().to_world({1.0 * column, 1.0 * row});
      if (!map->is_free(position, 2)) continue;
      const double dark = 180 - picture.pixels[picture.index(column, row)];
      sum += dark;
      x += dark * position.x;
      if (dark > 5) farthest = std::max(farthest, distance(position, Vec2{50, 150}));
    }
  EXPECT_NEAR(x / sum, 50, 2);
  EXPECT_NEAR(farthest, 40, 1.5);
  EXPECT_GT(sum / (pi * 40 * 40), 80);
}

TEST(Microscope, NoiseLightAndDriftAreAsAskedFor) {
  MicroscopeParams p = plain_microscope();
  p.noise = 4;
  p.light_gradient = 0.2;
  p.light_drift = 0.1;
  p.light_period = 8;
  const auto map = std::make_shared<const Map>(Box{{0, 0}, {300, 200}}, std::vector<Polygon>{});
  Microscope microscope(p, *map, 1, 0);
  const auto mean = [&](const formats::Image& picture) {
    double sum = 0;
    for (int row = 20; row < picture.height - 20; ++row)
      for (int column = 20; column < picture.width - 20; ++column)
        sum += picture.pixels[picture.index(column, row)];
    return sum / ((picture.height - 40) * (picture.width - 40));
  };
  const formats::Image first = microscope.look(Snapshot(map, 0), std::nullopt, {});
  EXPECT_NEAR(mean(first), 180, 0.5);
  EXPECT_NEAR(mean(microscope.look(Snapshot(map, 2), std::nullopt, {})), 198, 0.5);
  const formats::Image& second = microscope.look(Snapshot(map, 4), std::nullopt, {});
  double squares = 0;
  for (int row = 20; row < first.height - 20; ++row)
    for (int column = 20; column < first.width - 20; ++column) {
      const std::size_t i = first.index(column, row);
      squares += (first.pixels[i] - second.pixels[i]) * (first.pixels[i] - second.pixels[i]);
    }
  const double n = (first.height - 40) * (first.width - 40);
  EXPECT_NEAR(std::sqrt(squares / n / 2), 4, 0.2);
  EXPECT_GT(grey_at(microscope, second, {290, 10}), grey_at(microscope, second, {10, 190}) + 40);
}

TEST(Microscope, TheSameSeedGivesTheSamePicture) {
  const auto map = room();
  const SwarmPose swarm{{{50, 150}, 0}, 40};
  Microscope a({}, *map, 7, 1);
  Microscope b({}, *map, 7, 1);
  Microscope c({}, *map, 8, 1);
  for (const double t : {0.0, 0.1}) {
    const Snapshot world(map, t);
    EXPECT_EQ(a.look(world, swarm, {}).pixels, b.look(world, swarm, {}).pixels);
    EXPECT_NE(a.look(world, swarm, {}).pixels, c.look(world, swarm, {}).pixels);
    b.look(world, swarm, {});
  }
}

}  // namespace
}  // namespace microswarm::rig

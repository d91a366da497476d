// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/forecast.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/rng.hpp"
#include "microswarm/geometry/distance.hpp"
#include "tests/cases.hpp"

namespace microswarm {
namespace {

std::shared_ptr<const Map> empty_map() {
  return std::make_shared<const Map>(Box{{0, 0}, {1000, 1000}}, std::vector<Polygon>{});
}

Polygon square(Vec2 c, double half) {
  return {.outer = {c + Vec2{-half, -half}, c + Vec2{half, -half}, c + Vec2{half, half},
                    c + Vec2{-half, half}}};
}

// Oracle: both moved in a thousand small steps.
double sampled(const Snapshot& world, Segment s, double t0, double t1) {
  double least = 1e9;
  for (int k = 0; k <= 1000; ++k) {
    const double share = k / 1000.0;
    const double t = t0 + share * (t1 - t0);
    const Vec2 p = s.a + share * (s.b - s.a);
    for (const Body& body : world.moving().bodies()) {
      const Vec2 q = p - t * body.velocity;
      const double d =
          std::visit([&](const auto& shape) { return distance(q, shape); }, body.shape);
      least = std::min(least, d - t * body.deformation_speed);
    }
  }
  return least;
}

TEST(Forecast, AgreesWithSmallStepsAndIsNeverGreater) {
  Rng rng(1, Purpose::test);
  for (int i = 0; i < test::cases(300); ++i) {
    std::vector<Body> bodies;
    for (int k = 0; k < 3; ++k) {
      const Vec2 c{rng.uniform(0, 1000), rng.uniform(0, 1000)};
      Body body{.velocity = {rng.uniform(-50, 50), rng.uniform(-50, 50)}};
      if (k == 0)
        body.shape = square(c, 30);
      else
        body.shape = Disc{c, 40};
      body.obstacle = static_cast<std::uint32_t>(k);
      bodies.push_back(body);
    }
    const Snapshot world(empty_map(), 0, bodies);
    const Segment s{{rng.uniform(0, 1000), rng.uniform(0, 1000)},
                    {rng.uniform(0, 1000), rng.uniform(0, 1000)}};
    const double exact = forecast_clearance(world, s, 0.3, 1.3, 1e9);
    const double oracle = sampled(world, s, 0.3, 1.3);
    EXPECT_LE(exact, oracle + 1e-6);
    EXPECT_NEAR(exact, oracle, 1.0);
  }
}

TEST(Forecast, AFastBodyBetweenTwoInstantsIsSeen) {
  const Snapshot world(empty_map(), 0,
                       {{.shape = Disc{{0, 500}, 10}, .velocity = {10'000, 0}, .obstacle = 0}});
  EXPECT_EQ(forecast_clearance(world, {{500, 500}, {500, 500}}, 0, 0.1, 100), 0);
  EXPECT_GT(forecast_clearance(world, {{500, 600}, {500, 600}}, 0, 0.1, 1000), 80);
}

TEST(Forecast, BodiesAtRestGrowByTheirDeformation) {
  const Snapshot world(
      empty_map(), 0,
      {{.shape = Disc{{500, 500}, 10}, .velocity = {}, .deformation_speed = 5, .obstacle = 0}});
  EXPECT_NEAR(forecast_clearance(world, {{600, 500}, {600, 500}}, 0, 2, 1000), 80, 1e-9);
}

TEST(Forecast, DrawnOutCoversTheWay) {
  const Snapshot world(empty_map(), 0,
                       {{.shape = Disc{{100, 500}, 30}, .velocity = {60, 0}, .obstacle = 0}});
  const Snapshot drawn = drawn_out(world, 1.5, 90);
  for (double t = 0; t <= 1.5; t += 0.05)
    EXPECT_LT(drawn.clearance({100 + 60 * t, 500}), 1e-9) << t;
  EXPECT_GT(drawn.clearance({260, 500}), 20);
}

}  // namespace
}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/prediction/obstacle_predictor.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/geometry/distance.hpp"
#include "tests/cases.hpp"

namespace microswarm::navigation {
namespace {

/// A body that moves straight and, when it is a disc, grows.
struct PredictedMover {
  std::variant<Disc, Polygon> shape;  ///< at t = 0
  Vec2 velocity;
  double growth = 0;

  Body at(double t, std::uint32_t obstacle) const {
    Body body{shape, obstacle};
    if (auto* disc = std::get_if<Disc>(&body.shape)) {
      disc->centre += t * velocity;
      disc->radius += t * growth;
    } else {
      for (Vec2& v : std::get<Polygon>(body.shape).outer) v += t * velocity;
    }
    return body;
  }
};

/// What a camera shows of movers: frames before t = 0 and at it, and the last of them.
struct PredictedScene {
  std::vector<PredictedMover> movers;
  std::shared_ptr<const Map> map =
      std::make_shared<const Map>(Box{{0, 0}, {1000, 1000}}, std::vector<Polygon>{});
  ObstaclePredictor predictor{};
  Snapshot newest = at(0);

  Snapshot at(double t) const {
    std::vector<Body> bodies;
    for (std::uint32_t i = 0; i < movers.size(); ++i) bodies.push_back(movers[i].at(t, i));
    return Snapshot(map, t, std::move(bodies));
  }
  void watch() {
    for (int k = -6; k <= 0; ++k) {
      const Snapshot frame = at(0.1 * k);
      predictor.update(
          {.now = 0.1 * k, .seen = 0.1 * k, .swarm = {}, .robots = {}, .world = borrowed(frame)});
    }
    newest = at(0);
  }
};

Polygon square(Vec2 c, double half) {
  return {.outer = {c + Vec2{-half, -half}, c + Vec2{half, -half}, c + Vec2{half, half},
                    c + Vec2{-half, half}}};
}

// Oracle: both moved in a thousand small steps.
double sampled(const PredictedScene& scene, Segment s, double t0, double t1) {
  double least = 1e9;
  for (int k = 0; k <= 1000; ++k) {
    const double share = k / 1000.0;
    const Vec2 p = s.a + share * (s.b - s.a);
    for (const PredictedMover& mover : scene.movers) {
      const Body body = mover.at(t0 + share * (t1 - t0), 0);
      least = std::min(
          least, std::visit([&](const auto& shape) { return distance(p, shape); }, body.shape));
    }
  }
  return least;
}

TEST(ObstaclePredictor, AgreesWithSmallStepsAndIsNeverGreater) {
  Rng rng(1, Purpose::test);
  for (int i = 0; i < test::cases(300); ++i) {
    PredictedScene scene;
    for (int k = 0; k < 3; ++k) {
      const Vec2 c{rng.uniform(0, 1000), rng.uniform(0, 1000)};
      PredictedMover mover{Disc{c, 40}, {rng.uniform(-50, 50), rng.uniform(-50, 50)}};
      if (k == 0) mover.shape = square(c, 30);
      scene.movers.push_back(mover);
    }
    scene.watch();
    const Segment s{{rng.uniform(0, 1000), rng.uniform(0, 1000)},
                    {rng.uniform(0, 1000), rng.uniform(0, 1000)}};
    const double exact = scene.predictor.clearance(scene.newest, s, 0.3, 1.3, 1e9);
    const double oracle = sampled(scene, s, 0.3, 1.3);
    EXPECT_LE(exact, oracle + 1e-6);
    EXPECT_NEAR(exact, oracle, 1.0);
  }
}

TEST(ObstaclePredictor, AFastBodyBetweenTwoInstantsIsSeen) {
  PredictedScene scene{.movers = {{Disc{{0, 500}, 10}, {10'000, 0}}}};
  scene.watch();
  EXPECT_EQ(scene.predictor.clearance(scene.newest, {{500, 500}, {500, 500}}, 0, 0.1, 100), 0);
  EXPECT_GT(scene.predictor.clearance(scene.newest, {{500, 600}, {500, 600}}, 0, 0.1, 1000), 80);
}

TEST(ObstaclePredictor, ABodyAtRestGoesOnGrowing) {
  PredictedScene scene{.movers = {{Disc{{500, 500}, 10}, {}, 5}}};
  scene.watch();
  EXPECT_NEAR(scene.predictor.clearance(scene.newest, {{600, 500}, {600, 500}}, 0, 2, 1000), 80,
              1e-6);
}

// A channel's walls are the rings of holes in a block whose outer ring rests.
TEST(ObstaclePredictor, WallsOfAHoleThatComeNearerAreSeen) {
  const auto map = std::make_shared<const Map>(Box{{0, 0}, {1000, 1000}}, std::vector<Polygon>{});
  ObstaclePredictor predictor;
  const auto frame = [&](double t) {
    Polygon block = square({500, 500}, 400);
    block.holes = {square({500, 500}, 200 - 20 * t).outer};
    return Snapshot(map, t, {{normalised(block), 0}});
  };
  for (int k = 0; k <= 5; ++k) {
    const Snapshot seen = frame(0.1 * k);
    predictor.update(
        {.now = 0.1 * k, .seen = 0.1 * k, .swarm = {}, .robots = {}, .world = borrowed(seen)});
  }
  const double true_distance = 200 - 20 * 2.5;
  const Segment middle{{500, 500}, {500, 500}};
  const double predicted = predictor.clearance(frame(0.5), middle, 0, 2, 1000);
  EXPECT_LE(predicted, true_distance + 1e-6);
  EXPECT_GT(predicted, true_distance - 25);
}

TEST(ObstaclePredictor, SweptObstaclesCoverTheWay) {
  PredictedScene scene{.movers = {{Disc{{100, 500}, 30}, {60, 0}}}};
  scene.watch();
  const Snapshot swept = scene.predictor.swept_obstacles(scene.newest, 1.5, 90);
  for (double t = 0; t <= 1.5; t += 0.05)
    EXPECT_LT(swept.clearance({100 + 60 * t, 500}), 1e-9) << t;
  EXPECT_GT(swept.clearance({260, 500}), 20);
}

TEST(ObstaclePredictor, TheTimeOfGrowthIsTuned) {
  PredictedScene scene{.movers = {{Disc{{500, 500}, 10}, {}, 5}},
                       .predictor = ObstaclePredictor({}, {.growth_time = 1})};
  scene.watch();
  EXPECT_NEAR(scene.predictor.clearance(scene.newest, {{600, 500}, {600, 500}}, 0, 2, 1000), 85,
              1e-6);
}

TEST(ObstaclePredictor, TheSignificanceOfAVelocityIsTuned) {
  for (const double significance : {2.0, 1e6}) {
    PredictedScene scene{.movers = {{Disc{{500, 500}, 10}, {20, 0}}},
                         .predictor = ObstaclePredictor({}, {.min_significance = significance})};
    scene.watch();
    EXPECT_EQ(scene.predictor.all_rest(), significance > 2);
  }
}

}  // namespace
}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/radar/radar_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/config/key_locations.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/geometry/distance.hpp"
#include "microswarm/navigation/radar/radar_circles.hpp"
#include "microswarm/navigation/radar/radar_params.hpp"
#include "microswarm/navigation/radar/radar_scanner.hpp"
#include "microswarm/scenes/worlds.hpp"
#include "tests/cases.hpp"
#include "tests/navigation/discs.hpp"

namespace microswarm::navigation {
namespace {

constexpr int directions = 360;

RadarLook look_at(Vec2 centre, double radius, Vec2 target, const RadarParams& p = {}) {
  return {.centre = centre,
          .radius = radius,
          .target = target,
          .circles = make_circles(p, radius),
          .step = p.prediction_distance,
          .wall_distance = p.safety_distance,
          .target_gain = p.target_gain,
          .avoidance_gain = p.avoidance_gain};
}

/// With a coarse field, which is quick to build and leaves more to the exact queries.
std::shared_ptr<const Map> walled(std::vector<Polygon> walls) {
  return std::make_shared<const Map>(Box{{0, 0}, {2000, 1400}}, std::move(walls),
                                     std::vector<Disc>{}, 20);
}

Snapshot arena(std::vector<Body> bodies = {}, std::vector<Polygon> walls = {}) {
  static const auto open = walled({});
  return Snapshot(walls.empty() ? open : walled(std::move(walls)), 0, std::move(bodies));
}

TEST(RadarCircles, AreThoseOfThePaper) {
  RadarParams p;
  p.detection_range = 70;
  const RadarCircles c = make_circles(p, 100);  // case I
  EXPECT_EQ(c.prediction, 125);
  EXPECT_EQ(c.safety, 150);
  EXPECT_EQ(c.detection, 170);
  EXPECT_EQ(make_circles(p, 120).safety, 170);  // Eq 26: they follow the swarm
}

TEST(RadarCircles, BadOnesAreRefused) {
  const auto complaint = [](const RadarParams& p) -> std::string {
    try {
      KeyLocations("x.yaml").require_none(validate(p));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(complaint({}), "");
  RadarParams order;
  order.safety_distance = 60;
  EXPECT_EQ(complaint(order),
            "x.yaml: navigator.detection_range_um is 70, less than prediction_distance_um + "
            "safety_distance_um, 85: the safety circle must lie within the detection circle");
  RadarParams equal;
  equal.safety_distance = 45;
  EXPECT_EQ(complaint(equal), "");
  RadarParams angle;
  angle.angle_step = radians(7);
  EXPECT_EQ(complaint(angle), "x.yaml: navigator.angle_step_deg is 7, must divide 360");
  for (const double fine : {0.1, 0.5, 1.0, 7.2, 45.0}) {
    angle.angle_step = radians(fine);
    EXPECT_EQ(complaint(angle), "") << fine;
  }
  RadarParams speed;
  speed.speed = 0;
  EXPECT_EQ(complaint(speed), "x.yaml: navigator.speed_um_per_s is 0, must be above 0");
}

TEST(RadarWeights, TheTargetsIsTheGreater) {
  Rng rng(5, Purpose::test);
  for (int i = 0; i < 20'000; ++i) {
    RadarLook look;
    look.radius = rng.uniform(1, 500);
    look.circles.detection = look.radius + rng.uniform(1, 600);
    look.target = {rng.uniform(0, 5000), rng.uniform(0, 5000)};
    look.target_gain = rng.uniform(0, 10);
    look.avoidance_gain = rng.uniform(0, 0.999);
    const RadarWeights w = radar_weights(look, rng.uniform(-100, 1500));
    ASSERT_GE(w.target, 1);
    ASSERT_GE(w.avoidance, 0.5);
    ASSERT_LT(w.avoidance, 1);
    ASSERT_GT(w.target, w.avoidance);
  }
}

TEST(RadarWeights, AvoidanceGrowsWithNearness) {
  const RadarLook look = look_at({0, 0}, 100, {500, 0});
  double last = 1;
  for (double d = 100; d <= 170; d += 5) {
    const double q = radar_weights(look, d).avoidance;
    EXPECT_LT(q, last);
    last = q;
  }
  EXPECT_EQ(last, 0.5);  // at the detection circle
  EXPECT_DOUBLE_EQ(radar_weights(look, 100).avoidance, 0.5 + look.avoidance_gain / 2);
}

TEST(RadarWeights, PrintedOnesAreEquations10To12) {
  Rng rng(6, Purpose::test);
  int capped = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double r_s = rng.uniform(50, 500), r_ob = rng.uniform(10, 500);
    const double r_d = r_s + rng.uniform(1, 600);
    const Vec2 o_s{rng.uniform(0, 5000), rng.uniform(0, 5000)};
    const Vec2 o_t{rng.uniform(0, 5000), rng.uniform(0, 5000)};
    const Vec2 o_ob = o_s + rng.uniform(r_s + r_ob, r_d + r_ob) * unit_vector(rng.uniform(0, 6));
    // k_t, ε, k_a and η as in the paper.
    const double k_t = rng.uniform(0.1, 2), epsilon = rng.uniform(0, 0.1);
    const double k_a = rng.uniform(0.1, 2), eta = rng.uniform(0, 0.3);
    const auto square = [](double v) { return v * v; };
    const double to_target = distance(o_s, o_t), to_obstacle = distance(o_s, o_ob);
    const double big_q_t = 0.5 * epsilon * square(to_target);
    const double big_q_a = 0.5 * eta * square(1 / to_obstacle - 1 / r_d);
    const double q_t = 1 + k_t / (0.5 * square(r_d)) * big_q_t;
    const double q_a = 0.5 + k_a / square(1 / (r_s + r_ob) - 1 / r_d) * big_q_a;

    RadarLook look = look_at(o_s, r_s, o_t);
    look.circles.detection = r_d;
    look.target_gain = k_t * epsilon;
    look.avoidance_gain = k_a * eta;
    look.printed_weights = true;
    const Body body = disc_body(o_ob, r_ob);
    EXPECT_NEAR(obstacle_radius(look, body), r_ob, 1e-9);
    const RadarWeights w = radar_weights(look, distance(o_s, body), obstacle_radius(look, body));
    ASSERT_NEAR(w.target, q_t, 1e-9 * q_t);
    ASSERT_NEAR(w.avoidance, std::min(q_a, q_t), 1e-5 * q_t) << q_a;
    capped += q_a > q_t;
  }
  EXPECT_GT(capped, 100);
  EXPECT_LT(capped, 19'000);
}

TEST(RadarWeights, PrintedOnesAreFiniteWhereTheScaleIsZero) {
  RadarLook look = look_at({0, 0}, 100, {500, 0});
  look.circles.detection = 170;
  look.printed_weights = true;
  for (const double edge : {-120.0, -70.0, 0.0, 100.0, 170.0}) {
    const RadarWeights w = radar_weights(look, edge, 70);
    EXPECT_GE(w.avoidance, 0.5) << edge;
    EXPECT_LE(w.avoidance, w.target) << edge;
  }
}

TEST(RadarScan, PrintedWeightsDecideTheDirection) {
  RadarLook look = look_at({600, 700}, 100, {1400, 1000});
  look.circles.detection = 350;
  look.circles.safety = 150;
  look.avoidance_gain = 0.2;
  const Snapshot world = arena({disc_body({1100, 760}, 300)});
  const auto best = [&](bool printed) {
    look.printed_weights = printed;
    RadarScanner scanner(directions, {});
    const RadarDiagnostics slow = scan(look, world, directions);
    scanner.detect(look, world);
    EXPECT_EQ(scanner.choose(look, world), slow.beams[slow.best.value()].heading);
    return slow.weights.avoidance;
  };
  EXPECT_GT(best(true), best(false) + 0.1);
}

TEST(RadarScan, NothingDetectedGoesStraight) {
  const RadarLook look = look_at({500, 500}, 100, {1500, 800});
  const RadarDiagnostics far = scan(look, arena({disc_body({820, 500}, 150)}), directions);
  EXPECT_FALSE(far.nearest);
  ASSERT_TRUE(far.straight);
  EXPECT_DOUBLE_EQ(*far.straight, std::atan2(300, 1000));
  EXPECT_TRUE(scan(look, arena({disc_body({819, 500}, 150)}), directions).nearest);
}

TEST(RadarScan, ScreensWhatComesTooNear) {
  // Edge 20 µm from the swarm's: a predictive swarm straight ahead would touch it.
  const RadarLook look = look_at({500, 500}, 100, {1500, 500});
  const RadarDiagnostics s = scan(look, arena({disc_body({720, 500}, 100, 4)}), directions);
  for (const RadarBeam& beam : s.beams) {
    const double gap = distance(Vec2{720, 500}, look.centre + 25 * unit_vector(beam.heading)) - 200;
    EXPECT_EQ(beam.fate == BeamFate::kept, gap >= 25) << degrees(beam.heading);
    if (beam.fate != BeamFate::kept) {
      EXPECT_EQ(beam.obstacle, 4u);
    }
  }
  ASSERT_TRUE(s.best);
  EXPECT_EQ(s.beams[*s.best].fate, BeamFate::kept);
}

TEST(RadarScan, TheNearestEdgeCountsNotTheNearestCentre) {
  const RadarLook look = look_at({500, 500}, 100, {1500, 500});
  const RadarDiagnostics s =
      scan(look, arena({disc_body({500, 660}, 10, 0), disc_body({840, 500}, 200, 1)}), directions);
  ASSERT_TRUE(s.nearest);
  EXPECT_EQ(*s.nearest, 1u);  // 40 µm away, the other 50
}

TEST(RadarScan, WallsScreenButDoNotRepel) {
  const RadarLook look = look_at({130, 700}, 100, {1500, 700});
  const RadarDiagnostics s = scan(look, arena(), directions);
  EXPECT_FALSE(s.nearest);
  EXPECT_TRUE(s.straight);
  int walls = 0;
  for (const RadarBeam& beam : s.beams) walls += beam.fate == BeamFate::wall;
  EXPECT_GT(walls, 90);
}

/// Worlds of discs and polygons that are near often; the look of a swarm somewhere in them.
struct Case {
  std::vector<Body> bodies;
  RadarLook look;
};

Case random_case(Rng& rng) {
  Case c;
  RadarParams p;
  p.prediction_distance = rng.uniform(5, 40);
  p.safety_distance = rng.uniform(0, 60);
  p.detection_range = p.prediction_distance + p.safety_distance + rng.uniform(0, 150);
  p.target_gain = rng.uniform(0, 1);
  const Vec2 centre{rng.uniform(0, 2000), rng.uniform(0, 1400)};
  const Vec2 target{rng.uniform(0, 2000), rng.uniform(0, 1400)};
  c.look = look_at(centre, rng.uniform(5, 150), target, p);
  if (rng.below(3) == 0) c.look.approach = rng.uniform(0, 20);
  if (rng.below(2) == 0) {
    c.look.course = unit_vector(rng.uniform(-pi, pi));
    c.look.min_cosine = std::cos(rng.uniform(radians(30), pi));
  }
  const auto count = rng.below(rng.below(4) == 0 ? 120 : 8);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Vec2 at = centre + rng.uniform(0, 500) * unit_vector(rng.uniform(-pi, pi));
    Body body = disc_body(at, rng.uniform(1, 120), static_cast<std::uint32_t>(i));
    if (rng.below(2) == 0)
      body.shape =
          scenes::turned_rectangle(at, rng.uniform(2, 250), rng.uniform(2, 60), rng.uniform(0, pi));
    if (distance(centre, body) > 0) c.bodies.push_back(body);
  }
  return c;
}

TEST(RadarScanner, ChoosesAsTheFullScanDoes) {
  RadarScanner scanner(directions);
  int avoided = 0, screened = 0, straight = 0;
  for (std::uint32_t trial = 0; trial < test::cases(6000U); ++trial) {
    Rng rng(9, Purpose::test, trial);
    const Case c = random_case(rng);
    std::vector<Polygon> walls;
    if (trial % 3 == 0)
      walls.push_back(scenes::rectangle(
          {c.look.centre + Vec2{60, -300}, c.look.centre + Vec2{80, rng.uniform(-250, 300)}}));
    const Snapshot world = arena(c.bodies, walls);
    const RadarDiagnostics slow = scan(c.look, world, directions);
    const auto contact = scanner.detect(c.look, world);
    ASSERT_EQ(contact.has_value(), slow.nearest.has_value()) << trial;
    if (contact) {
      ASSERT_EQ(contact->body, *slow.nearest) << trial;
    }
    const auto fast = scanner.choose(c.look, world);
    if (slow.straight) {
      ASSERT_EQ(fast, slow.straight) << trial;
      ++straight;
      continue;
    }
    ASSERT_TRUE(!fast || slow.best) << trial;
    screened += !slow.best;
    if (!fast && slow.best) {  // walls alone, and no way gains
      const Vec2 position =
          c.look.centre + c.look.step * unit_vector(slow.beams[*slow.best].heading);
      ASSERT_FALSE(contact);
      ASSERT_GE(distance(position, c.look.target), distance(c.look.centre, c.look.target)) << trial;
    }
    if (!fast) continue;
    ASSERT_EQ(*fast, slow.beams[*slow.best].heading) << trial;
    avoided += contact.has_value();
  }
  EXPECT_GT(avoided, test::cases(500));
  EXPECT_GT(screened, test::cases(100));
  EXPECT_GT(straight, test::cases(500));
}

// φ_i of Eq 9 is normalised over χ_2, whatever the turn limit forbids.
TEST(RadarScanner, ATurnLimitThatForbidsTheBestOfNothingChangesNothing) {
  RadarScanner scanner(directions);
  int within = 0, beyond = 0;
  for (std::uint32_t trial = 0; trial < 3000; ++trial) {
    Rng rng(11, Purpose::test, trial);
    Case c = random_case(rng);
    const Snapshot world = arena(c.bodies);
    c.look.course.reset();
    if (!scanner.detect(c.look, world)) continue;
    const auto free = scanner.choose(c.look, world);
    if (!free) continue;
    c.look.course = unit_vector(*free + rng.uniform(-pi, pi));
    c.look.min_cosine = std::cos(radians(120));
    const bool may = keeps_course(c.look, unit_vector(*free));
    ++(may ? within : beyond);
    const auto limited = scanner.choose(c.look, world);
    ASSERT_TRUE(limited) << trial;
    const RadarDiagnostics full = scan(c.look, world, directions);
    ASSERT_TRUE(full.best) << trial;
    EXPECT_EQ(full.beams[*full.best].heading, *limited) << trial;
    if (may) {
      EXPECT_EQ(*limited, *free) << trial;
    } else {
      EXPECT_TRUE(keeps_course(c.look, unit_vector(*limited)) || *limited == *free) << trial;
    }
  }
  EXPECT_GT(within, 200);
  EXPECT_GT(beyond, 100);
}

TEST(RadarScanner, KeepsAsTheFullScanDoes) {
  RadarScanner scanner(directions);
  for (std::uint32_t trial = 0; trial < 2000; ++trial) {
    Rng rng(10, Purpose::test, trial);
    const Case c = random_case(rng);
    const Snapshot world = arena(c.bodies);
    const RadarDiagnostics slow = scan(c.look, world, directions);
    scanner.detect(c.look, world);
    const std::vector<bool> kept = scanner.kept(c.look, world);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const BeamFate fate = slow.beams[i].fate;  // what turns too far is in χ_2 all the same
      ASSERT_EQ(kept[i], fate == BeamFate::kept || fate == BeamFate::turn) << trial << ", " << i;
    }
  }
}

TEST(RadarScanner, RetreatsFromWhatComes) {
  // Hemmed in from left and right, both well within the safety circle: down and up are open.
  const RadarLook look = look_at({500, 500}, 100, {1500, 500});
  const Snapshot world = arena({disc_body({660, 500}, 50), disc_body({355, 500}, 40)});
  RadarScanner scanner(directions);
  scanner.detect(look, world);
  ASSERT_FALSE(scanner.choose(look, world));
  const auto heading = scanner.retreat(look, world);
  ASSERT_TRUE(heading);
  const Vec2 after = look.centre + 25 * unit_vector(*heading);
  EXPECT_GT(world.clearance(after), world.clearance(look.centre));
}

TEST(RadarScanner, NoWayOutIsNone) {
  // In a box whose walls are 10 µm from the swarm's edge.
  const std::vector<Polygon> box{
      scenes::rectangle({{370, 370}, {390, 630}}), scenes::rectangle({{610, 370}, {630, 630}}),
      scenes::rectangle({{370, 370}, {630, 390}}), scenes::rectangle({{370, 610}, {630, 630}})};
  const Snapshot world = arena({}, box);
  const RadarLook look = look_at({500, 500}, 100, {1500, 500});
  RadarScanner scanner(directions);
  scanner.detect(look, world);
  EXPECT_FALSE(scanner.choose(look, world));
  EXPECT_FALSE(scanner.retreat(look, world));
}

}  // namespace
}  // namespace microswarm::navigation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/current_loop.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "microswarm/actuation/coils/winding.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "tests/actuation/support.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

/// Biot–Savart summed over straight bits of the circle: the trapezoidal rule on a periodic
/// integrand, exact to rounding away from the wire.
Eigen::Vector3d summed_field(const CurrentLoop& loop, const Eigen::Vector3d& p, int bits) {
  const Eigen::Vector3d u = loop.axis.unitOrthogonal();
  const Eigen::Vector3d v = loop.axis.cross(u);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < bits; ++i) {
    const double a = 2 * pi * i / bits;
    const Eigen::Vector3d at = loop.centre + loop.radius * (std::cos(a) * u + std::sin(a) * v);
    const Eigen::Vector3d dl = 2 * pi * loop.radius / bits * (std::cos(a) * v - std::sin(a) * u);
    const Eigen::Vector3d r = p - at;
    sum += dl.cross(r) / std::pow(r.norm(), 3);
  }
  return mu_0 / (4 * pi) * loop.turns * sum;
}

double distance_to_wire(const CurrentLoop& loop, const Eigen::Vector3d& p) {
  const Eigen::Vector3d off = p - loop.centre;
  const double z = off.dot(loop.axis);
  return std::hypot(z, (off - z * loop.axis).norm() - loop.radius);
}

CurrentLoop random_loop(test::Dice& dice) {
  return {1e4 * dice.vector(), dice.direction(), 3e4 * (1.1 + dice.number()),
          50 * (1.1 + dice.number())};
}

TEST(CurrentLoop, AgreesWithBiotAndSavartSummedNumerically) {
  test::Dice dice(1);
  for (int trial = 0; trial < 500; ++trial) {
    const CurrentLoop loop = random_loop(dice);
    const Eigen::Vector3d p = loop.centre + 3 * loop.radius * dice.vector();
    if (distance_to_wire(loop, p) < 0.1 * loop.radius) continue;
    const Eigen::Vector3d expected = summed_field(loop, p, 1000);
    const Eigen::Vector3d found = loop_field(loop, p).field;
    EXPECT_LE((found - expected).norm(), 1e-12 * expected.norm()) << trial;
  }
}

TEST(CurrentLoop, HasTheKnownFieldOnItsAxisAndFarAway) {
  const CurrentLoop loop{{1000, -2000, 500}, Eigen::Vector3d(1, 2, 2) / 3, 20000, 30};
  for (const double z : {0.0, 1.0, -3e4, 1e5}) {
    const FieldGradient f = loop_field(loop, loop.centre + z * loop.axis);
    const double expected = 30 * mu_0 * 4e8 / (2 * std::pow(4e8 + z * z, 1.5));
    EXPECT_NEAR((f.field - expected * loop.axis).norm(), 0, 1e-12 * expected);
    const double slope = -3 * z / (4e8 + z * z) * expected;
    EXPECT_NEAR(loop.axis.dot(f.gradient * loop.axis), slope, 1e-11 * (std::abs(slope) + 1e-9));
  }
  // A dipole m = π a² N at a distance of 1000 radii.
  const Eigen::Vector3d u = Eigen::Vector3d(3, -1, 2).normalized();
  const double r = 2e7;
  const Eigen::Vector3d dipole =
      mu_0 / (4 * pi) * pi * 4e8 * 30 / (r * r * r) * (3 * u.dot(loop.axis) * u - loop.axis);
  const Eigen::Vector3d found = loop_field(loop, loop.centre + r * u).field;
  EXPECT_LE((found - dipole).norm(), 5e-6 * dipole.norm());
}

TEST(CurrentLoop, GradientIsThatOfTheFieldAndFreeOfCurlAndDivergence) {
  test::Dice dice(2);
  for (int trial = 0; trial < 300; ++trial) {
    const CurrentLoop loop = random_loop(dice);
    Eigen::Vector3d p = loop.centre + 2 * loop.radius * dice.vector();
    if (trial % 10 == 0) p = loop.centre + loop.radius * dice.number() * loop.axis;
    if (trial % 10 == 1) p += 1e-9 * loop.radius * dice.vector();
    if (distance_to_wire(loop, p) < 0.1 * loop.radius) continue;
    const FieldGradient f = loop_field(loop, p);
    const auto field = [&](const Eigen::Vector3d& at) { return loop_field(loop, at).field; };
    const Eigen::Matrix3d expected = test::difference_gradient(field, p, 1e-3 * loop.radius);
    const double scale = expected.norm() + f.field.norm() / loop.radius;
    EXPECT_LE((f.gradient - expected).norm(), 1e-7 * scale) << trial;
    EXPECT_NEAR(expected.trace(), 0, 1e-7 * scale);
    EXPECT_LE((expected - expected.transpose()).norm(), 1e-7 * scale);
    EXPECT_NEAR(f.gradient.trace(), 0, 1e-12 * scale);
  }
}

TEST(CurrentLoop, IsSmoothWhereSeriesAndIntegralsMeet) {
  const CurrentLoop loop{};
  // m = 0.1 at about this ρ in the plane of the loop: both sides agree.
  const double rho = 0.0263;
  for (const double z : {0.0, 0.3}) {
    Eigen::Vector3d last = loop_field(loop, {rho - 1e-5, 0, z}).field;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d next = loop_field(loop, {rho - 1e-5 + 1e-7 * (i + 1), 0, z}).field;
      EXPECT_LE((next - last).norm(), 1e-6 * next.norm());
      last = next;
    }
  }
}

TEST(CurrentLoop, StaysFiniteOnTheWire) {
  const FieldGradient f = loop_field(CurrentLoop{}, {1, 0, 0});
  EXPECT_TRUE(f.field.allFinite());
  EXPECT_TRUE(f.gradient.allFinite());
}

/// On the axis of a solenoid with thick walls: the loops' field integrated by hand.
double solenoid_on_axis(double z, double inner, double outer, double length, double turns) {
  const auto part = [&](double x) {
    return x * std::log((outer + std::hypot(outer, x)) / (inner + std::hypot(inner, x)));
  };
  return mu_0 * turns / (2 * length * (outer - inner)) *
         (part(z + length / 2) - part(z - length / 2));
}

TEST(Winding, SolenoidHasTheKnownFieldOnItsAxis) {
  WindingParams w;
  w.radius = 30000;
  w.turns = 400;
  w.length = 40000;
  w.thickness = 20000;
  Issues issues;
  const std::vector<CurrentLoop> loops = to_loops(w, issues);
  EXPECT_TRUE(issues.empty());
  for (const double z : {0.0, 1e4, 2e4, 5e4, -1e5}) {
    const double expected = solenoid_on_axis(z, 20000, 40000, 40000, 400);
    const Eigen::Vector3d found = field_at(loops, {0, 0, z}).field;
    EXPECT_NEAR(found.z(), expected, 1e-9 * expected) << z;
  }
  double turns = 0;
  for (const CurrentLoop& loop : loops) turns += loop.turns;
  EXPECT_NEAR(turns, 400, 1e-9);
}

TEST(Winding, ThinLayerIsManyLoops) {
  WindingParams w;
  w.centre = {1e4, 0, 0};
  w.axis = {0, 3, 0};
  w.radius = 20000;
  w.turns = 100;
  w.length = 30000;
  Issues issues;
  const std::vector<CurrentLoop> loops = to_loops(w, issues);
  EXPECT_TRUE(issues.empty());
  std::vector<CurrentLoop> many;
  for (int i = 0; i < 3000; ++i)
    many.push_back({{1e4, 30000 * ((i + 0.5) / 3000 - 0.5), 0}, {0, 1, 0}, 20000, 100.0 / 3000});
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(1e4, 0, 0), Eigen::Vector3d(1.5e4, 3e3, -4e3),
                                   Eigen::Vector3d(8e4, 1e4, 0)})
    EXPECT_LE((field_at(loops, p).field - field_at(many, p).field).norm(),
              1e-7 * field_at(many, p).field.norm());
}

TEST(Winding, RefusesWhatIsNoWinding) {
  const auto refusal = [](const WindingParams& winding) {
    Issues issues;
    EXPECT_TRUE(to_loops(winding, issues).empty());
    EXPECT_EQ(issues.size(), 1u);
    return issues.begin()->text;
  };
  WindingParams w;
  w.axis = {0, 0, 0};
  EXPECT_EQ(refusal(w), "axis is [0, 0, 0], must have a direction");
  w.axis = {0, 1};
  EXPECT_TRUE(test::is_one_line_naming(refusal(w), "", {"axis", "2", "numbers", "[x, y, z]"}));
  w.axis = {0, 1, 0};
  w.radius = 1000;
  w.thickness = 2000;
  EXPECT_TRUE(test::is_one_line_naming(refusal(w), "", {"thickness_um", "2000 µm"}));
}

}  // namespace
}  // namespace microswarm::actuation

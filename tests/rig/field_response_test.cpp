// SPDX-License-Identifier: Apache-2.0
// A field that was made for a command drives a swarm by that command.
#include "microswarm/rig/simulation/field_response.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"

namespace microswarm::rig {
namespace {

constexpr double step = 0.005;  // [s]

class EveryField : public testing::TestWithParam<actuation::FieldKind> {
 protected:
  EveryField() {
    field.kind = GetParam();
    if (field.kind == actuation::FieldKind::rolling) field.frequency = 6;
    response.kind = field.kind;
    response.frequency = field.frequency;
    response.speed_per_pitch = field.speed_per_pitch;
    response.length_per_turn = field.length_per_turn;
  }
  actuation::FieldGeneratorParams field;
  FieldResponseParams response;
};

TEST_P(EveryField, DrivesAsCommanded) {
  Rng rng(1, Purpose::test);
  actuation::FieldGenerator generator(field, 0.3);
  FieldResponse swarm(response);
  for (int command = 0; command < 40; ++command) {
    const Command wanted{rng.uniform(-pi, pi), rng.uniform(5, 95)};
    generator.command(wanted);
    Command driven;
    const double way = 8 * field.length_per_turn;  // on which a rolling body comes to its line
    const int steps = std::max(300, static_cast<int>(way / wanted.speed / step));
    for (int i = 0; i < steps; ++i) driven = swarm.step(generator.advance(step), step);
    EXPECT_NEAR(driven.speed, wanted.speed, 0.02 * wanted.speed);
    EXPECT_LT(turn_between(driven.heading, wanted.heading), radians(1));
  }
}

TEST_P(EveryField, SendingInUnevenPiecesChangesNothing) {
  actuation::FieldGenerator generator(field, 0);
  FieldResponse swarm(response);
  generator.command({0.5, 60});
  for (int i = 0; i < 200; ++i) swarm.step(generator.advance(0.01), 0.01);
  double way = 0;
  for (int i = 0; i < 300; ++i) {  // the field jumps every 10 ms and is looked at more often
    const Eigen::Vector3d now = generator.advance(0.01);
    for (const double piece : {0.005, 0.003, 0.002}) way += piece * swarm.step(now, piece).speed;
  }
  EXPECT_NEAR(way, 3 * 60, 4);
}

TEST_P(EveryField, HoldsAtSpeedZero) {
  actuation::FieldGenerator generator(field, 1);
  FieldResponse swarm(response);
  generator.command({1, 60});
  for (int i = 0; i < 400; ++i) swarm.step(generator.advance(step), step);
  generator.command({});
  Command driven;
  for (int i = 0; i < 400; ++i) driven = swarm.step(generator.advance(step), step);
  EXPECT_NEAR(driven.speed, 0, 1e-6);
  // While the pitch of a rotating field falls, its plane wobbles.
  if (field.kind != actuation::FieldKind::rotating) {
    EXPECT_LT(turn_between(driven.heading, 1), radians(2));
  }
}

TEST_P(EveryField, NothingMovesWithoutAField) {
  actuation::FieldGenerator generator(field, 1);
  FieldResponse swarm(response);
  generator.command({1, 60});
  for (int i = 0; i < 400; ++i) swarm.step(generator.advance(step), step);
  for (int i = 0; i < 40; ++i) EXPECT_EQ(swarm.step(Eigen::Vector3d::Zero(), step).speed, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryField,
                         testing::Values(actuation::FieldKind::rotating,
                                         actuation::FieldKind::rolling,
                                         actuation::FieldKind::oscillating),
                         [](const auto& kind) { return std::string(enum_name(kind.param)); });

}  // namespace
}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
// A billion robot-steps over generated maps and real vessel masks, which takes minutes: run it with
// --gtest_also_run_disabled_tests --gtest_filter='*BillionSteps*'.
#include <gtest/gtest.h>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/scenes/vascular.hpp"
#include "microswarm/swarm/robots/robot_stepper.hpp"
#include "tests/files.hpp"

namespace microswarm {
namespace {

constexpr int robots_a_map = 1000;
constexpr double steps_in_all = 1e9;
constexpr int looked_at_every = 50;  // moves

struct Ground {
  std::string name;
  Map map;
  double step;
};

std::vector<Ground> grounds() {
  std::vector<Ground> all;
  for (const auto& v :
       {scenes::t_junction(), scenes::vascular_network(), scenes::larger_vascular_network()})
    all.push_back({v.name, v.map(), v.width / 10});
  Rng rng(11, Purpose::scene);
  for (int i = 0; i < 9; ++i) {
    const double size = 100 * (1 + i % 3);
    const auto v = scenes::random_vascular({.width = size, .height = 0.9 * size}, rng);
    all.push_back({"generated " + std::to_string(i + 1), v.map(), 1});
  }
  for (const char* name : {"01L", "05R", "09L", "12R"}) {
    const auto file =
        test::data_folder() / "vessels" / (std::string("CHASE_") + name + "_mask_obs1.png");
    if (std::filesystem::exists(file))
      all.push_back({name, *formats::load_map(formats::guess_map_spec(file, 6.0)).map, 4});
  }
  return all;
}

Robots anywhere(const RobotStepper& stepper, const Map& map, Rng& rng) {
  std::vector<Vec2> positions;
  const Box& b = map.bounds();
  for (int draw = 0; draw < 10'000'000 && std::ssize(positions) < robots_a_map; ++draw) {
    const Vec2 p = uniform_in(b, rng);
    if (map.is_free(p, 4 * stepper.guard())) positions.push_back(p);
  }
  return stepper.place(positions);
}

/// Robots that have left the free space, of as many steps as asked for: some of the headings along
/// walls and diagonals, some moves long, some repeated hundreds of times.
int strays(const Ground& ground, ContactRule rule, double robot_steps) {
  const RobotStepper stepper(ground.map, ground.step);
  Rng rng(12, Purpose::scene);
  Robots robots = anywhere(stepper, ground.map, rng);
  int strays = 0;
  int left = 0;
  Vec2 move;
  for (double k = 0; k * static_cast<double>(robots.size()) < robot_steps; ++k) {
    if (left-- == 0) {
      left = 1 << rng.below(9);
      const double any = rng.uniform(0, 2 * pi);
      const double heading = rng.below(4) == 0 ? pi / 4 * static_cast<double>(rng.below(8)) : any;
      move = ground.step * (rng.below(8) == 0 ? rng.uniform(0, 4) : 1) * unit_vector(heading);
    }
    stepper.step(robots, move, rule);
    if (static_cast<long>(k) % looked_at_every != 0) continue;
    for (const Vec2 p : robots.positions()) strays += !ground.map.is_free(p, 0);
  }
  return strays;
}

TEST(SteppingCampaign, DISABLED_BillionStepsAndNoRobotLeavesTheFreeSpace) {
  const std::vector<Ground> all = grounds();
  constexpr std::array rules{ContactRule::slide, ContactRule::stop, ContactRule::reject};
  const double share = steps_in_all / static_cast<double>(all.size() * rules.size());
  for (const Ground& ground : all)
    for (const ContactRule rule : rules)
      EXPECT_EQ(strays(ground, rule, share), 0) << ground.name << ", rule " << enum_name(rule);
}

}  // namespace
}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
// Laws that every navigator of individually tracked robots keeps.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "microswarm/core/maths/hash.hpp"
#include "microswarm/navigation/make.hpp"
#include "microswarm/scenes/global_worlds.hpp"
#include "microswarm/scenes/vascular.hpp"
#include "tests/navigation/robot_scene.hpp"

namespace microswarm {
namespace {

constexpr double robot_tick = 0.125;  // a power of two: times add up exactly
constexpr double robot_timeout = 0.5;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr int max_ticks = 3000;

/// A navigator and what it is to do.
struct RobotCase {
  std::string name;
  navigation::NavigatorParams params;
  std::function<Map()> map;
  RobotSwarmParams robots;
  std::optional<Vec2> goal;  ///< one for all, else each has its own
  double goal_tolerance;
  std::string golden;  ///< hash of its commands and states
};

void PrintTo(const RobotCase& c, std::ostream* os) { *os << c.name; }

using Change = std::function<void(Observation&)>;

class RobotNavigatorLaws : public testing::TestWithParam<RobotCase> {
 protected:
  std::unique_ptr<Navigator> make(const RobotSwarmParams& robots, std::uint64_t seed = 1) const {
    const navigation::Task task{.swarm = {},
                                .robots = robots,
                                .goal = GetParam().goal,
                                .goal_tolerance = GetParam().goal_tolerance,
                                .tick = robot_tick,
                                .frame_timeout = robot_timeout};
    EXPECT_EQ(navigation::unsupported_reason(GetParam().params, task), "");
    return navigation::make_navigator(GetParam().params, task, Rng(seed, Purpose::planner));
  }
  test::RobotScene scene(const RobotSwarmParams& robots, std::size_t delay = 1,
                         double begin = 0) const {
    return {GetParam().map(), robots, robots.starts, delay, robot_tick, begin};
  }
  RobotSwarmParams noisy() const {
    RobotSwarmParams robots = GetParam().robots;
    robots.position_noise = 1;
    robots.heading_noise = 0.05;
    robots.speed_spread = 0.1;
    return robots;
  }
  /// The goal is reached, measured at where the robots are.
  bool is_done(const test::RobotScene& s) const {
    if (!GetParam().goal) return s.worst() <= GetParam().goal_tolerance + 1e-3;
    double sum = 0;
    for (const Vec2 p : s.places()) sum += distance(p, *GetParam().goal);
    return sum <= GetParam().goal_tolerance * static_cast<double>(s.params.starts.size());
  }

  struct Ended {
    std::vector<Command> commands;
    std::vector<NavigatorState> states;
    bool arrived = false;
    bool done = false;  ///< as measured
  };
  /// Steers until it says that it has arrived; `change` is done to what it is shown.
  Ended drive(test::RobotScene s, int ticks = max_ticks, const Change& change = {}) const {
    const auto navigator = make(s.params);
    navigator->prepare(s.world, {});
    Ended out;
    for (int k = 0; k < ticks && !out.arrived; ++k) {
      Observation seen = s.observe();
      if (change) change(seen);
      out.commands.push_back(navigator->step(seen, {}));
      out.states.push_back(navigator->view().state);
      out.arrived = out.states.back() == NavigatorState::arrived;
      s.apply(out.commands.back());
    }
    // What is still on its way takes effect.
    for (int k = 0; k < 4; ++k) s.apply({});
    out.done = is_done(s);
    return out;
  }
  static std::string digest(const Ended& ended) {
    Hash hash;
    for (const Command& c : ended.commands) {
      hash.value(c.heading);
      hash.value(c.speed);
    }
    for (const NavigatorState state : ended.states) hash.text(enum_name(state));
    return hash.hex();
  }
};

// In every build, and after any other run.
TEST_P(RobotNavigatorLaws, SameSeedSameBits) {
  EXPECT_EQ(digest(drive(scene(noisy()), 200)), GetParam().golden);
}

// It knows no clock but the observation's.
TEST_P(RobotNavigatorLaws, TheTimeOfDayDoesNotMatter) {
  const RobotSwarmParams robots = GetParam().robots;
  EXPECT_EQ(digest(drive(scene(robots, 1, 0), 200)), digest(drive(scene(robots, 1, 4096), 200)));
}

// As when a parameter is changed during a run: a new navigator takes over and needs no past.
TEST_P(RobotNavigatorLaws, ANewOneTakesOverOnTheWay) {
  test::RobotScene s = scene(GetParam().robots, 0);
  bool arrived = false;
  for (int one = 0; one < 4 && !arrived; ++one) {
    const auto navigator = make(s.params, 7);
    navigator->prepare(s.world, {});
    for (int k = 0; k < (one < 3 ? 40 : max_ticks) && !arrived; ++k) {
      s.apply(navigator->step(s.observe(), {}));
      arrived = navigator->view().state == NavigatorState::arrived;
    }
  }
  EXPECT_TRUE(arrived);
  EXPECT_TRUE(is_done(s));
}

TEST_P(RobotNavigatorLaws, CommandsAreWithinLimits) {
  for (std::size_t delay = 0; delay < 3; ++delay) {
    const Ended ended = drive(scene(noisy(), delay), 400);
    for (const Command& c : ended.commands) {
      ASSERT_TRUE(std::isfinite(c.heading) && std::isfinite(c.speed));
      ASSERT_GE(c.speed, 0);
      ASSERT_LE(c.speed, GetParam().robots.max_speed * (1 + 1e-12));
    }
  }
}

TEST_P(RobotNavigatorLaws, BringsAllThereHoweverLateItSees) {
  std::size_t at_once = 0;
  for (const std::size_t delay : {0, 1, 3})
    for (const double lag : {0.0, 0.1, robot_tick}) {
      RobotSwarmParams robots = GetParam().robots;
      robots.response_lag = lag;
      const Ended ended = drive(scene(robots, delay));
      EXPECT_TRUE(ended.arrived) << delay << " ticks, lag " << lag;
      EXPECT_TRUE(ended.done) << delay << " ticks, lag " << lag;
      // It acts on where the robots are when its command takes effect, so lateness costs nothing.
      if (at_once == 0) at_once = ended.commands.size();
      EXPECT_LE(ended.commands.size(), at_once + at_once / 10 + 8)
          << delay << " ticks, lag " << lag;
    }
}

TEST_P(RobotNavigatorLaws, HoldsOnceArrived) {
  test::RobotScene s = scene(GetParam().robots);
  const auto navigator = make(s.params);
  navigator->prepare(s.world, {});
  int after = 0;
  for (int k = 0; k < max_ticks && after < 50; ++k) {
    const Command command = navigator->step(s.observe(), {});
    if (navigator->view().state == NavigatorState::arrived || after > 0) {
      ASSERT_EQ(navigator->view().state, NavigatorState::arrived) << after;
      ASSERT_EQ(command.speed, 0) << after;
      ++after;
    }
    s.apply(command);
  }
  EXPECT_EQ(after, 50);
}

TEST_P(RobotNavigatorLaws, HoldsWithoutAGoodLook) {
  test::RobotScene s = scene(GetParam().robots, 0);
  const auto navigator = make(s.params);
  navigator->prepare(s.world, {});
  std::vector<Vec2> positions = s.places();
  const auto expect_hold = [&](const char* what, auto spoil) {
    Observation bad = s.observe();
    positions.assign(bad.robots.begin(), bad.robots.end());
    bad.robots = positions;
    spoil(bad);
    const Command c = navigator->step(bad, {});
    EXPECT_EQ(c.speed, 0) << what;
    EXPECT_TRUE(std::isfinite(c.heading)) << what;
    EXPECT_EQ(navigator->view().state, NavigatorState::blind) << what;
    s.apply(c);
  };
  for (int k = 0; k < 2; ++k) {  // before it ever saw the robots, and on their way
    expect_hold("no robots", [](Observation& o) { o.robots = {}; });
    expect_hold("no number", [&](Observation&) { positions.back().y = no_number; });
    expect_hold("infinite", [&](Observation&) { positions.front().x = 1 / 0.0; });
    expect_hold("stale", [](Observation& o) { o.seen = o.now - robot_timeout - 0.01; });
    if (!GetParam().goal)
      expect_hold("too few", [](Observation& o) { o.robots = o.robots.first(1); });
    for (int i = 0; i < 10; ++i) {
      const Command c = navigator->step(s.observe(), {});
      EXPECT_NE(navigator->view().state, NavigatorState::blind);
      EXPECT_GT(c.speed, 0) << i;
      s.apply(c);
    }
  }
}

TEST_P(RobotNavigatorLaws, AFrameAsOldAsTheTimeoutIsNotStale) {
  const test::RobotScene s = scene(GetParam().robots, 0);
  const auto navigator = make(s.params);
  navigator->prepare(s.world, {});
  Observation seen = s.observe();
  seen.now = seen.seen + robot_timeout;
  EXPECT_GT(navigator->step(seen, {}).speed, 0);
}

// The robots one by one and the map it was prepared with are all it needs.
TEST_P(RobotNavigatorLaws, UsesNothingThatMayBeMissing) {
  const Ended shown = drive(scene(GetParam().robots), 120);
  const Ended without = drive(scene(GetParam().robots), 120, [](Observation& seen) {
    seen.swarm.reset();
    seen.world = nullptr;
  });
  EXPECT_EQ(digest(shown), digest(without));
}

TEST_P(RobotNavigatorLaws, RobotsInAWallAreNoCrash) {
  const test::RobotScene s = scene(GetParam().robots, 0);
  const auto navigator = make(s.params);
  navigator->prepare(s.world, {});
  std::vector<Vec2> positions = s.places();
  const Box bounds = s.map.bounds();
  for (int k = 0; k < 6; ++k) {
    const double t = k / 5.0;
    positions[0] = {bounds.lo.x + t * bounds.width(), bounds.lo.y + t * bounds.height()};
    Observation seen = s.observe();
    seen.now = seen.seen = robot_tick * k;
    seen.robots = positions;
    const Command c = navigator->step(seen, {});
    EXPECT_TRUE(std::isfinite(c.heading) && std::isfinite(c.speed));
    EXPECT_LE(c.speed, s.params.max_speed * (1 + 1e-12));
  }
}

// Told to stop it may hold, but it ends at once and goes on when it may.
TEST_P(RobotNavigatorLaws, EndsItsThinkingWhenTold) {
  const test::RobotScene s = scene(GetParam().robots, 0);
  const auto navigator = make(s.params);
  navigator->prepare(s.world, {});
  const std::atomic<bool> stop{true};
  const Command c = navigator->step(s.observe(), Stop(&stop));
  EXPECT_TRUE(std::isfinite(c.heading) && std::isfinite(c.speed));
  EXPECT_LE(c.speed, s.params.max_speed * (1 + 1e-12));
  Observation later = s.observe();
  later.now = later.seen = 60;
  EXPECT_GT(navigator->step(later, {}).speed, 0);
}

RobotCase gathering(std::string name, const navigation::AggregationParams& params,
                    std::string golden) {
  RobotCase c{std::move(name),  params, [] { return scenes::t_junction().map(); }, {}, {}, 20,
              std::move(golden)};
  c.goal = scenes::t_junction().goal;
  c.robots.max_speed = 8;  // a step of 1 µm a tick
  Rng rng(4, Purpose::scene);
  for (int i = 0; i < 24; ++i) {
    const double x = rng.uniform(2, 98);
    c.robots.starts.push_back({x, rng.uniform(92, 98)});
  }
  return c;
}

RobotCase global_input(std::string name, const navigation::PlanExecutorParams& params,
                       ContactRule contact, std::string golden) {
  RobotCase c{std::move(name),  params, [] { return scenes::global_world(1); }, {}, {}, 20,
              std::move(golden)};
  c.robots.starts = {{60, 300}, {60, 250}};
  c.robots.goals = {{330, 300}, {330, 200}};
  c.robots.contact = contact;
  c.robots.max_speed = 30;
  return c;
}

std::vector<RobotCase> robot_cases() {
  navigation::AggregationParams dca;
  dca.tree.nodes = 2000;
  navigation::AggregationParams heuristic = dca;
  heuristic.method = navigation::Aggregation::heuristic;
  navigation::AggregationParams published = dca;
  published.reading = navigation::DcaReading::published;
  published.obstacle_weighted = false;
  navigation::AggregationParams rollout = dca;
  rollout.method = navigation::Aggregation::rollout;
  rollout.rollout.budget = 2e4;
  rollout.rollout.first_budget = 2e4;
  navigation::AggregationParams chase = dca;
  chase.method = navigation::Aggregation::dynamic_shortest_path;
  return {gathering("DivideAndConquer", dca, "fefaa74672606905"),
          gathering("Heuristic", heuristic, "d683db1fb92e6414"),
          gathering("AsPublished", published, "a324eefc04c1cb9d"),
          gathering("Rollout", rollout, "2dcf821fd87bf00b"),
          gathering("DynamicShortestPath", chase, "74d97e8f2e6f7fea"),
          global_input("PlanPlayerSlide", {}, ContactRule::slide, "0c1555af99c4d5e6"),
          global_input("PlanPlayerStop", {}, ContactRule::stop, "44c3343896a6d6e1")};
}

INSTANTIATE_TEST_SUITE_P(All, RobotNavigatorLaws, testing::ValuesIn(robot_cases()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace microswarm

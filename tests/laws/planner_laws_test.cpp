// SPDX-License-Identifier: Apache-2.0
// Laws that every planner keeps, whatever the world. Clearances are measured by asking every shape
// of the world, not by the queries the planners use.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/planning/path/planners.hpp"
#include "microswarm/planning/trees/search_tree.hpp"
#include "microswarm/planning/trees/turn_edge.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm {
namespace {

using scenes::RawWorld;

/// Distances of one and the same pair, computed in two ways, differ by no more than this [µm].
constexpr double rounding = 1e-9;

struct Case {
  std::string name;
  planning::PlannerParams params;
  std::uint64_t golden;  ///< digest of its plans below
};

void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }

template <class Params>
Params small(double tolerance = 30) {
  Params params;
  params.clearance = 10;
  params.goal_tolerance = tolerance;
  if constexpr (requires { params.max_iterations; }) {
    params.max_nodes = 600;
    params.max_iterations = 2000;
  }
  if constexpr (std::is_same_v<Params, planning::FmtStarParams>) {
    params.samples = 400;
    params.max_nodes = 3200;
  }
  return params;
}

template <class Params>
Params grown() {
  Params params = small<Params>();
  params.stop_at_first = false;
  params.max_nodes = 300;
  return params;
}

planning::DrrtStarParams plain_drrt_star() {
  planning::DrrtStarParams params = small<planning::DrrtStarParams>();
  params.straighten = false;
  params.exact_route = false;
  return params;
}

planning::DrrtStarParams arcs_drrt_star() {
  planning::DrrtStarParams params = small<planning::DrrtStarParams>();
  params.arcs = true;
  params.turn_radius = 15;
  return params;
}

std::vector<Case> cases();

bool is_exact(const planning::PlannerParams& params) {
  return std::holds_alternative<planning::ExactParams>(params);
}

bool has_no_tree(const planning::PlannerParams& params) {
  return is_exact(params) || std::holds_alternative<planning::AStarParams>(params) ||
         std::holds_alternative<planning::ThetaStarParams>(params);
}

void set_clearance(planning::PlannerParams& params, double clearance) {
  std::visit([&](auto& p) { p.clearance = clearance; }, params);
}

planning::PathCost cost_of(const planning::PlannerParams& params) {
  if (const auto* drrt = std::get_if<planning::DrrtStarParams>(&params)) {
    return {drrt->length_weight, drrt->smoothness_weight, drrt->arcs ? drrt->turn_radius : 0};
  }
  return {};
}

double tolerance_of(const planning::PlannerParams& params) {
  return std::visit([](const auto& p) { return p.goal_tolerance; }, params);
}

struct Query {
  scenes::RawWorld world;
  Pose2 start;
  Vec2 goal;
};

Query random_query(int kind, double clearance, std::uint32_t trial) {
  Rng rng(7, Purpose::scene, trial);
  Query query;
  query.world = scenes::random_world(kind, rng);
  query.start = {scenes::random_free_point(query.world, clearance, rng), rng.uniform(-pi, pi)};
  query.goal = scenes::random_free_point(query.world, clearance, rng);
  return query;
}

void expect_free(const scenes::RawWorld& world, Segment s, double clearance) {
  const double found = world.clearance(s);
  EXPECT_GE(found, clearance - rounding)
      << s.a.x << ", " << s.a.y << " to " << s.b.x << ", " << s.b.y;
  if (clearance == 0) {
    EXPECT_GT(found, 0);
  }
}

void expect_good_path(const Query& query, const Plan& plan, double clearance, double tolerance) {
  ASSERT_FALSE(plan.path.empty());
  EXPECT_EQ(plan.path.front(), query.start.position);
  if (plan.status == Status::solved) {
    EXPECT_LE(distance(plan.path.back(), query.goal), tolerance);
  }
  for (std::size_t i = 1; i < plan.path.size(); ++i) {
    EXPECT_NE(plan.path[i - 1], plan.path[i]);
    expect_free(query.world, {plan.path[i - 1], plan.path[i]}, clearance);
  }
}

void expect_good_tree(const Query& query, const Plan& plan, double clearance,
                      planning::PathCost cost) {
  const auto& tree = plan.tree;
  ASSERT_FALSE(tree.empty());
  EXPECT_EQ(tree[0].parent, 0u);
  EXPECT_EQ(tree[0].position, query.start.position);
  EXPECT_EQ(tree[0].heading, query.start.heading);
  EXPECT_EQ(tree[0].cost, 0);
  for (std::uint32_t i = 1; i < tree.size(); ++i) {
    const TreeNode& node = tree[i];
    ASSERT_LT(node.parent, tree.size());
    const TreeNode& parent = tree[node.parent];
    EXPECT_EQ(node.heading, cost.heading_at_end(parent, node.position));
    EXPECT_EQ(node.cost, parent.cost + cost.edge(parent, node.position));
    std::vector<Vec2> edge{parent.position, node.position};
    if (cost.turn_radius > 0) {
      edge.clear();
      planning::append_edge({parent.position, parent.heading}, node.position, cost.turn_radius,
                            edge);
    }
    for (std::size_t k = 1; k < edge.size(); ++k)
      expect_free(query.world, {edge[k - 1], edge[k]}, clearance);
    std::size_t steps = 0;
    for (std::uint32_t at = i; at != 0 && steps <= tree.size(); at = tree[at].parent) ++steps;
    ASSERT_LE(steps, tree.size()) << "cycle at node " << i;
  }
}

class PlannerLaws : public testing::TestWithParam<Case> {
 protected:
  Plan run(const Query& query, const planning::PlannerParams& params, const Stop& stop = {}) const {
    Rng rng(11, Purpose::planner);
    return plan(query.world.snapshot(), query.start, query.goal, params, rng, stop);
  }
};

TEST_P(PlannerLaws, PathAndTreeKeepTheClearance) {
  int solved = 0;
  int asked = 0;
  for (const double clearance : {0.0, 10.0, 35.0}) {
    for (std::uint32_t trial = 0; trial < 4 * scenes::random_kinds; ++trial) {
      const Query query =
          random_query(static_cast<int>(trial % scenes::random_kinds), clearance, trial);
      SCOPED_TRACE(query.world.name + ", trial " + std::to_string(trial) + ", clearance " +
                   std::to_string(clearance));
      planning::PlannerParams params = GetParam().params;
      set_clearance(params, clearance);
      const Plan plan = run(query, params);
      expect_good_path(query, plan, clearance, tolerance_of(params));
      if (has_no_tree(params)) {
        EXPECT_TRUE(plan.tree.empty());
      } else {
        expect_good_tree(query, plan, clearance, cost_of(params));
      }
      if (std::holds_alternative<planning::DrrtStarParams>(params)) {
        EXPECT_EQ(plan.detections.size(), plan.tree.size());
      }
      ++asked;
      solved += plan.status == Status::solved;
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(solved, asked / 2);
}

TEST_P(PlannerLaws, SameSeedSameBits) {
  Hash hash;
  for (std::uint32_t trial = 0; trial < 2 * scenes::random_kinds; ++trial) {
    const Query query = random_query(static_cast<int>(trial % scenes::random_kinds), 10, trial);
    const Plan first = run(query, GetParam().params);
    const Plan second = run(query, GetParam().params);
    EXPECT_EQ(first.status, second.status);
    EXPECT_EQ(first.path, second.path);
    EXPECT_EQ(first.tree.size(), second.tree.size());
    hash.value(first.status);
    for (const Vec2 p : first.path) {
      hash.value(p.x);
      hash.value(p.y);
    }
    for (const TreeNode& node : first.tree) hash.value(node.cost);
  }
  EXPECT_EQ(hash.digest(), GetParam().golden) << "0x" << hash.hex();
}

Query walled_query() {
  Query query;
  query.world.walls.push_back(scenes::rectangle({{500, 0}, {520, 700}}));
  query.start = {{100, 350}, 0};
  query.goal = {900, 350};
  return query;
}

TEST_P(PlannerLaws, BadStartsAreBlocked) {
  Query query = walled_query();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec2 start : {Vec2{510, 350}, Vec2{495, 350}, Vec2{-50, 350}, Vec2{5, 5}, Vec2{nan, 0},
                           Vec2{0, 1.0 / 0.0}}) {
    query.start.position = start;
    const Plan plan = run(query, GetParam().params);
    EXPECT_EQ(plan.status, Status::start_blocked);
    EXPECT_EQ(plan.path.size(), 1u);
  }
}

TEST_P(PlannerLaws, BadGoalsAreBlocked) {
  Query query = walled_query();
  query.world.walls.push_back(scenes::rectangle({{700, 100}, {900, 600}}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec2 goal : {Vec2{800, 350}, Vec2{1200, 350}, Vec2{400, nan}}) {
    query.goal = goal;
    const Plan plan = run(query, GetParam().params);
    EXPECT_EQ(plan.status, Status::goal_blocked);
    EXPECT_EQ(plan.path, std::vector<Vec2>{query.start.position});
  }
}

TEST_P(PlannerLaws, GoalInAWallIsReachedWhereItsToleranceIsFree) {
  Query query = walled_query();
  query.goal = {510, 350};  // free from x = 490 on
  const Plan plan = run(query, GetParam().params);
  EXPECT_EQ(plan.status, Status::solved);
  expect_good_path(query, plan, 10, tolerance_of(GetParam().params));
}

TEST_P(PlannerLaws, StartAtTheGoalIsSolved) {
  Query query = walled_query();
  query.goal = query.start.position + Vec2{20, 0};
  planning::PlannerParams params = GetParam().params;
  std::visit(
      [](auto& p) {
        if constexpr (requires { p.stop_at_first; }) p.stop_at_first = true;
      },
      params);
  const Plan plan = run(query, params);
  EXPECT_EQ(plan.status, Status::solved);
  EXPECT_EQ(plan.path, std::vector<Vec2>{query.start.position});
}

TEST_P(PlannerLaws, GoalCutOffIsNotSolved) {
  const Query query = walled_query();
  const Plan plan = run(query, GetParam().params);
  const auto* drrt = std::get_if<planning::DrrtStarParams>(&GetParam().params);
  const bool proves = has_no_tree(GetParam().params) || (drrt && drrt->exact_route && !drrt->arcs);
  EXPECT_EQ(plan.status, proves ? Status::no_path : Status::node_limit);
  expect_good_path(query, plan, 10, tolerance_of(GetParam().params));
  EXPECT_GT(plan.path.back().x, 400);  // the best partial path goes up to the wall
}

/// The walled query, with work for minutes.
planning::PlannerParams endless(planning::PlannerParams params) {
  std::visit(
      [](auto& p) {
        if constexpr (requires { p.max_iterations; }) {
          p.max_iterations = 100'000'000;
          p.max_nodes = 10'000'000;
          if constexpr (requires { p.stop_at_first; }) p.stop_at_first = false;
          if constexpr (requires { p.exact_route; }) p.exact_route = false;  // proves it at once
        } else if constexpr (requires { p.samples; }) {
          p.samples = 10'000'000;
          p.max_nodes = 10'000'000;
        } else if constexpr (requires { p.cell; }) {
          p.cell = 0.01;
          p.max_nodes = 100'000'000;
        }
      },
      params);
  return params;
}

double milliseconds_since(Stop::Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Stop::Clock::now() - begin).count();
}

TEST_P(PlannerLaws, StopsWhenTold) {
  const Query query = walled_query();
  const planning::PlannerParams params = endless(GetParam().params);
  std::atomic<bool> flag = true;
  EXPECT_EQ(run(query, params, Stop(&flag)).status, Status::stopped);
  if (is_exact(params)) return;  // nothing takes it minutes

  flag = false;
  Stop::Clock::time_point told;
  std::thread teller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    told = Stop::Clock::now();
    flag = true;
  });
  const Plan stopped = run(query, params, Stop(&flag));
  const Stop::Clock::time_point done = Stop::Clock::now();
  teller.join();
  EXPECT_EQ(stopped.status, Status::stopped);
  EXPECT_LT(std::chrono::duration<double>(done - told).count(), 0.2);  // generous: busy machines
  expect_good_path(query, stopped, 10, 30);
}

TEST_P(PlannerLaws, KeepsItsDeadline) {
  const Query query = walled_query();
  if (is_exact(GetParam().params)) return;  // takes less
  const auto begin = Stop::Clock::now();
  const Plan plan = run(query, endless(GetParam().params), Stop(std::chrono::milliseconds(10)));
  EXPECT_EQ(plan.status, Status::time_limit);
  EXPECT_LT(milliseconds_since(begin), 200);
  expect_good_path(query, plan, 10, 30);
}

std::vector<Case> cases() {
  return {
      {"Exact", small<planning::ExactParams>(), 0xf388b469f2290449},
      {"AStar", small<planning::AStarParams>(), 0xbbb6ea61a7b7c14d},
      {"ThetaStar", small<planning::ThetaStarParams>(), 0x37b7fd5264e480e6},
      {"Rrt", small<planning::RrtParams>(), 0xf74c8abec189f922},
      {"RrtConnect", small<planning::RrtConnectParams>(), 0x66145b0900477dcd},
      {"RrtStar", small<planning::RrtStarParams>(), 0xd25316c5a33d98bc},
      {"RrtStarGrown", grown<planning::RrtStarParams>(), 0xd80bf708bf2299f3},
      {"UniformRrtStar", small<planning::UniformRrtStarParams>(), 0xcceb0429de52032e},
      {"DrrtStar", small<planning::DrrtStarParams>(), 0x2a9212bcba8ee150},
      {"DrrtStarPlain", plain_drrt_star(), 0xfa289e518101ea98},
      {"DrrtStarGrown", grown<planning::DrrtStarParams>(), 0x3ed0a5e535d1efde},
      {"DrrtStarArcs", arcs_drrt_star(), 0xfdc2a87441338c5f},
      {"FmtStar", small<planning::FmtStarParams>(), 0x2c9f62bc94e4eeba},
  };
}

INSTANTIATE_TEST_SUITE_P(All, PlannerLaws, testing::ValuesIn(cases()),
                         [](const auto& planner) { return planner.param.name; });

}  // namespace
}  // namespace microswarm

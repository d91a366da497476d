// SPDX-License-Identifier: Apache-2.0
// A* against the published optima of the MovingAI benchmarks.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "microswarm/formats/moving_ai.hpp"
#include "microswarm/planning/path/a_star.hpp"
#include "tests/files.hpp"

namespace microswarm {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t every = 200;  // sanitizers are slow; the release build asks every tenth
#else
constexpr std::size_t every = 10;
#endif

/// Asks for every so many-th query of a map.
void expect_optima(const std::filesystem::path& file, std::size_t stride) {
  const Mask blocked = read_moving_ai(file);
  const std::vector<GridQuery> queries = read_scenarios(file.string() + ".scen");
  const Snapshot world(
      std::make_shared<const Map>(cell_bounds(blocked, 1), mask_walls(blocked, 1)));
  AStarParams params;
  params.clearance = 0;
  params.goal_tolerance = 0.25;
  params.cell = 1;
  Rng rng(1, Purpose::planner);
  std::size_t asked = 0;
  // From the last on: that is the longest.
  for (std::size_t i = queries.size(); i > 0; i -= std::min(i, stride), ++asked) {
    const GridQuery& query = queries[i - 1];
    const Vec2 start = cell_centre(blocked, query.start.column, query.start.row, 1);
    const Vec2 goal = cell_centre(blocked, query.goal.column, query.goal.row, 1);
    const Plan found = plan(world, {start, 0}, goal, params, rng);
    ASSERT_EQ(found.status, Status::solved) << "query " << i;
    EXPECT_NEAR(path_length(found.path), query.optimal_length, 1e-4 * (1 + query.optimal_length))
        << "query " << i;
  }
  EXPECT_GE(asked, queries.size() / stride);
}

TEST(GridMapSample, AStarFindsTheOptimum) {
  expect_optima(test::sample_folder() / "blocks.map", 1);
}

class GridMaps : public testing::TestWithParam<const char*> {};

TEST_P(GridMaps, AStarFindsThePublishedOptimum) {
  const auto file = test::data_folder() / "grid_maps" / (std::string(GetParam()) + ".map");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  expect_optima(file, every);
}

INSTANTIATE_TEST_SUITE_P(MovingAi, GridMaps,
                         testing::Values("arena", "den312d", "Berlin_0_256", "32room_000",
                                         "random512-10-0", "maze512-32-0"),
                         [](const auto& map) {
                           std::string name = map.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace microswarm

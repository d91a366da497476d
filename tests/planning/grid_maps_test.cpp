// SPDX-License-Identifier: Apache-2.0
// A* and exact paths against the published optima of the MovingAI benchmarks.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/formats/moving_ai.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/planning/grid/a_star.hpp"
#include "microswarm/planning/path/fit_to_map.hpp"
#include "microswarm/planning/path/planners.hpp"
#include "microswarm/world/connectivity/corner_lattice.hpp"
#include "tests/files.hpp"

namespace microswarm::planning {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t every = 400;  // sanitizers are slow
#else
constexpr std::size_t every = 40;
#endif

/// A map of the benchmark, in cells, and every so many-th of its queries.
class GridMap {
 public:
  explicit GridMap(const std::filesystem::path& file)
      : blocked_(formats::read_moving_ai(file)),
        queries_(formats::read_scenarios(file.string() + ".scen")),
        map_(std::make_shared<const Map>(formats::cell_bounds(blocked_, 1),
                                         formats::mask_walls(blocked_, 1))) {}

  const std::shared_ptr<const Map>& map() const { return map_; }

  /// Calls ask(start, goal, published length), from the last query on: that is the longest.
  template <class Ask>
  void ask_every(std::size_t stride, Ask&& ask) const {
    std::size_t asked = 0;
    for (std::size_t i = queries_.size(); i > 0; i -= std::min(i, stride), ++asked) {
      const formats::GridQuery& query = queries_[i - 1];
      SCOPED_TRACE(i);
      ask(formats::cell_centre(blocked_, query.start.column, query.start.row, 1),
          formats::cell_centre(blocked_, query.goal.column, query.goal.row, 1),
          query.optimal_length);
    }
    EXPECT_GE(asked, queries_.size() / stride);
  }

 private:
  formats::Mask blocked_;
  std::vector<formats::GridQuery> queries_;
  std::shared_ptr<const Map> map_;
};

void expect_a_star_optimal(const GridMap& grid, std::size_t stride) {
  const Snapshot world(grid.map());
  AStarParams params;
  params.clearance = 0;
  params.goal_tolerance = 0.25;
  params.cell = 1;
  Rng rng(1, Purpose::planner);
  grid.ask_every(stride, [&](Vec2 start, Vec2 goal, double published) {
    const Plan found = plan(world, {start, 0}, goal, params, rng);
    ASSERT_EQ(found.status, Status::solved);
    EXPECT_NEAR(path_length(found.path), published, 1e-4 * (1 + published));
  });
}

/// A path over cells turns by 45° and goes around corners at a distance. Where it may not cut a
/// corner, two straight moves stand for one diagonal, so that the exact path has at least 1/√2 of
/// its length.
void expect_exact_no_longer(const GridMap& grid, std::size_t stride) {
  ShortestPaths paths(*grid.map(), 0);
  grid.ask_every(stride, [&](Vec2 start, Vec2 goal, double published) {
    const ShortestPath found = paths.find(start, goal);
    ASSERT_EQ(found.status, Status::solved);
    EXPECT_LE(found.length, published + 1e-4 * (1 + published));
    EXPECT_GE(found.length, published / std::numbers::sqrt2 - 1e-4);
    EXPECT_GE(found.length, distance(start, goal) - 1e-9);
    for (std::size_t i = 1; i < found.points.size(); ++i)
      EXPECT_TRUE(grid.map()->is_free(Segment{found.points[i - 1], found.points[i]}, 0));
  });
}

TEST(GridMapSample, AStarFindsTheOptimum) {
  expect_a_star_optimal(GridMap(test::sample_folder() / "blocks.map"), 1);
}

TEST(GridMapSample, ExactPathsAreNoLonger) {
  expect_exact_no_longer(GridMap(test::sample_folder() / "blocks.map"), 1);
}

class GridMaps : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path file() const {
    return test::data_folder() / "grid_maps" / (std::string(GetParam()) + ".map");
  }
};

TEST_P(GridMaps, AStarFindsThePublishedOptimum) {
  if (!std::filesystem::exists(file())) GTEST_SKIP() << "no " << file();
  expect_a_star_optimal(GridMap(file()), every);
}

TEST_P(GridMaps, ExactPathsAreNoLonger) {
  if (!std::filesystem::exists(file())) GTEST_SKIP() << "no " << file();
  const bool is_large = std::string_view(GetParam()).starts_with("random");
  expect_exact_no_longer(GridMap(file()), is_large ? every : every / 10);
}

/// In cells of 1 µm, for a swarm that keeps 0.4 µm: a door of one cell leaves 0.2 µm.
template <class Params>
void expect_fitted_near_shortest(const GridMap& grid, double max_excess) {
  Params params;
  params.clearance = 0.4;
  params = std::get<Params>(
      fit_to_map(params, *grid.map(), [](std::string_view key) { return key == "clearance_um"; }));
  ASSERT_TRUE(params.origin);
  EXPECT_NEAR(std::abs(std::remainder(params.origin->x, 1.0)), 0.5, 1e-9);
  EXPECT_NEAR(params.cell, std::round(params.cell), 1e-9);
  const Snapshot world(grid.map());
  ShortestPaths paths(*grid.map(), params.clearance);
  Rng rng(1, Purpose::planner);
  std::vector<double> excess;
  grid.ask_every(200, [&](Vec2 start, Vec2 goal, double) {
    const Plan found = plan(world, {start, 0}, goal, params, rng);
    ASSERT_EQ(found.status, Status::solved);
    const double shortest = paths.find(start, goal).length;
    EXPECT_LE(path_length(found.path), 1.25 * shortest + 2);
    excess.push_back((path_length(found.path) + distance(found.path.back(), goal)) / shortest);
  });
  EXPECT_LE(quantile(excess, 0.5), max_excess);
}

TEST_P(GridMaps, FittedPathsAreNearTheShortest) {
  if (!std::filesystem::exists(file())) GTEST_SKIP() << "no " << file();
  const GridMap grid(file());
  expect_fitted_near_shortest<AStarParams>(grid, 1.082);  // octile beside straight
  expect_fitted_near_shortest<ThetaStarParams>(grid, 1.03);
}

TEST_P(GridMaps, CornersLieOnTheCells) {
  if (!std::filesystem::exists(file())) GTEST_SKIP() << "no " << file();
  const auto lattice = corner_lattice(*GridMap(file()).map(), 0.5);
  ASSERT_TRUE(lattice);
  EXPECT_NEAR(lattice->pitch, 1, 1e-9);
  EXPECT_NEAR(std::remainder(lattice->origin.x, 1.0), 0, 1e-9);
  EXPECT_NEAR(std::remainder(lattice->origin.y, 1.0), 0, 1e-9);
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
}  // namespace microswarm::planning

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/space_time/earliest_arrival.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/planning/space_time/grid_distances.hpp"

namespace microswarm::planning {
namespace {

using Cell = SpaceTimeGrid::Cell;

// --- the grid ---

TEST(SpaceTimeGrid, SafeIntervalsAreTheRunsOfFreeSlots) {
  SpaceTimeGrid grid({{0, 0}, {30, 0}}, 10, 0.5, 150);
  const Cell c = grid.at(1, 0);
  for (const int slot : {0, 1, 5, 63, 64, 65, 127, 149}) grid.occupy(c, slot);
  std::vector<std::pair<int, int>> runs;
  for (int slot = 0;;) {
    const auto safe = grid.safe_interval(c, slot);
    runs.push_back({safe.begin, safe.end});
    if (safe.end == SpaceTimeGrid::forever) break;
    slot = safe.end;
  }
  EXPECT_EQ(runs, (std::vector<std::pair<int, int>>{
                      {2, 5}, {6, 63}, {66, 127}, {128, 149}, {150, SpaceTimeGrid::forever}}));
  EXPECT_EQ(grid.safe_interval(grid.at(0, 0), 7).end, SpaceTimeGrid::forever);
  EXPECT_EQ(grid.safe_interval(c, 700).begin, 700) << "free after the horizon";
  grid.let_stand(c);
  grid.clear();
  EXPECT_EQ(grid.safe_interval(c, 3).begin, SpaceTimeGrid::forever);
  EXPECT_EQ(grid.safe_interval(c, 700).begin, SpaceTimeGrid::forever);
}

TEST(SpaceTimeGrid, ADiscOccupiesTheCellsWithinItsRadius) {
  Rng rng(5, Purpose::scene);
  for (int trial = 0; trial < 50; ++trial) {
    SpaceTimeGrid grid({{0, 0}, {200, 120}}, 7, 1, 70);
    const Disc disc{{rng.uniform(-30, 230), rng.uniform(-30, 150)}, rng.uniform(0, 60)};
    grid.occupy(disc, 66);
    for (Cell c = 0; c < grid.size(); ++c) {
      const double away = distance(grid.position(c), disc.centre);
      if (std::abs(away - disc.radius) < 1e-6) continue;
      EXPECT_EQ(grid.is_free(c, 66), away > disc.radius);
      EXPECT_TRUE(grid.is_free(c, 65));
    }
  }
}

// Whatever the direction: a point that moves among occupied cells is within half a cell's side of
// one of them in the direction across its way.
TEST(SpaceTimeGrid, AMoveMeetsWhatIsOnItsWayWhenItIsThere) {
  SpaceTimeGrid grid({{0, 0}, {400, 400}}, 10, 1, 40);
  const Cell c = grid.nearest({200, 200});
  for (int slot = 18; slot < 23; ++slot) grid.occupy(c, slot);
  for (int k = 0; k < 64; ++k) {
    const Vec2 out = 180 * unit_vector(0.1 * k);
    const Segment move{grid.position(c) + out, grid.position(c) - out};
    EXPECT_FALSE(grid.is_free(move, 10, 2)) << "there from 18 s on";
    EXPECT_TRUE(grid.is_free(move, 10, 6)) << "there from 23.5 s on";
    EXPECT_TRUE(grid.is_free(move, 12, 0)) << "there until 16 s";
    const Vec2 aside = 11.0 * unit_vector(0.1 * k + 1.5707963);
    EXPECT_TRUE(grid.is_free({move.a + 1.5 * aside, move.b + 1.5 * aside}, 10, 2));
    EXPECT_TRUE(grid.is_open(move));
  }
  grid.let_stand(c);
  for (int k = 0; k < 64; ++k) {
    const Vec2 out = 180 * unit_vector(0.1 * k);
    EXPECT_FALSE(grid.is_open({grid.position(c) + out, grid.position(c) - out}));
    EXPECT_FALSE(grid.is_free({grid.position(c) + out, grid.position(c) - out}, 10, 90));
  }
}

// --- the search, against brute force ---

/// A small world of cells that are occupied at random.
struct CellWorld {
  SpaceTimeGrid grid{{{0, 0}, {70, 60}}, 10, 1, 40};
  Cell start = 0;
  Cell goal = 0;
  GridDistances to_go;

  explicit CellWorld(std::uint32_t trial) {
    Rng rng(7, Purpose::scene, trial);
    start = grid.at(0, 0);
    goal = grid.at(7, 6);
    for (Cell c = 0; c < grid.size(); ++c) {
      if (c == start || c == goal) continue;
      if (rng.uniform(0, 1) < 0.15) grid.let_stand(c);
    }
    grid.clear();
    for (Cell c = 0; c < grid.size(); ++c) {
      for (int slot = 0; slot < grid.slots() && c != start; ++slot)
        if (rng.uniform(0, 1) < 0.12)
          for (int k = 0; k < 4 && slot < grid.slots(); ++k) grid.occupy(c, slot++);
    }
    const std::array seeds{GridDistances::Seed{goal, 0}};
    to_go.compute(grid, seeds);
  }

  double searched(double speed) const {
    SafeIntervalSearch search;
    std::vector<float> zero(grid.size());
    for (Cell c = 0; c < grid.size(); ++c)
      zero[c] = std::isfinite(to_go[c]) ? (c == goal ? 0.0F : 1e-3F) : infinity_f;
    const std::array entries{start};
    const Status status = search.find(grid, {.from = grid.position(start),
                                             .stay_until = infinity,
                                             .entries = entries,
                                             .speed = speed,
                                             .lengths = zero});
    if (status != Status::solved) return infinity;
    check(search, speed);
    return search.arrival();
  }

  /// Whether the path keeps its word: in free cells all the time, also while it waits.
  void check(const SafeIntervalSearch& search, double speed) const {
    const auto path = search.path();
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const double duration = distance(path[i].position, path[i + 1].position) / speed;
      const double depart = path[i + 1].arrival - duration;
      ASSERT_GE(depart, path[i].arrival - 1e-6);
      ASSERT_TRUE(grid.is_free({path[i].position, path[i + 1].position}, speed, depart));
      const Cell here = grid.nearest(path[i].position);
      for (double t = path[i].arrival; t < depart - 1e-6; t += 0.05)
        ASSERT_TRUE(grid.is_free(here, grid.slot_at(t)));
    }
  }

  /// Earliest arrival over steps between neighbours, by following every moment of the time in
  /// ticks of `tick`: it leaves a cell at ticks only.
  double brute_force(double speed, double tick) const {
    std::set<std::tuple<double, Cell>> open{{0.0, start}};
    std::set<std::tuple<long, Cell>> seen;
    while (!open.empty()) {
      const auto [t, c] = *open.begin();
      open.erase(open.begin());
      if (c == goal) return t;
      if (!seen.insert({std::lround(t / tick), c}).second || t > grid.horizon() + 40) continue;
      if (grid.is_free(c, grid.slot_at(t + tick - 1e-9))) open.insert({t + tick, c});
      for (const GridStep& step : grid_steps()) {
        const int column = grid.column_of(c) + step.column;
        const int row = grid.row_of(c) + step.row;
        if (!grid.holds(column, row)) continue;
        const Cell next = grid.at(column, row);
        const double duration = step.length * grid.cell() / speed;
        if (grid.stands(next) || !std::isfinite(to_go[next])) continue;
        if (!grid.is_free({grid.position(c), grid.position(next)}, speed, t)) continue;
        open.insert({std::ceil((t + duration) / tick - 1e-9) * tick, next});
      }
    }
    return infinity;
  }

  static constexpr float infinity_f = std::numeric_limits<float>::infinity();
};

// Brute force waits at each arrival for the next tick and takes no path at any angle: the search is
// never later, and not much earlier.
// A move through cells that stand stays impossible, however long the swarm waits.
TEST(SafeIntervalSearch, NothingIsReachedThroughWhatStands) {
  SpaceTimeGrid grid({{0, 0}, {40, 20}}, 10, 1, 20);
  for (int row = 0; row < 3; ++row) grid.let_stand(grid.at(2, row));
  grid.clear();
  std::vector<float> lengths(grid.size());
  for (Cell c = 0; c < grid.size(); ++c)
    lengths[c] = static_cast<float>(distance(grid.position(c), grid.position(grid.at(4, 1))));
  SafeIntervalSearch search;
  const std::vector<Cell> entries{grid.at(3, 1)};
  const Status status = search.find(grid, {.from = grid.position(grid.at(0, 1)),
                                           .stay_until = infinity,
                                           .entries = entries,
                                           .speed = 10,
                                           .lengths = lengths});
  EXPECT_EQ(status, Status::no_path);
  EXPECT_TRUE(search.path().empty());
}

// Something closes the lane; the swarm goes at once to the last cell before it, and waits there.
TEST(SafeIntervalSearch, WhereNothingLeadsOnItStays) {
  SpaceTimeGrid grid({{0, 0}, {190, 10}}, 10, 1, 20);
  for (int column = 0; column < grid.columns(); ++column)
    for (int row = 0; row < grid.rows(); ++row)
      if (row > 0 || column == 8) grid.let_stand(grid.at(column, row));
  grid.clear();
  std::vector<float> lengths(grid.size());
  for (Cell c = 0; c < grid.size(); ++c)
    lengths[c] = static_cast<float>(distance(grid.position(c), grid.position(grid.at(19, 0))));
  const std::vector<Cell> entries{grid.at(2, 0)};
  const Vec2 from = grid.position(grid.at(2, 0)), end = grid.position(grid.at(7, 0));
  SafeIntervalSearch search;
  ASSERT_EQ(search.find(grid, {.from = from,
                               .stay_until = infinity,
                               .entries = entries,
                               .speed = 10,
                               .lengths = lengths}),
            Status::solved);
  const auto path = search.path();
  ASSERT_GE(path.size(), 3u);
  EXPECT_EQ(path.back().position, end);
  EXPECT_EQ(path.back().arrival, grid.horizon());
  EXPECT_EQ(path[path.size() - 2].position, end);
  EXPECT_NEAR(path[path.size() - 2].arrival, distance(from, end) / 10, 1e-6);
  EXPECT_NEAR(search.arrival(), grid.horizon() + 12, 1e-6);
}

TEST(SafeIntervalSearch, StaysNowhereThatHasNoWayToTheGoal) {
  SpaceTimeGrid grid({{0, 0}, {40, 20}}, 10, 1, 20);
  grid.clear();
  const std::vector<float> lengths(grid.size(), std::numeric_limits<float>::infinity());
  const std::vector<Cell> entries{grid.at(1, 1)};
  SafeIntervalSearch search;
  EXPECT_EQ(search.find(grid, {.from = grid.position(grid.at(0, 1)),
                               .stay_until = infinity,
                               .entries = entries,
                               .speed = 10,
                               .lengths = lengths}),
            Status::no_path);
  EXPECT_TRUE(search.path().empty());
}

// It turns by the angle beyond a small one before it moves, at the start and at a corner.
TEST(SafeIntervalSearch, TurnsTakeTimeAtALimitedRate) {
  const double rate = 2;
  const auto arrival = [&](double heading, bool has_wall, double turn_rate) {
    SpaceTimeGrid grid({{0, 0}, {100, 100}}, 10, 1, 60);
    if (has_wall)
      for (int row = 0; row < 9; ++row) grid.let_stand(grid.at(5, row));
    grid.clear();
    GridDistances distances;
    const std::array<GridDistances::Seed, 1> goal{{{grid.at(9, 5), 0}}};
    distances.compute(grid, goal);
    const std::vector<Cell> entries{grid.at(0, 5), grid.at(1, 5), grid.at(1, 6), grid.at(0, 6)};
    SafeIntervalSearch search;
    EXPECT_EQ(search.find(grid, {.from = grid.position(grid.at(0, 5)),
                                 .stay_until = infinity,
                                 .entries = entries,
                                 .speed = 10,
                                 .heading = heading,
                                 .turning = {turn_rate},
                                 .lengths = distances.lengths()}),
              Status::solved);
    return search.arrival();
  };
  const double small = TurnFirst::small_turn;
  EXPECT_NEAR(arrival(0, false, rate), 9, 1e-6);
  EXPECT_NEAR(arrival(0.9 * small, false, rate), 9, 1e-6);
  EXPECT_NEAR(arrival(pi, false, rate), 9 + (pi - small) / rate, 1e-6);
  EXPECT_NEAR(arrival(pi, false, infinity), 9, 1e-6);
  const double at_once = arrival(0.7, true, infinity);
  EXPECT_GT(arrival(0.7, true, rate), at_once + 0.2) << "the corner above the wall";
  EXPECT_LT(arrival(0.7, true, rate), at_once + 2 * pi / rate);
}

TEST(SafeIntervalSearch, ArrivesAsEarlyAsBruteForce) {
  int solved = 0;
  double sum = 0;
  for (std::uint32_t trial = 0; trial < 60; ++trial) {
    const CellWorld world(trial);
    const double speed = 10;
    const double found = world.searched(speed);
    const double forced = world.brute_force(speed, 0.02);
    ASSERT_EQ(std::isfinite(found), std::isfinite(forced)) << trial;
    if (!std::isfinite(found)) continue;
    ++solved;
    EXPECT_LE(found, forced + 1e-6) << trial;
    sum += forced / found;
  }
  EXPECT_GT(solved, 30);
  EXPECT_LT(sum / solved, 1.05);
}

// --- the clairvoyant ---

World arena(std::vector<Polygon> walls = {}, std::vector<Obstacle> obstacles = {}) {
  return {std::make_shared<const Map>(Box{{0, 0}, {1200, 800}}, std::move(walls)),
          std::move(obstacles)};
}
const ArrivalQuery across{
    .start = {120, 393}, .goal = {1080, 411}, .tolerance = 20, .radius = 40, .speed = 80};

/// Minimum gap between the swarm on its path and everything else [µm].
double min_gap(const World& world, const ArrivalQuery& query, const EarliestArrival& found) {
  double least = infinity;
  for (std::size_t i = 0; i + 1 < found.path.size(); ++i) {
    const Vec2 a = found.path[i].position;
    const Vec2 b = found.path[i + 1].position;
    const double depart = found.path[i + 1].arrival - distance(a, b) / query.speed;
    for (double t = found.path[i].arrival; t < found.path[i + 1].arrival; t += 0.02) {
      const double gone = std::max(0.0, t - depart) * query.speed;
      const Vec2 p = gone > 0 ? a + gone / distance(a, b) * (b - a) : a;
      least = std::min(least, world.at(t).clearance(p) - query.radius);
    }
  }
  return least;
}

TEST(EarliestArrival, InTheOpenItIsTheStraightWay) {
  for (int k = 0; k < 24; ++k) {
    ArrivalQuery query = across;
    query.start = {600, 400};
    query.goal = query.start + 330 * unit_vector(0.26 * k);
    const auto found = earliest_arrival(arena(), query);
    ASSERT_EQ(found.status, Status::solved);
    const double straight = (330 - query.tolerance) / query.speed;
    EXPECT_GE(found.time, straight - 1e-6);
    EXPECT_LE(found.time, straight + 2 * query.cell / query.speed) << k;
  }
}

TEST(EarliestArrival, AroundAWallItIsTheShortestPath) {
  const World world = arena({{{{580, 200}, {620, 200}, {620, 800}, {580, 800}}, {}}});
  const auto found = earliest_arrival(world, across);
  ASSERT_EQ(found.status, Status::solved);
  const double shortest = distance(across.start, Vec2{580, 160}) + 40 +
                          distance(Vec2{620, 160}, across.goal) - across.tolerance;
  EXPECT_GE(found.time, 0.97 * shortest / across.speed);
  EXPECT_LE(found.time, 1.04 * shortest / across.speed);
  EXPECT_GT(min_gap(world, across, found), -1.5);
}

// What is near the goal, but behind a wall, is not at the goal.
TEST(EarliestArrival, DoesNotArriveThroughAWall) {
  const World world = arena({{{{600, 0}, {604, 0}, {604, 700}, {600, 700}}, {}}});
  const ArrivalQuery query{
      .start = {120, 400}, .goal = {620, 400}, .tolerance = 40, .radius = 5, .speed = 80};
  const auto found = earliest_arrival(world, query);
  ASSERT_EQ(found.status, Status::solved);
  EXPECT_GT(found.path.back().position.x, 604);
  EXPECT_GT(found.time, (distance(query.start, Vec2{600, 705}) + 300 - 40) / query.speed);
}

// A door that opens at a known time: it waits for it, and not longer.
TEST(EarliestArrival, WaitsForADoor) {
  const std::vector<Polygon> walls{{{{580, 0}, {620, 0}, {620, 300}, {580, 300}}, {}},
                                   {{{580, 500}, {620, 500}, {620, 800}, {580, 800}}, {}}};
  const World closed = arena(walls, {{BoxShape{200, 30}, Still{{600, 400}, pi / 2}}});
  EXPECT_EQ(earliest_arrival(closed, {across.start, across.goal, 20, 40, 80, 10, 0.2, 60}).status,
            Status::solved)
      << "after the horizon obstacles do not count";
  const Valve valve{
      .span = 200, .thickness = 30, .min_gap = 0, .max_gap = 200, .period = 40, .phase = -0.25};
  const World opens = arena(walls, {{valve, Still{{600, 400}, 0}}});
  const auto found = earliest_arrival(opens, across);
  ASSERT_EQ(found.status, Status::solved);
  EXPECT_GT(found.time, 940 / across.speed + 0.5);
  EXPECT_LT(found.time, 940 / across.speed + 20);
  EXPECT_GT(min_gap(opens, across, found), -4);
}

TEST(EarliestArrival, PassesBetweenWhatMoves) {
  Rng rng(9, Purpose::scene);
  for (int trial = 0; trial < 6; ++trial) {
    std::vector<Obstacle> obstacles;
    for (int i = 0; i < 12; ++i)
      obstacles.push_back({DiscShape{rng.uniform(20, 50)},
                           HarmonicLine{{rng.uniform(300, 1000), rng.uniform(100, 700)},
                                        {rng.uniform(-150, 150), rng.uniform(-150, 150)},
                                        rng.uniform(8, 20),
                                        rng.uniform(0, 1)}});
    const World world = arena({}, obstacles);
    const auto found = earliest_arrival(world, across);
    ASSERT_EQ(found.status, Status::solved) << trial;
    EXPECT_LT(found.time, 40);
    // A disc moves by up to 0.2 s times its speed of 110 µm/s within a slot; half of it counts.
    EXPECT_GT(min_gap(world, across, found), -12) << trial;
  }
}

}  // namespace
}  // namespace microswarm::planning

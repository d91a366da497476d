// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/matching/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "microswarm/core/maths/rng.hpp"

namespace microswarm {
namespace {

using Matrix = std::vector<std::vector<std::optional<double>>>;

/// Least cost of all ways, by trying each column for each row.
double min_cost(const Matrix& costs, double alone, std::size_t row, std::vector<bool>& taken) {
  if (row == costs.size()) return 0;
  double least = alone + min_cost(costs, alone, row + 1, taken);
  for (std::size_t c = 0; c < taken.size(); ++c) {
    if (taken[c] || !costs[row][c]) continue;
    taken[c] = true;
    least = std::min(least, *costs[row][c] + min_cost(costs, alone, row + 1, taken));
    taken[c] = false;
  }
  return least;
}

/// Cost of what was assigned; fails when a column is taken twice or a pair has no edge.
double cost_of(const Matrix& costs, double alone, const std::vector<std::optional<int>>& columns) {
  double sum = 0;
  std::map<int, int> takers;
  for (std::size_t row = 0; row < columns.size(); ++row) {
    if (!columns[row]) {
      sum += alone;
      continue;
    }
    EXPECT_EQ(++takers[*columns[row]], 1);
    const auto& cost = costs[row][static_cast<std::size_t>(*columns[row])];
    EXPECT_TRUE(cost);
    sum += cost.value_or(1e9);
  }
  return sum;
}

std::vector<AssignmentEdge> edges_of(const Matrix& costs) {
  std::vector<AssignmentEdge> edges;
  for (std::size_t r = 0; r < costs.size(); ++r)
    for (std::size_t c = 0; c < costs[r].size(); ++c)
      if (costs[r][c]) edges.push_back({static_cast<int>(r), static_cast<int>(c), *costs[r][c]});
  return edges;
}

TEST(Assignment, CostsWhatTheBestOfAllWaysCosts) {
  Assignment solver;
  Rng rng(1, Purpose::test);
  for (int k = 0; k < 20'000; ++k) {
    const std::size_t rows = rng.below(7);
    const std::size_t columns = rng.below(7);
    const double share = rng.uniform();
    const bool whole = rng.below(2) == 0;  // whole numbers make many ways equally good
    Matrix costs(rows, std::vector<std::optional<double>>(columns));
    for (auto& row : costs)
      for (auto& cost : row) {
        const double drawn = rng.uniform(-3, 12);
        if (rng.uniform() < share) cost = whole ? std::floor(drawn) : drawn;
      }
    const double alone = whole ? 7 : rng.uniform(0, 10);
    const auto& found =
        solver.solve(static_cast<int>(rows), static_cast<int>(columns), edges_of(costs), alone);
    std::vector<bool> taken(columns);
    ASSERT_NEAR(cost_of(costs, alone, found), min_cost(costs, alone, 0, taken), 1e-9) << k;
  }
}

TEST(Assignment, LongChainOfChangesIsFollowed) {
  // Row i may have column i or i + 1; the last row wants column 0 alone, so that all move on.
  constexpr int n = 500;
  std::vector<AssignmentEdge> edges;
  for (int i = 0; i < n; ++i) {
    edges.push_back({i, i, 1});
    edges.push_back({i, i + 1, 2});
  }
  edges.push_back({n, 0, 0});
  Assignment solver;
  const auto& found = solver.solve(n + 1, n + 1, edges, 1e6);
  for (int i = 0; i < n; ++i) EXPECT_EQ(found[i], i + 1);
  EXPECT_EQ(found[n], 0);
}

TEST(Assignment, NothingToPair) {
  Assignment solver;
  EXPECT_TRUE(solver.solve(0, 3, {}, 1).empty());
  EXPECT_EQ(solver.solve(2, 0, {}, 1), (std::vector<std::optional<int>>(2)));
  EXPECT_EQ(solver.solve(1, 1, {{0, 0, 5}}, 1), (std::vector<std::optional<int>>(1)));
}

}  // namespace
}  // namespace microswarm

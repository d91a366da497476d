// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace microswarm {
namespace {

TEST(Parallel, CallsEachIndexOnce) {
  for (const int jobs : {0, 1, 2, 7}) {
    for (const std::size_t count : {0, 1, 5, 1000}) {
      std::vector<int> calls(count, 0);
      for_each_index(count, jobs, [&](std::size_t i) { ++calls[i]; });
      EXPECT_EQ(calls, std::vector<int>(count, 1)) << jobs << " jobs";
    }
  }
}

// How many more begin before the others hear of it is up to the machine; alone it is none.
TEST(Parallel, AnExceptionComesOutAndEndsTheRest) {
  for (const int jobs : {1, 2, 7}) {
    std::vector<int> calls(10'000, 0);
    const auto body = [&](std::size_t i) {
      ++calls[i];
      if (i == 10) throw std::runtime_error("ten");
    };
    EXPECT_THROW(for_each_index(calls.size(), jobs, body), std::runtime_error);
    EXPECT_EQ(std::count(calls.begin(), calls.begin() + 11, 1), 11);
    EXPECT_EQ(std::count_if(calls.begin(), calls.end(), [](int c) { return c > 1; }), 0);
    if (jobs > 1) continue;
    EXPECT_EQ(std::count(calls.begin() + 11, calls.end(), 0), 10'000 - 11);
  }
}

TEST(ThreadTeam, MakesManyLoopsAndGoesOnAfterAnException) {
  for (const int jobs : {1, 2, 5}) {
    ThreadTeam team(jobs);
    for (std::size_t loop = 0; loop < 2000; ++loop) {
      std::vector<int> calls(loop % 9, 0);
      team.for_each_index(calls.size(), [&](std::size_t i) { ++calls[i]; });
      ASSERT_EQ(calls, std::vector<int>(calls.size(), 1));
    }
    EXPECT_THROW(team.for_each_index(3, [](std::size_t) { throw std::runtime_error("three"); }),
                 std::runtime_error);
    std::vector<int> later(100, 0);
    team.for_each_index(later.size(), [&](std::size_t i) { ++later[i]; });
    EXPECT_EQ(later, std::vector<int>(100, 1));
  }
}

}  // namespace
}  // namespace microswarm

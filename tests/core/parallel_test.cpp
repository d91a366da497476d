// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
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

TEST(Parallel, AnExceptionComesOutAndEndsTheRest) {
  std::atomic<int> calls{0};
  EXPECT_THROW(for_each_index(100'000, 2,
                              [&](std::size_t i) {
                                ++calls;
                                if (i == 10) throw std::runtime_error("ten");
                              }),
               std::runtime_error);
  EXPECT_LT(calls, 100'000);
}

}  // namespace
}  // namespace microswarm

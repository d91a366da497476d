// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/map/kept_work.hpp"

#include <gtest/gtest.h>

#include "microswarm/world/map/map.hpp"

namespace microswarm {
namespace {

/// Counts those that live.
struct Work {
  explicit Work(int* count) : living(count) { ++*living; }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;
  ~Work() { --*living; }
  int* living;
};

TEST(KeptWork, IsTakenOnceAndByItsClearanceAndType) {
  int living = 0;
  KeptWork kept;
  kept.keep(10, std::make_unique<Work>(&living));
  EXPECT_EQ(kept.take<Work>(20), nullptr);
  EXPECT_EQ(kept.take<int>(10), nullptr);
  const auto work = kept.take<Work>(10);
  ASSERT_NE(work, nullptr);
  EXPECT_EQ(living, 1);
  EXPECT_EQ(kept.take<Work>(10), nullptr);
}

TEST(KeptWork, TheLatestAreKept) {
  int living = 0;
  {
    KeptWork kept;
    for (int i = 0; i < 10; ++i) kept.keep(i, std::make_unique<Work>(&living));
    EXPECT_EQ(living, static_cast<int>(KeptWork::most));
    EXPECT_EQ(kept.take<Work>(0), nullptr);
    EXPECT_NE(kept.take<Work>(9), nullptr);
  }
  EXPECT_EQ(living, 0);
}

TEST(KeptWork, CopiesOfAMapShareIt) {
  int living = 0;
  auto copy = std::make_unique<Map>();
  {
    const Map map(Box{{0, 0}, {10, 10}}, {});
    *copy = map;
    map.kept().keep(1, std::make_unique<Work>(&living));
  }
  EXPECT_NE(copy->kept().take<Work>(1), nullptr);
  copy->kept().keep(1, std::make_unique<Work>(&living));
  copy.reset();
  EXPECT_EQ(living, 0);
}

}  // namespace
}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
// Sessions in threads of their own.
#include <gtest/gtest.h>

#include <thread>

#include "microswarm/session/session.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/files.hpp"

namespace microswarm {
namespace {

TEST(SessionThreads, EachRunsAndRecordsItsOwn) {
  const test::Folder folder;
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&folder, k] {
      for (int i = 0; i < 5; ++i) {
        Session session(open_experiment(small_flight(), {}));
        for (int j = 0; j < 3; ++j) session.step();
        EXPECT_EQ(session.set("goal_tolerance_um", "x").size(), 1u);
        const auto file = folder / (std::to_string(k) + ".h5");
        session.record_to(file);
        EXPECT_EQ(open_session(file)->record().frames.size(), 3u);
      }
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace microswarm

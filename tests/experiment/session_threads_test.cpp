// SPDX-License-Identifier: Apache-2.0
// Sessions in threads of their own.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "microswarm/experiment/session/session.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/files.hpp"

namespace microswarm::experiment {
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

TEST(SessionThreads, IsOperatedFromAnotherThread) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Scenario scenario = small_flight();
    scenario.time_limit = 1000;
    scenario.hold_at_goal = 1000;
    Session session(open_experiment(scenario, {}));
    std::thread person([&] {
      Rng random(seed, Purpose::planner);
      for (int i = 0; i < 200; ++i) {
        session.operation()->pause(random.uniform() < 0.3);
        session.operation()->manual(random.uniform() < 0.5);
        session.operation()->steer({10 * random.uniform(), 100 * random.uniform()});
        std::this_thread::sleep_for(std::chrono::microseconds(300));
      }
      session.operation()->end();
    });
    session.finish();
    person.join();
    const ReplayResult again = replay(session.record());
    EXPECT_TRUE(again.identical) << again.difference;
  }
}

}  // namespace
}  // namespace microswarm::experiment

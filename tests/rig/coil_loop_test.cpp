// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/coil_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "microswarm/actuation/drivers/simulated_coil_driver.hpp"
#include "microswarm/config/yaml.hpp"

namespace microswarm::rig {
namespace {

constexpr std::chrono::milliseconds standstill{800};

/// Stands still in its tenth exchange, as a program that is stopped there.
class StoppedInAnExchange : public actuation::CoilDriver {
 public:
  actuation::Capabilities capabilities() const override { return {.channels = 3}; }
  const actuation::DeviceReport& report() const override { return report_; }
  actuation::DriveStatus drive(const actuation::CoilRequest&) override {
    if (++sendings_ == 10) std::this_thread::sleep_for(standstill);
    return actuation::DriveStatus::driven;
  }
  actuation::StopReport stop() noexcept override { return {.confirmed = true}; }
  int sendings() const { return sendings_; }

 private:
  actuation::DeviceReport report_{.currents = std::vector<double>(3)};
  std::atomic<int> sendings_ = 0;
};

/// Why a loop ends that is commanded all the time, for two seconds at most.
std::string end_of(actuation::CoilDriver& driver,
                   const std::function<void(const CoilMoment&)>& heard) {
  const actuation::CoilSystem system(
      read_yaml_text<actuation::CoilSystemParams>("coils: {type: helmholtz}", "coils"), "coils");
  actuation::CoilController controller(system, {}, driver, 0);
  CoilLoop loop(controller, {.max_pause = 0.4}, heard);
  for (int i = 0; i < 40 && loop.failure().empty(); ++i) {
    loop.command({0, 20}, controller.place());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return loop.failure();
}

TEST(CoilLoop, AStandstillInAnExchangeEndsIt) {
  StoppedInAnExchange driver;
  const std::string why = end_of(driver, {});
  EXPECT_TRUE(why.starts_with("the program stood still for ")) << why;
  EXPECT_LE(driver.sendings(), 10);
}

TEST(CoilLoop, AStandstillWhileItIsLoggedEndsIt) {
  actuation::SimulatedCoilDriver driver(3, 20);
  int heard = 0;
  const std::string why = end_of(driver, [&](const CoilMoment&) {
    if (++heard == 10) std::this_thread::sleep_for(standstill);
  });
  EXPECT_TRUE(why.starts_with("the program stood still for ")) << why;
  EXPECT_LE(heard, 10);
}

/// Answers 30 ms after it was asked.
class SlowDriver : public StoppedInAnExchange {
 public:
  actuation::DriveStatus drive(const actuation::CoilRequest& request) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    return StoppedInAnExchange::drive(request);
  }
};

TEST(CoilLoop, ARoundTripIsTheTimeOfTheExchange) {
  SlowDriver driver;
  std::vector<double> trips;  // the loop has ended when they are read
  end_of(driver, [&](const CoilMoment& moment) { trips.push_back(moment.round_trip); });
  ASSERT_GE(trips.size(), 5u);
  for (const double trip : trips) EXPECT_GE(trip, 0.03);
  EXPECT_LT(std::ranges::min(trips), 0.4);
}

TEST(CoilLoop, ANewCommandGoesOutHalfAPeriodAfterTheLastSendingAtTheEarliest) {
  const actuation::CoilSystem system(
      read_yaml_text<actuation::CoilSystemParams>("coils: {type: helmholtz}", "coils"), "coils");
  actuation::SimulatedCoilDriver driver(3, 20);
  actuation::CoilController controller(system, {}, driver, 0);
  std::mutex mutex;
  std::vector<CoilMoment> moments;
  CoilLoop loop(controller, {.rate = 1, .deadman = 10, .max_pause = 5},
                [&](const CoilMoment& moment) {
                  const std::lock_guard lock(mutex);
                  moments.push_back(moment);
                });
  const auto wait_for = [&](std::size_t count) {
    for (int i = 0; i < 500; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const std::lock_guard lock(mutex);
      if (moments.size() >= count) return moments;
    }
    return std::vector<CoilMoment>();
  };
  loop.command({0, 20}, controller.place(), 7);
  ASSERT_EQ(wait_for(1).size(), 1u);
  loop.command({0, 30}, controller.place(), 8);
  const std::vector<CoilMoment> all = wait_for(2);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].seen, 7);
  EXPECT_EQ(all[1].seen, 8);
  EXPECT_EQ(all[1].command.speed, 30);
  EXPECT_GE(all[1].t - all[0].t, 0.49);
  EXPECT_LT(all[1].t - all[0].t, 0.95);
  EXPECT_GE(all[1].driven, all[1].t);
}

/// A loop whose computer can be suspended.
struct Sleeper {
  actuation::CoilSystem system{
      read_yaml_text<actuation::CoilSystemParams>("coils: {type: helmholtz}", "coils"), "coils"};
  StoppedInAnExchange driver;
  actuation::CoilController controller{system, {}, driver, 0};
  std::atomic<double> asleep = 100;  // [s], before the program started
  CoilLoop loop{controller, {.max_pause = 0.4}, {}, [this] { return asleep.load(); }};

  void command() { loop.command({0, 20}, controller.place()); }
  /// Waits until the loop ends, two seconds at most.
  std::string end() const {
    for (int i = 0; i < 200 && loop.failure().empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return loop.failure();
  }
};

TEST(CoilLoop, ASuspendedComputerEndsIt) {
  Sleeper sleeper;
  sleeper.command();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(sleeper.loop.failure(), "");
  sleeper.asleep = 130;
  EXPECT_EQ(sleeper.end(), "the computer was suspended for 30 s");
}

TEST(CoilLoop, WhatIsCommandedAfterASuspensionBeforeTheFirstCommandIsNotDriven) {
  Sleeper sleeper;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  sleeper.asleep = 101;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(sleeper.loop.failure(), "");
  sleeper.command();
  EXPECT_EQ(sleeper.end(), "the computer was suspended for 1 s");
  EXPECT_EQ(sleeper.driver.sendings(), 0);
}

}  // namespace
}  // namespace microswarm::rig

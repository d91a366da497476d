// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/robot_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/rng.hpp"

namespace microswarm::vision {
namespace {

constexpr double diameter = 10;  // [µm]
constexpr double dt = 0.1;       // [s]

std::vector<TrackEvent> events_of(const RobotTracker& tracker, TrackChange change) {
  std::vector<TrackEvent> all;
  for (const TrackEvent& e : tracker.events())
    if (e.change == change) all.push_back(e);
  return all;
}

TEST(RobotTracker, CrossingRobotsKeepTheirNames) {
  RobotTracker tracker({.search_range = 8}, diameter, dt);
  for (int k = 0; k <= 40; ++k) {
    const double s = -60 + 3.0 * k;  // both pass the origin 0.5 µm apart
    const std::vector<Vec2> seen{{s, 0.25}, {0.0 + 0.25, s}};
    const auto& at = tracker.step(k, seen);
    ASSERT_EQ(at[0].id, 0) << k;
    ASSERT_EQ(at[1].id, 1) << k;
  }
  EXPECT_EQ(tracker.births(), 2);
  EXPECT_EQ(events_of(tracker, TrackChange::birth).size(), 2U);
}

TEST(RobotTracker, NamesDoNotDependOnTheOrderOfPlaces) {
  Rng rng(3, Purpose::test);
  std::vector<Vec2> positions;
  std::vector<Vec2> moves;
  for (int i = 0; i < 60; ++i) {
    positions.push_back({40.0 * (i % 10), 40.0 * (i / 10)});
    moves.push_back(2 * unit_vector(rng.uniform(0, 2 * pi)));
  }
  RobotTracker tracker({}, diameter, dt);
  std::vector<int> order(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::map<int, int> robot_of_id;
  for (int k = 0; k < 30; ++k) {
    for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[rng.below(i + 1)]);
    std::vector<Vec2> seen;
    for (const int i : order) seen.push_back(positions[i]);
    const auto& at = tracker.step(k, seen);
    for (std::size_t j = 0; j < at.size(); ++j) {
      if (k == 0) robot_of_id[at[j].id] = order[j];
      ASSERT_EQ(robot_of_id.at(at[j].id), order[j]) << k;
    }
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += moves[i];
    for (Vec2& move : moves) move = rotated(move, rng.uniform(-0.05, 0.05));
    for (std::size_t i = 0; i < positions.size(); ++i)  // those about to leave their cell turn back
      if (distance(positions[i], Vec2{40.0 * static_cast<double>(i % 10),
                                      40.0 * static_cast<double>(i / 10)}) > 15)
        moves[i] = 0.5 * moves[i];
  }
  EXPECT_EQ(tracker.births(), 60);
}

TEST(RobotTracker, MissingForItsMemoryARobotGoesOn) {
  for (const int missing : {0, 1, 3, 4}) {
    RobotTracker tracker({.memory = 3, .search_range = 10}, diameter, dt);
    for (int k = 0; k < 20; ++k) {
      std::vector<Vec2> seen{{2.0 * k, 5}};
      if (k >= 10 && k < 10 + missing) seen.clear();
      tracker.step(k, seen);
    }
    tracker.finish();
    EXPECT_EQ(tracker.births(), missing > 3 ? 2 : 1) << missing;
    const auto deaths = events_of(tracker, TrackChange::death);
    ASSERT_EQ(deaths.size(), missing > 3 ? 2U : 1U);
    EXPECT_EQ(deaths[0].frame, missing > 3 ? 9 : 19);
    EXPECT_EQ(deaths.back().frame, 19);
  }
}

TEST(RobotTracker, BirthsAreThoseThatAppear) {
  RobotTracker tracker({}, diameter, dt);
  tracker.step(0, std::vector<Vec2>{{0, 0}});
  tracker.step(1, std::vector<Vec2>{{0, 0}, {100, 0}});
  tracker.step(2, std::vector<Vec2>{{0, 0}, {100, 0}, {0, 100}});
  const auto births = events_of(tracker, TrackChange::birth);
  ASSERT_EQ(births.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(births[i].frame, i);
    EXPECT_EQ(births[i].id, i);
  }
}

TEST(RobotTracker, MergeAndSplitAreNoted) {
  RobotTracker tracker({.memory = 10, .search_range = 6}, diameter, dt);
  int merged_at = -1;
  int split_at = -1;
  for (int k = 0; k < 40; ++k) {  // they pass each other and are seen as one for a while
    const double half = std::abs(20 - k);
    std::vector<Vec2> seen{{-half, 0}, {half, 0}};
    if (half < 3) {
      seen = {{0, 0}};
      if (merged_at < 0) merged_at = k;
    } else if (merged_at >= 0 && split_at < 0) {
      split_at = k;
    }
    tracker.step(k, seen);
  }
  const auto merges = events_of(tracker, TrackChange::merge);
  ASSERT_EQ(merges.size(), 1U);
  EXPECT_EQ(merges[0].frame, merged_at);
  EXPECT_NE(merges[0].id, merges[0].other);
  const auto splits = events_of(tracker, TrackChange::split);
  ASSERT_EQ(splits.size(), 1U);
  EXPECT_EQ(splits[0].frame, split_at);
  EXPECT_TRUE(splits[0].other);
}

TEST(RobotTracker, FlickerIsNeitherMergeNorSplit) {
  RobotTracker tracker({.search_range = 6}, diameter, dt);
  for (int k = 0; k < 60; ++k) {
    std::vector<Vec2> seen{{0, 0}};
    if (k % 5 != 3) seen.push_back({0.9 * diameter, 0});                       // gone now and then
    if (k % 7 < 3) seen.push_back({0, (k % 14 < 7 ? 0.9 : -0.9) * diameter});  // there now and then
    tracker.step(k, seen);
  }
  tracker.finish();
  EXPECT_TRUE(events_of(tracker, TrackChange::merge).empty());
  EXPECT_TRUE(events_of(tracker, TrackChange::split).empty());
}

TEST(RobotTracker, VelocityComesOutRight) {
  RobotTracker tracker({.search_range = 10, .jitter = 0.01, .start_speed = 40}, diameter, dt);
  Vec2 velocity;
  for (int k = 0; k < 60; ++k)
    velocity = tracker.step(k, std::vector<Vec2>{{3.0 * k, -1.0 * k}})[0].velocity;
  EXPECT_NEAR(velocity.x, 30, 0.3);
  EXPECT_NEAR(velocity.y, -10, 0.3);
}

TEST(RobotTracker, NothingBeyondTheSearchRangeIsTaken) {
  RobotTracker tracker({.gate = 100, .search_range = 4}, diameter, dt);
  tracker.step(0, std::vector<Vec2>{{0, 0}});
  EXPECT_EQ(tracker.step(1, std::vector<Vec2>{{4.1, 0}})[0].id, 1);
  RobotTracker other({.gate = 100, .search_range = 4}, diameter, dt);
  other.step(0, std::vector<Vec2>{{0, 0}});
  EXPECT_EQ(other.step(1, std::vector<Vec2>{{3.9, 0}})[0].id, 0);
}

TEST(RobotTracker, AGivenSearchRangeIsTheRange) {
  for (const double speed : {3.0, 8.0, 19.0, 95.0}) {  // [µm a frame], for robots of 10 µm
    RobotTracker given({.search_range = 1.05 * speed}, diameter, dt);
    for (int k = 0; k < 12; ++k)
      ASSERT_EQ(given.step(k, std::vector<Vec2>{{speed * k, 2}})[0].id, 0) << speed << " at " << k;
    RobotTracker without({}, diameter, dt);
    for (int k = 0; k < 12; ++k) without.step(k, std::vector<Vec2>{{speed * k, 2}});
    EXPECT_EQ(without.births(), speed > search_range({}, diameter) ? 12 : 1) << speed;
  }
  RobotTracker narrow({.gate = 0.5, .search_range = 20}, diameter, dt);
  narrow.step(0, std::vector<Vec2>{{0, 0}});
  EXPECT_EQ(narrow.step(1, std::vector<Vec2>{{19.9, 0}})[0].id, 0);  // whatever the gate
}

TEST(RobotTracker, FastRobotsInASwarmKeepTheirNames) {
  std::vector<Vec2> places;
  for (int i = 0; i < 30; ++i) places.push_back({45.0 * (i % 6), 45.0 * (i / 6)});
  RobotTracker tracker({.search_range = 22}, diameter, dt);
  for (int k = 0; k < 30; ++k) {
    const auto& at = tracker.step(k, places);
    for (std::size_t i = 0; i < at.size(); ++i) ASSERT_EQ(at[i].id, static_cast<int>(i)) << k;
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] += 18 * unit_vector(0.3 + 0.02 * static_cast<double>(i) + 0.03 * k);
  }
  EXPECT_EQ(tracker.births(), 30);
}

}  // namespace
}  // namespace microswarm::vision

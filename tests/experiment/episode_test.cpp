// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/episode.hpp"

#include <gtest/gtest.h>

#include "microswarm/experiment/run/metrics_listener.hpp"
#include "microswarm/navigation/make.hpp"
#include "tests/experiment/scenes.hpp"

namespace microswarm::experiment {
namespace {

std::unique_ptr<Navigator> navigator_of(const Scenario& scenario) {
  return navigation::make_navigator(scenario.navigator, navigation_task(scenario),
                                    Rng(scenario.seed, Purpose::planner, 0));
}

TEST(Episode, SteppedByHandIsTheRun) {
  const Scenario scenario = small_flight();
  const World world = world_of(scenario);
  Recorder stepped(load_scene(scenario, {}));
  KinematicPlant plant(scenario, world);
  const auto navigator = navigator_of(scenario);
  Episode episode(scenario, plant, *navigator);
  int ends = 0;
  while (const Tick* tick = episode.step()) {
    stepped.on_tick(*tick);
    ends += tick->end.has_value();
  }
  EXPECT_EQ(ends, 1);
  EXPECT_EQ(episode.step(), nullptr);
  EXPECT_EQ(stepped.record().hash(), record_of(scenario).hash());
}

TEST(Episode, ATickSaysWhatHappenedInIt) {
  Scenario scenario = open_room();
  scenario.obstacles = {disc(60, Still{.position = {500, 500}})};
  KinematicPlant plant(scenario, world_of(scenario));
  GoStraight navigator(*scenario.goal, 60);
  Episode episode(scenario, plant, navigator);
  double t = 0;
  std::vector<RunEvent> events;
  const Tick* tick = nullptr;
  for (tick = episode.step(); tick && !tick->end; tick = episode.step()) {
    EXPECT_NEAR(tick->frame.t, t, 1e-9);
    t += scenario.tick;
    EXPECT_EQ(tick->view.state, NavigatorState::follow);
    EXPECT_EQ(tick->world->time(), tick->frame.t);
    EXPECT_FALSE(tick->robots);
    ASSERT_FALSE(tick->trajectory.empty());
    EXPECT_EQ(tick->trajectory.front().pose.position, tick->frame.pose.position);
    events.assign(tick->events.begin(), tick->events.end());
  }
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->end, Status::collided);
  EXPECT_EQ(tick->frame.state, NavigatorState::end);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, EventKind::contact_obstacle);
  EXPECT_NEAR(tick->frame.t, events[0].t, 1e-12);
  // Centre to centre less the radii: 100 µm are left.
  EXPECT_NEAR(tick->frame.obstacle_clearance, 40, 0.1);
}

TEST(Episode, StopsWhenTold) {
  const Scenario scenario = open_room();
  KinematicPlant plant(scenario, world_of(scenario));
  GoStraight navigator(*scenario.goal, 60);
  Episode episode(scenario, plant, navigator);
  ASSERT_FALSE(episode.step()->end);
  std::atomic<bool> flag{true};
  EXPECT_EQ(episode.step(Stop(&flag))->end, Status::stopped);
  EXPECT_EQ(episode.step(), nullptr);
}

/// Is told to stop while it prepares.
class StoppedEarly final : public Navigator {
 public:
  explicit StoppedEarly(std::atomic<bool>& flag) : flag_(flag) {}
  void prepare(const Snapshot&, const Stop& stop) override {
    EXPECT_FALSE(stop());
    flag_ = true;
    EXPECT_TRUE(stop());
  }
  Command step(const Observation&, const Stop&) override {
    ADD_FAILURE() << "a step of what is not prepared";
    return {};
  }
  NavigatorView view() const override { return {}; }

 private:
  std::atomic<bool>& flag_;
};

TEST(Episode, NoStepFollowsAPreparationThatWasStopped) {
  const Scenario scenario = open_room();
  KinematicPlant plant(scenario, world_of(scenario));
  std::atomic<bool> flag{};
  StoppedEarly navigator(flag);
  Episode episode(scenario, plant, navigator);
  EXPECT_EQ(episode.step(Stop(&flag))->end, Status::stopped);
  EXPECT_EQ(episode.step(), nullptr);
}

}  // namespace
}  // namespace microswarm::experiment

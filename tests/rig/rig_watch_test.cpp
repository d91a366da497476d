// SPDX-License-Identifier: Apache-2.0
// The watch over a rig's pictures: in whole runs through simulated rigs, and part by part.
#include "microswarm/rig/watch/rig_watch.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <optional>
#include <vector>

#include "microswarm/navigation/make.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"
#include "tests/rig/watched_scenes.hpp"
#include "tests/runs.hpp"

namespace microswarm::rig {
namespace {

using test::watched_pairs;
using test::WatchedPair;

/// A run through a simulated rig as far as its first fault.
struct WatchedRun {
  std::string fault{};
  double faulted = 0;  // [s]
  double ended = 0;    // [s]
  std::string notes{};
  PictureState state{};
};

class Watcher : public experiment::RunListener {
 public:
  Watcher(SimulatedRig& plant, WatchedRun& told) : plant_(plant), told_(told) {}

  void on_tick(const experiment::Tick& tick) override {
    for (const std::string& note : plant_.take_notes()) told_.notes += note + "\n";
    told_.state = plant_.picture_state();
    told_.ended = tick.frame.t;
    if (!told_.fault.empty() || plant_.fault().empty()) return;
    told_.fault = plant_.fault();
    told_.faulted = tick.frame.t;
  }

 private:
  SimulatedRig& plant_;
  WatchedRun& told_;
};

WatchedRun watched(const WatchedPair& pair, double seconds,
                   const std::vector<std::string>& rig_settings = {},
                   std::vector<std::string> settings = {}) {
  settings.push_back("time_limit_s=" + std::to_string(seconds));
  const RigExperiment on = test::opened(pair, rig_settings, settings);
  const experiment::Scenario& s = on.scenario();
  SimulatedRig plant(s, on.experiment.world, on.rig);
  WatchedRun told;
  Watcher watcher(plant, told);
  experiment::RunListener* const listeners[] = {&watcher};
  const auto navigator = navigation::make_navigator(s.navigator, experiment::navigation_task(s),
                                                    Rng(s.seed, Purpose::planner, 0));
  test::run(s, plant, *navigator, listeners);
  std::printf("%-10s %4.1f s, fault at %4.1f s: %s\n", pair.name.c_str(), told.ended, told.faulted,
              told.fault.c_str());
  std::printf("  light %.2f to %.2f, focus %.2f, shift %.2f px, unseen %.2f, follows %.2f\n%s",
              told.state.lowest_light, told.state.highest_light, told.state.lowest_focus,
              told.state.largest_shift_px, told.state.highest_unseen_share,
              told.state.follow_share.value_or(-1), told.notes.c_str());
  return told;
}

class WatchedRuns : public testing::TestWithParam<WatchedPair> {
 protected:
  bool is_slow() const { return GetParam().name == "vascular"; }
};

TEST_P(WatchedRuns, NoAlarmWithoutAFault) {
  const WatchedRun plain = watched(GetParam(), 25);
  EXPECT_EQ(plain.fault, "");
  EXPECT_EQ(plain.notes, "");
}

TEST_P(WatchedRuns, NoFaultWithUsualErrors) {
  const RigExperiment on = test::opened(GetParam());
  const double delay = on.scenario().sensing.observation_delay + 0.1;
  const std::string later = "sensing.observation_delay_s=" + std::to_string(delay);
  EXPECT_EQ(watched(GetParam(), 15,
                    {"camera.speed_error=0.05", "camera.microscope.light_drift=0.12",
                     "camera.microscope.light_period_s=6"},
                    {later})
                .fault,
            "");
  EXPECT_EQ(
      watched(GetParam(), 15, {"camera.speed_error=-0.05", "camera.microscope.noise=5"}).fault, "");
}

TEST_P(WatchedRuns, ABumpOfTheCameraEndsIt) {
  const WatchedRun bumped = watched(
      GetParam(), 8, {"camera.microscope.shift_px=[8, 0]", "camera.microscope.moved_after_s=2.05"});
  EXPECT_NE(bumped.fault.find("from their place in the picture"), std::string::npos)
      << bumped.fault;
  EXPECT_GT(bumped.faulted, 2);
  EXPECT_LE(bumped.faulted, 2.1 + 1 + 2 * test::opened(GetParam()).scenario().tick + 0.01);
}

TEST_P(WatchedRuns, AFrozenPictureWithNoiseEndsItWithinASecond) {
  const double frozen = 3;
  for (const char* noise : {"noise=1", "noise=3"}) {
    const WatchedRun run =
        watched(GetParam(), 8,
                {"camera.microscope.frozen_after_s=3", std::string("camera.microscope.") + noise});
    // A swarm of few pixels is lost by its way before.
    EXPECT_TRUE(run.fault.find("nothing but noise") != std::string::npos ||
                run.fault.starts_with("the swarm does not follow"))
        << run.fault;
    EXPECT_GT(run.faulted, frozen);
    EXPECT_LE(run.faulted, frozen + 1 + 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, WatchedRuns,
                         testing::ValuesIn(watched_pairs().begin(), watched_pairs().end() - 1),
                         [](const auto& pair) { return pair.param.name; });

TEST(RigWatch, HalfTheCommandedWayAndMuchMoreAreTold) {
  for (const std::size_t pair : {0u, 1u})
    for (const double error : {-0.5, 0.0, 0.9}) {
      const WatchedRun run =
          watched(watched_pairs()[pair], 10, {"camera.speed_error=" + std::to_string(error)});
      EXPECT_EQ(run.notes.find("of the commanded distance") != std::string::npos, error != 0)
          << error << run.notes;
    }
}

TEST(RigWatch, FlickeringLightIsTold) {
  for (const std::size_t pair : {0u, 1u}) {
    const WatchedRun run =
        watched(watched_pairs()[pair], 4,
                {"camera.microscope.light_drift=0.35", "camera.microscope.light_period_s=0.33"});
    EXPECT_NE(run.notes.find("the light varies between"), std::string::npos) << run.notes;
  }
}

TEST(RigWatch, LightBeyondTheLimitIsAFault) {
  RelativeValue light("the light", {0.8, 1.2, 0.5, 2}, 0.5);
  for (const double t : {0.0, 0.5, 1.0}) light.take(100, t);
  EXPECT_EQ(light.take_note(), "");
  light.take(45, 1.1);
  light.take(60, 1.4);
  light.take(45, 1.5);
  light.take(45, 1.9);
  EXPECT_EQ(light.fault(), "");
  light.take(45, 2.0);
  EXPECT_EQ(light.fault(), "the light is 45 % of that at the start, allowed 50 % or more");
  EXPECT_EQ(light.take_note(), "the light has fallen to 45 % of that at the start");
  EXPECT_EQ(light.take_note(), "");
  RelativeValue bright("the light", {0.8, 1.2, 0.5, 2}, 0);
  bright.take(60, 0);
  bright.take(130, 1);
  EXPECT_EQ(bright.fault(), "the light is 217 % of that at the start, allowed 200 % or less");
}

TEST(RigWatch, ASwarmThatIsOftenUnseenIsToldAndAFault) {
  UnseenShare some(0.5);
  for (int k = 0; k < 100; ++k) some.take(k % 5 != 0, 0.1 * k);
  EXPECT_EQ(some.fault(), "");
  EXPECT_NE(some.take_note(), "");
  EXPECT_EQ(some.take_note(), "");
  EXPECT_NEAR(some.highest(), 0.2, 0.05);
  UnseenShare most(0.5);
  for (int k = 0; k < 100; ++k) most.take(k % 5 < 2, 0.1 * k);
  EXPECT_NE(most.fault().find("allowed 50 %"), std::string::npos);
  SafetyParams patient{.lost_swarm = 20};
  RigWatch watch(patient, 0);
  const formats::Image grey{16, 16, 1, std::vector<std::uint8_t>(256, 100)};
  for (int k = 0; k < 150; ++k) watch.take(grey, {}, {{}, 16, 16}, 0.1 * k);
  EXPECT_EQ(watch.fault(), "") << "longer than the longest time without the swarm";
  UnseenShare any(0);
  for (int k = 0; k < 100; ++k) any.take(false, 0.1 * k);
  EXPECT_EQ(any.fault(), "");
}

PictureFit fit_of(double shift_px) { return {.shift_px = shift_px, .seen_share = 1}; }

TEST(RigWatch, LightAndSharpnessEndARun) {
  const auto grey = [](int level) {
    return formats::Image{16, 16, 1,
                          std::vector<std::uint8_t>(256, static_cast<std::uint8_t>(level))};
  };
  const CameraView view{{}, 16, 16};
  const Detections seen{.swarm = SwarmPose{}};
  const auto fault = [&](int level, double contrast) {
    RigWatch watch(SafetyParams{}, 0);
    for (int k = 0; k < 50; ++k) {
      watch.take(grey(k < 10 ? 100 : level), seen, view, 0.1 * k);
      if (k % 10 != 0) continue;
      PictureFit fit = fit_of(0);
      fit.contrast = k < 10 ? 30 : contrast;
      watch.take({fit, 0}, 0.1 * k);
    }
    return watch.fault();
  };
  EXPECT_EQ(fault(100, 30), "");
  EXPECT_EQ(fault(60, 0.6 * 30), "") << "contrast relative to the light";
  EXPECT_NE(fault(40, 0.4 * 30).find("the light is 40 %"), std::string::npos);
  EXPECT_NE(fault(100, 10).find("the sharpness of the walls is 33 %"), std::string::npos);
}

TEST(RigWatch, TheLowestSharpnessIsOfWhatWasWatched) {
  RigWatch watch(SafetyParams{}, 0);
  const auto look = [&](bool by_walls, double contrast, double detail, double t) {
    PictureFit fit = fit_of(0);
    fit.by_walls = by_walls;
    fit.contrast = contrast;
    watch.take({fit, detail}, t);
  };
  look(true, 30, 10, 0);
  look(true, 24, 5, 1);  // what moves hides details; the walls are watched
  EXPECT_NEAR(watch.state().lowest_focus, 0.8, 1e-9);
  look(false, 30, 9, 2);
  EXPECT_NEAR(*watch.state().focus, 0.9, 1e-9);
  EXPECT_NEAR(watch.state().lowest_focus, 0.8, 1e-9);
}

/// Time at which pictures that show nothing new at the swarm are a fault [s]; `rests` so long
/// before `commanded` px a picture, then as `back` says. Pictures come ten times a second.
std::optional<double> frozen_at(double delay, double rests, Vec2 commanded, bool back) {
  FrozenSwarm frozen(0.8, delay);
  const formats::Image grey{64, 64, 1, std::vector<std::uint8_t>(64 * 64, 100)};
  const std::vector<vision::Ring> swarm{{{32, 32}, 10}};
  for (int k = 0; k < 100; ++k) {
    const double t = 0.1 * k;
    const Vec2 way = back && k % 2 == 1 ? -1.0 * commanded : commanded;
    frozen.take(grey, swarm, t > rests ? way : Vec2{}, t);
    if (!frozen.fault().empty()) return t;
  }
  return std::nullopt;
}

TEST(RigWatch, ASwarmThatAnswersLateIsNotFrozen) {
  EXPECT_NEAR(frozen_at(0, 0, {2, 0}, false).value_or(0), 0.8, 0.11);
  EXPECT_NEAR(frozen_at(0.7, 0, {2, 0}, false).value_or(0), 1.5, 0.11);
  // A swarm that rested has all of this time from its first command on.
  EXPECT_NEAR(frozen_at(0, 3, {2, 0}, false).value_or(0), 3.8, 0.11);
  EXPECT_NEAR(frozen_at(0.7, 3, {2, 0}, false).value_or(0), 4.5, 0.11);
}

TEST(RigWatch, ASwarmThatIsHeldToAndFroIsNotFrozen) {
  EXPECT_EQ(frozen_at(0, 0, {2, 0}, true), std::nullopt);
}

TEST(RigWatch, TwoLooksBeyondTheLimitAreAFault) {
  MapWatch watch(5);
  for (const double shift : {0.1, 6.0, 0.2, 6.0}) watch.take(fit_of(shift));
  EXPECT_EQ(watch.fault(), "");
  EXPECT_TRUE(watch.is_in_doubt());
  watch.take(fit_of(6));
  EXPECT_NE(watch.fault().find("allowed 5 px"), std::string::npos);
  MapWatch without(0);
  for (int k = 0; k < 5; ++k) without.take(fit_of(60));
  EXPECT_EQ(without.fault(), "");
}

TEST(RigWatch, WallsThatWereClearAndAreGoneAreAFault) {
  MapWatch watch(5);
  watch.take(fit_of(0));
  for (int k = 0; k < 2; ++k) watch.take({.unsure = "why"});
  EXPECT_EQ(watch.fault(), "");
  watch.take({.unsure = "why"});
  EXPECT_NE(watch.fault().find("no longer found in the picture: why"), std::string::npos);
  MapWatch never(5);
  for (int k = 0; k < 5; ++k) never.take({.unsure = "why"});
  EXPECT_EQ(never.fault(), "");
}

TEST(RigWatch, ALostMapIsNotedAlsoAfterADisplacedOne) {
  MapWatch watch(5);
  PictureFit weak = fit_of(4);
  weak.seen_share = 0.5;  // too few edges for a fault where they are lost
  watch.take(weak);
  for (int k = 0; k < 3; ++k) watch.take({.unsure = "why"});
  EXPECT_EQ(watch.fault(), "");
  EXPECT_NE(watch.take_note().find("px"), std::string::npos);
  EXPECT_NE(watch.take_note().find("no longer known"), std::string::npos);
  EXPECT_EQ(watch.take_note(), "");
}

TEST(RigWatch, DefocusIsTold) {
  for (const std::size_t pair : {1u, 5u}) {  // with walls
    double sharp = 0;
    for (const char* blur : {"1", "2", "4"}) {
      const RigExperiment on =
          test::opened(watched_pairs()[pair], {std::string("camera.microscope.blur_px=") + blur});
      RigSimulator simulator(on.scenario(), on.experiment.world, on.rig);
      const PictureRegistration registration(*on.experiment.world.map, simulator.camera());
      const formats::Image& picture = simulator.render(simulator.capture());
      const double contrast = registration.fit(picture, false).contrast;
      std::printf("blur %s: contrast %.3f, details %.4f\n", blur, contrast, detail_of(picture));
      if (sharp == 0) sharp = contrast;
      const double allowed = blur[0] == '2' ? 0.75 : blur[0] == '4' ? 0.45 : 1.01;
      EXPECT_LT(contrast, allowed * sharp);
    }
  }
}

}  // namespace
}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
// An identification of each kind of rig whose file is not true, and a second one with the values
// that it led to.
#include "microswarm/rig/identify/identify_programme.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/rig/identify/recorded_response.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"
#include "tests/files.hpp"

namespace microswarm::rig {
namespace {

const std::filesystem::path scenario_files =
    std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";

struct Kind {
  const char* rig;
  const char* swarm;
  std::vector<std::string> settings;  // of the rig
  double step_out;                    // in truth [Hz]
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.rig; }

class Identification : public testing::TestWithParam<Kind> {
 protected:
  RigExperiment open(std::vector<std::string> rig_settings) const {
    rig_settings.insert(rig_settings.end(), GetParam().settings.begin(), GetParam().settings.end());
    const auto scenario = folder_.with(
        "dish.yaml", std::string("map: {type: polygons, lo_um: [0, 0], hi_um: [1600, 1600]}\n"
                                 "goal_tolerance_um: 20\n") +
                         GetParam().swarm);
    return open_rig_experiment(scenario, {}, scenario_files / "rigs" / GetParam().rig,
                               {rig_settings, ""});
  }
  static double speed_of(const experiment::Scenario& s) {
    return s.robots ? s.robots->max_speed : swarm_limits(s.swarm).max_speed;
  }
  struct Driven {
    ResponseData data;
    double reached = 0;  // [µm] from the start
    double least_gap = 1e9;
    double seconds = 0;
    std::string fault{};  ///< of the rig
  };
  /// Drives the programme as fast as possible.
  static Driven drive(const RigExperiment& on) {
    const double most = largest_frequency(on.rig);
    const RigExperiment ready = for_identification(on, most);
    SimulatedRig plant(ready.scenario(), ready.experiment.world, ready.rig);
    plant.set_field_frequency(on.rig.params.field.frequency);
    Driven out{.data = {.field = on.rig.params.field, .commands = {}, .seen = {}}};
    const double tick = on.scenario().tick;
    std::optional<IdentifyProgramme> programme;
    for (double t = 0; t < 300; t += tick) {
      const Observation seen = plant.observe();
      const auto& swarm = plant.detections().swarm;
      std::optional<Vec2> place;
      if (swarm) {
        place = swarm->pose.position;
        out.data.seen.push_back({seen.seen, *place});
        out.least_gap =
            std::min(out.least_gap, on.experiment.world.map->clearance(*place) - swarm->radius);
        out.reached = std::max(out.reached, distance(*place, Vec2{800, 800}));
      }
      if (!programme)
        programme.emplace(plan_identification(on.rig, {.free = 600,
                                                       .radius = swarm ? swarm->radius : 100,
                                                       .speed = speed_of(on.scenario()),
                                                       .max_frequency = most}));
      const auto step = programme->next(t, place);
      out.seconds = t;
      if (!plant.fault().empty()) out.fault = plant.fault();
      if (!step || !out.fault.empty()) break;
      plant.set_field_frequency(step->frequency);
      out.data.commands.push_back({t, step->command, step->frequency});
      plant.apply(step->command, tick);
    }
    return out;
  }

  test::Folder folder_;
};

TEST_P(Identification, FindsAnUntrueRigAndItsValuesMakeItTrue) {
  const std::string step_out =
      "camera.step_out_frequency_hz=" + std::to_string(GetParam().step_out);
  const RigExperiment untrue = open({"camera.speed_error=-0.4", "camera.direction_error_deg=15",
                                     "camera.delay_error_s=0.12", step_out});
  const Driven driven = drive(untrue);
  // A swarm that does not follow ends the sweep.
  EXPECT_TRUE(driven.fault.empty() || driven.fault.starts_with("the swarm does not follow"))
      << driven.fault;
  EXPECT_LT(driven.seconds, 90);
  EXPECT_GT(driven.least_gap, 0);
  const auto fit = fit_response(driven.data);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(doubts(*fit).empty()) << doubts(*fit).front();
  EXPECT_NEAR(degrees(fit->angle.value), 15, std::max(2.0, 3 * degrees(fit->angle.error)));
  EXPECT_NEAR(fit->gain.value, 0.6, std::max(0.03, 3 * fit->gain.error));
  EXPECT_GT(fit->delay.value, 0.12);  // beside the swarm's own and the field's turn
  EXPECT_LT(fit->delay.value, 0.45);
  const StepOut sweep = fit_step_out(driven.data, *fit);
  ASSERT_TRUE(sweep.followed && sweep.lost) << step_out_text(sweep);
  EXPECT_LT(*sweep.followed, 1.07 * GetParam().step_out);
  EXPECT_GT(*sweep.lost, GetParam().step_out);

  // The same truth, which the file knows now.
  std::vector<std::string> settings{step_out};
  for (const MeasuredValue& value :
       measured_values(untrue.rig.params, untrue.rig.params, *fit, sweep))
    if (value.what != Quantity::step_out) settings.push_back(to_string(value.setting()));
  const auto again = fit_response(drive(open(settings)).data);
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->gain.value, 1, 0.03);
  EXPECT_NEAR(degrees(again->angle.value), 0, 2);
}

INSTANTIATE_TEST_SUITE_P(
    Rigs, Identification,
    testing::Values(
        Kind{
            "vortex.yaml",
            "navigator: {type: radar}\ngoal_um: [1200, 800]\nstart: {x_um: 800, y_um: 800}\nswarm: "
            "{type: vortex, radius_um: 100, moving_radius_um: 100, max_speed_um_per_s: 40}\n",
            {"camera.microscope.um_per_px=4"},
            17.5},
        Kind{"ribbon.yaml",
             "navigator: {type: radar}\ngoal_um: [1200, 800]\nstart: {x_um: 800, y_um: "
             "800}\nswarm: {type: ribbon, radius_um: 60, max_speed_um_per_s: 40}\n",
             {"camera.microscope.um_per_px=4"},
             17.5},
        Kind{"rollers.yaml",
             "navigator: {type: plan_player}\nrobots: {starts_um: [[780, 800], [820, 800], [800, "
             "840]], goals_um: [[880, 800], [920, 800], [900, 840]], max_speed_um_per_s: 40}\n",
             {"camera.microscope.um_per_px=2"},
             6}),
    [](const auto& of) {
      const std::string name = of.param.rig;
      return name.substr(0, name.find('.'));
    });

TEST(IdentifyPlan, WithoutRoomItIsRefusedWithWhatIsNeeded) {
  const Rig rig = read_rig(scenario_files / "rigs/vortex.yaml");
  const IdentifyPlan wide = plan_identification(rig, {.free = 1000, .radius = 100, .speed = 40});
  const IdentifyPlan narrow = plan_identification(rig, {.free = 300, .radius = 100, .speed = 40});
  EXPECT_GT(wide.side(), narrow.side());
  EXPECT_LE(narrow.room, 300);
  try {
    plan_identification(rig, {.free = 200, .radius = 100, .speed = 40});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("needs 234 µm"), std::string::npos) << e.what();
  }
  EXPECT_THROW(
      plan_identification(rig, {.free = 1000, .radius = 100, .speed = 40, .max_frequency = 50}),
      InputError);
}

TEST(IdentifyProgramme, KeepsAFastSwarmWithinItsReach) {
  const Rig rig = read_rig(scenario_files / "rigs/vortex.yaml");
  IdentifyProgramme programme(
      plan_identification(rig, {.free = 600, .radius = 100, .speed = 40, .max_frequency = 20}));
  Vec2 at{};
  double far = 0, t = 0;
  for (; t < 300; t += 0.1) {
    const auto step = programme.next(t, at);
    if (!step) break;
    const double angle = step->command.heading + 0.4;
    at += 0.1 * 2.5 * step->command.speed * Vec2{std::cos(angle), std::sin(angle)};
    far = std::max(far, norm(at));
  }
  EXPECT_LT(t, 120);
  EXPECT_LT(far, programme.plan().reach + 2 * 0.1 * 2.5 * 40);
}

TEST(IdentifyProgramme, HoldsWithoutASwarm) {
  const Rig rig = read_rig(scenario_files / "rigs/vortex.yaml");
  IdentifyProgramme programme(
      plan_identification(rig, {.free = 600, .radius = 100, .speed = 40, .max_frequency = 20}));
  EXPECT_EQ(programme.next(0, std::nullopt)->command.speed, 0);
  EXPECT_GT(programme.next(0.1, Vec2{})->command.speed, 0);
  EXPECT_EQ(programme.next(0.2, std::nullopt)->command.speed, 0);
}

}  // namespace
}  // namespace microswarm::rig

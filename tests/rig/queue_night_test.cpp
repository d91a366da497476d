// SPDX-License-Identifier: Apache-2.0
// A night of eight hours with simulated runs: three faults, a power cut and a full disk.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/session/growing_record.hpp"
#include "microswarm/rig/queue/run_queue.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::rig {
namespace {

namespace fs = std::filesystem;

constexpr double limit = 90;  // of a coil [°C]

/// What goes wrong in a run.
enum class Mishap { none, lost_swarm, hung_driver, power_cut };

/// Simulated coils that know whether they carry a current.
class Coils : public actuation::CoilDriver {
 public:
  explicit Coils(const Rig& rig) : coils_(simulated_coils(rig)) {}
  actuation::Capabilities capabilities() const override { return coils_->capabilities(); }
  const actuation::DeviceReport& report() const override { return coils_->report(); }
  actuation::DriveStatus drive(const actuation::CoilRequest& request) override {
    at_zero = false;
    return coils_->drive(request);
  }
  actuation::StopReport stop() noexcept override {
    at_zero = true;
    return coils_->stop();
  }
  bool at_zero = true;

 private:
  std::unique_ptr<actuation::CoilDriver> coils_;
};

/// A simulated rig that fails: by a mishap, or when its coils are too hot for the field.
class FailingRig : public Plant {
 public:
  FailingRig(const RigExperiment& on, Coils& coils, const Eigen::VectorXd& temperatures,
             Mishap mishap)
      : coils_(coils),
        rig_(on.scenario(), on.experiment.world, on.rig, 0, &coils),
        mishap_(mishap) {
    rig_.warm(temperatures);
  }
  Observation observe() override {
    const Observation seen = rig_.observe();
    if (seen.now > 3 && mishap_ == Mishap::lost_swarm)
      fail("the swarm was not found for 0.52 s, allowed 0.5 s", FaultKind::swarm);
    if (seen.now > 3 && mishap_ == Mishap::hung_driver)
      fail("the coil driver does not answer", FaultKind::device);
    if (seen.now > 0 && rig_.coils().scale < 0.6)
      fail("the swarm does not follow: its coils are hot", FaultKind::swarm);
    return seen;
  }
  void apply(const Command& command, double dt) override {
    rig_.apply(command, dt);
    hottest = std::max(hottest, rig_.coils().temperatures.maxCoeff());
  }
  std::string_view fault() const override { return why_; }
  FaultKind kind() const { return kind_; }
  const Eigen::VectorXd& temperatures() const { return rig_.coils().temperatures; }
  double hottest = 0;  // [°C]

 private:
  void fail(const std::string& why, FaultKind kind) {
    coils_.stop();
    if (why_.empty()) why_ = why, kind_ = kind;
  }
  Coils& coils_;
  SimulatedRig rig_;
  Mishap mishap_;
  std::string why_;
  FaultKind kind_ = FaultKind::none;
};

/// The laboratory during a night: its clock and the heat of its coils outlive the program.
class Laboratory {
 public:
  Laboratory(const test::Folder& folder) : folder_(folder), rig(read_rig(folder / "rig.yaml")) {
    temperatures = actuation::ambient(rig.system.amplifiers());
    if (!fs::exists(folder / "clock")) return;
    std::istringstream kept(read_file(folder / "clock"));
    kept >> time;
    for (double& one : temperatures) kept >> one;
  }
  void pass(double seconds) {
    time += seconds;
    temperatures = actuation::cooled(rig.system.amplifiers(), temperatures, seconds);
  }
  void keep() const {
    std::string text = number_text(time);
    for (const double one : temperatures) text += " " + number_text(one);
    std::ofstream(folder_ / "clock") << text;
  }

  AttemptResult run(const QueueItem& item, const fs::path& at, Mishap mishap) {
    const RigExperiment on = open_item(item, folder_ / "rig.yaml", {});
    fs::create_directories(at);
    Coils coils(rig);
    const auto plant = std::make_shared<FailingRig>(on, coils, temperatures, mishap);
    experiment::Session session(on.experiment, {.plant = plant, .rig = "simulated"});
    const experiment::GrowingRecord growing(
        session, at / "run.h5", std::chrono::milliseconds(mishap == Mishap::power_cut ? 1 : 1000));
    double t = 0;
    while (const experiment::Tick* tick = session.step()) {
      t = tick->frame.t;
      if (t > item.time_budget) break;
      if (mishap != Mishap::power_cut) continue;
      // A run in real time leaves its record time to be written.
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (t > 3 && fs::exists(at / "run.part.h5")) ::raise(SIGKILL);
    }
    coils.stop();
    temperatures = plant->temperatures();
    time += t;
    keep();
    session.record_to(at / "run.h5");
    hottest = std::max(hottest, plant->hottest);
    AttemptResult result{.max_temperature = plant->hottest};
    result.status = to_string(session.result().status);
    if (plant->fault().empty()) return result;
    EXPECT_TRUE(coils.at_zero) << plant->fault();
    result.end = AttemptEnd::fault;
    result.fault = plant->kind();
    result.reason = plant->fault();
    return result;
  }

 private:
  const test::Folder& folder_;

 public:
  Rig rig;
  double time = 1.8e9;
  Eigen::VectorXd temperatures;
  double hottest = 0;
};

class QueueNight : public testing::Test {
 protected:
  QueueNight() {
    // A run heats the coils by some 20 K, and they need some 25 min to cool.
    folder.with("coils.yaml",
                "coils: {type: helmholtz}\n"
                "drives:\n  - {resistance_ohm: 0.9, inductance_mh: 2.5, "
                "thermal_resistance_k_per_w: 200, thermal_time_s: 4000, ambient_degc: 22, "
                "max_current_a: 10, max_voltage_v: 24, max_temperature_degc: 90}\n");
    folder.with("rig.yaml",
                "coils: coils.yaml\n"
                "field: {kind: rotating, amplitude_mt: 8, frequency_hz: 10, max_pitch_deg: 7.5}\n"
                "drive_rate_hz: 100\ncamera: {type: simulated, microscope: {um_per_px: 8}}\n");
    folder.with("short.yaml",
                "map: {type: polygons, lo_um: [0, 0], hi_um: [2000, 1000]}\n"
                "start: {x_um: 400, y_um: 500}\ngoal_um: [1100, 500]\ntime_limit_s: 60\n"
                "swarm: {type: vortex}\nnavigator: {type: radar}\n");
    folder.with("night.yaml",
                "hours: 24\ntime_budget_s: 60\nstart_below_degc: 30\non_fault: retry\nentries:\n"
                "  - {scenario: short.yaml, name: first, repeat: 8}\n"
                "  - {scenario: short.yaml, name: hot, on_fault: skip, "
                "set: [hold_at_goal_s=200], time_budget_s: 200}\n"
                "  - {scenario: short.yaml, name: last, repeat: 12}\n");
    fs::create_directories(folder / "out");
  }
  /// Runs the night until it ends, with what goes wrong in attempts of it.
  QueueEnd go_on(const std::map<std::string, Mishap>& mishaps, const std::string& full_after = "") {
    Laboratory laboratory(folder);
    const Queue queue = open_queue(folder / "night.yaml", folder / "rig.yaml", {});
    bool is_full = false;
    const QueueHost host{
        .run =
            [&](const QueueItem& item, const fs::path& at) {
              const auto mishap = mishaps.find(at.filename().string());
              is_full = at.filename() == full_after;
              for (Eigen::Index k = 0; k < laboratory.temperatures.size(); ++k)
                EXPECT_LE(laboratory.temperatures[k], 30 + 1e-6) << at;
              laboratory.keep();
              return laboratory.run(item, at,
                                    mishap == mishaps.end() ? Mishap::none : mishap->second);
            },
        .temperatures = [&] { return std::optional(laboratory.temperatures); },
        .wall = [&] { return laboratory.time; },
        .clock = [&] { return laboratory.time; },
        .wait = [&](double seconds) { laboratory.pass(seconds); },
        .stops = [] { return false; },
        .halts = [] { return std::string(); },
        .free_space = [&](const fs::path&) { return std::optional(is_full ? 1e5 : 1e12); },
        .tell = [&](const std::string& line) { told.push_back(line); },
        .doing = [](const std::string&) {},
        .alarm = [&](const std::string& why, const fs::path&) { alarms.push_back(why); }};
    const QueueEnd end = run_queue(queue, laboratory.rig, "rig.yaml", folder / "out", host);
    EXPECT_LE(laboratory.hottest, limit + 0.1);
    laboratory.keep();
    return end;
  }
  void let_pass(double seconds) const {
    Laboratory laboratory(folder);
    laboratory.pass(seconds);
    laboratory.keep();
  }
  QueueState state() const { return read_queue_state(folder / "out").value(); }

  test::Folder folder;
  std::vector<std::string> told, alarms;
};

TEST_F(QueueNight, GoesOnAfterThreeFaultsAPowerCutAndAFullDisk) {
  const std::map<std::string, Mishap> mishaps{{"003-first-3", Mishap::lost_swarm},
                                              {"006-first-6", Mishap::power_cut},
                                              {"012-last-3", Mishap::hung_driver}};
  const pid_t program = ::fork();
  if (program == 0) {
    go_on(mishaps);
    ::_exit(1);
  }
  int status = 0;
  ::waitpid(program, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  let_pass(600);  // without power
  EXPECT_EQ(state().items[5].state, ItemState::running);

  EXPECT_EQ(go_on(mishaps), QueueEnd::needs_person);
  EXPECT_TRUE(test::names(alarms.back(), "does not answer; the queue has stopped"))
      << alarms.back();
  let_pass(2400);  // until somebody came
  EXPECT_EQ(go_on(mishaps, "014-last-5"), QueueEnd::needs_person);
  EXPECT_TRUE(test::names(alarms.back(), "0 MB are free")) << alarms.back();
  EXPECT_EQ(go_on(mishaps), QueueEnd::incomplete);  // the hot one has failed

  const QueueState end = state();
  ASSERT_EQ(end.items.size(), 21u);
  EXPECT_GT(Laboratory(folder).time - end.began, 8 * 3600);
  std::set<std::string> folders;
  for (const ItemStatus& item : end.items) {
    EXPECT_EQ(item.state, item.name == "hot" ? ItemState::failed : ItemState::done) << item.number;
    int done = 0;
    for (const QueueAttempt& attempt : item.attempts) {
      EXPECT_TRUE(folders.insert(attempt.folder).second) << attempt.folder;
      done += attempt.end == AttemptEnd::done;
      EXPECT_TRUE(attempt.end == AttemptEnd::done || !attempt.reason.empty()) << attempt.folder;
      const char* const file = attempt.end == AttemptEnd::interrupted ? "run.part.h5" : "run.h5";
      const auto record = experiment::read_record(folder / "out" / attempt.folder / file);
      EXPECT_FALSE(record.frames.empty()) << attempt.folder;
      if (attempt.max_temperature) {
        EXPECT_LE(*attempt.max_temperature, limit + 0.1);
      }
    }
    EXPECT_EQ(done, item.name == "hot" ? 0 : 1) << item.number;
  }
  const auto ends = [&](int number) {
    std::vector<AttemptEnd> all;
    for (const QueueAttempt& attempt : end.items[static_cast<std::size_t>(number - 1)].attempts)
      all.push_back(attempt.end);
    return all;
  };
  using Ends = std::vector<AttemptEnd>;
  EXPECT_EQ(ends(1), (Ends{AttemptEnd::done}));
  EXPECT_EQ(ends(3), (Ends{AttemptEnd::fault, AttemptEnd::done}));
  EXPECT_EQ(ends(6), (Ends{AttemptEnd::interrupted, AttemptEnd::done}));
  EXPECT_EQ(ends(9), (Ends{AttemptEnd::fault}));
  EXPECT_EQ(ends(12), (Ends{AttemptEnd::fault, AttemptEnd::done}));
  EXPECT_TRUE(test::names(end.items[8].note, "its coils are hot")) << end.items[8].note;
  EXPECT_GT(*end.items[8].attempts[0].max_temperature, 85);
  const std::string csv = read_file(folder / "out/summary.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 25) << csv;  // a header and 24 attempts
}

}  // namespace
}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
// Measurements of fields without a terminal: each drives the coils in real time.
#include "microswarm/rig/runtime/measurement_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/drivers/coil_driver.hpp"
#include "microswarm/core/errors/error.hpp"
#include "tests/rig/coil_rig.hpp"

namespace microswarm::rig {
namespace {

using enum MeasurementOutcome;

/// Coils whose device reports what a test says of the requested currents.
class ReportingDriver : public actuation::CoilDriver {
 public:
  using Report = std::function<double(double current)>;
  explicit ReportingDriver(Report report = [](double current) { return current; })
      : reports_(std::move(report)) {}
  actuation::Capabilities capabilities() const override { return {.channels = 6}; }
  const actuation::DeviceReport& report() const override { return report_; }
  actuation::DriveStatus drive(const actuation::CoilRequest& request) override {
    sent = std::get<std::span<const double>>(request)[0];
    most = std::max(most, std::abs(sent));
    std::ranges::transform(std::get<std::span<const double>>(request), report_.currents.begin(),
                           reports_);
    return actuation::DriveStatus::driven;
  }
  actuation::StopReport stop() noexcept override {
    sent = 0;
    return {.confirmed = confirms};
  }

  double sent = 0, most = 0;  ///< in the first coil [A]
  bool confirms = true;

 private:
  Report reports_;
  actuation::DeviceReport report_{.currents = std::vector<double>(6)};
};

/// Answers what a test says, once the currents have settled.
class Reader : public FieldReader {
 public:
  using Poll = std::function<std::optional<FieldAnswer>(double t)>;
  explicit Reader(Poll poll) : poll_(std::move(poll)) {}
  void begin(const SettledCurrents& settled) override {
    began = settled.currents;
    limited = settled.limited;
    expected = settled.expected;
  }
  std::optional<FieldAnswer> poll(double t) override { return poll_(t); }
  void watch() override { ++watched; }

  Eigen::VectorXd began;
  std::vector<Eigen::Index> limited;
  std::optional<Eigen::Vector3d> expected;
  int watched = 0;

 private:
  Poll poll_;
};

const std::vector<Eigen::Vector3d> readings{{1, 2, 3}, {3, 2, 1}};

class MeasurementRuns : public testing::Test {
 protected:
  MeasurementRuns() { step.currents[0] = 2; }
  Measurement measure(ReportingDriver& driver, Reader& reader, const Stop& stop = {}) {
    const Measurement made = measure_field(
        rig, driver, step, timing, reader,
        actuation::Amplifiers(rig.system.amplifiers()).temperatures(),
        [this](const actuation::CoilOutput&) { ++heard; }, stop);
    EXPECT_EQ(driver.sent, 0) << "the coils are at zero afterwards";
    return made;
  }
  Measurement answered(ReportingDriver& driver, MeasurementOutcome outcome) {
    Reader reader([outcome](double) { return FieldAnswer{outcome, readings}; });
    return measure(driver, reader);
  }

  test::Folder folder;
  Rig rig = test::coil_rig(folder, "[{}, {}, {}]");
  MeasurementTiming timing{.ramp = 0.05, .settle = 0.05, .hold = 0.3};
  actuation::MeasurementStep step{
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rig.system.size())), Eigen::Vector3d::Zero()};
  int heard = 0;
};

TEST_F(MeasurementRuns, ReadsTheFieldOfSettledCurrents) {
  ReportingDriver driver;
  Reader reader([](double t) {
    return t < 0.1 ? std::nullopt : std::optional(FieldAnswer{measured, readings});
  });
  const Measurement made = measure(driver, reader);
  EXPECT_EQ(made.outcome, measured);
  EXPECT_EQ(made.why, "");
  EXPECT_TRUE(reader.began.isApprox(step.currents));
  EXPECT_TRUE(made.currents.isApprox(step.currents));
  EXPECT_TRUE(reader.limited.empty());
  ASSERT_TRUE(made.reading);
  EXPECT_EQ(made.reading->mean, Eigen::Vector3d(2, 2, 2));
  EXPECT_EQ(made.reading->count, 2);
  ASSERT_TRUE(made.expected);
  EXPECT_TRUE(made.expected->isApprox(rig.system.at(step.position).total_field(step.currents)));
  EXPECT_DOUBLE_EQ(driver.most, 2);
  EXPECT_GT(reader.watched, 10) << "before the currents settle and while they ramp down";
  EXPECT_GT(heard, reader.watched);
}

TEST_F(MeasurementRuns, TheOperatorsWishesAndSilenceMakeNoReading) {
  ReportingDriver driver;
  for (const MeasurementOutcome wish : {repeat, back, ended}) {
    const Measurement made = answered(driver, wish);
    EXPECT_EQ(made.outcome, wish);
    EXPECT_FALSE(made.reading);
  }
  Reader silent([](double) { return std::nullopt; });
  const Measurement made = measure(driver, silent);
  EXPECT_EQ(made.outcome, unanswered);
  EXPECT_FALSE(made.reading);
}

// The device says after a second that it has 1 A of 2: that counts, and the field is that of 1 A.
TEST_F(MeasurementRuns, CurrentsThatTheDeviceLimitsCountAsReported) {
  timing.hold = 3;
  ReportingDriver driver([](double current) { return std::clamp(current, -1.0, 1.0); });
  Reader reader([](double) { return FieldAnswer{measured, readings}; });
  const Measurement made = measure(driver, reader);
  EXPECT_EQ(made.outcome, measured);
  EXPECT_EQ(reader.limited, std::vector<Eigen::Index>{0});
  EXPECT_DOUBLE_EQ(made.currents[0], 1);
  ASSERT_TRUE(made.expected);
  EXPECT_TRUE(made.expected->isApprox(rig.system.at(step.position).total_field(made.currents)));
}

TEST_F(MeasurementRuns, ADeviceWithoutCurrentIsNotMeasured) {
  timing.hold = 3;
  ReportingDriver driver([](double) { return 0.0; });
  Reader reader([](double) { return FieldAnswer{measured, readings}; });
  const Measurement made = measure(driver, reader);
  EXPECT_EQ(made.outcome, no_current) << made.why;
  EXPECT_FALSE(made.reading);
  EXPECT_EQ(reader.began.size(), 0);
}

// At 0.5 A a coil's limit weakens what is asked for.
TEST_F(MeasurementRuns, WeakenedCurrentsAreNotMeasured) {
  rig = test::coil_rig(folder, "[{max_current_a: 0.5}, {max_current_a: 0.5}, {}]");
  timing.hold = 12;
  ReportingDriver driver;
  Reader reader([](double) { return FieldAnswer{measured, readings}; });
  const Measurement made = measure(driver, reader);
  EXPECT_EQ(made.outcome, weak);
  EXPECT_FALSE(made.reading);
}

TEST_F(MeasurementRuns, AReaderThatFailsIsAFaultAndAnUnconfirmedZeroToo) {
  ReportingDriver driver;
  Reader reader([](double) -> std::optional<FieldAnswer> { throw HardwareError("no new row"); });
  const Measurement broken = measure(driver, reader);
  EXPECT_EQ(broken.outcome, failed);
  EXPECT_EQ(broken.why, "no new row");
  driver.confirms = false;
  const Measurement made = answered(driver, measured);
  EXPECT_EQ(made.outcome, failed);
  EXPECT_TRUE(made.reading) << "what was measured before counts";
  EXPECT_FALSE(made.zero.good());
}

TEST_F(MeasurementRuns, AStopEndsIt) {
  ReportingDriver driver;
  std::atomic<bool> flag = false;
  Reader reader([&](double) {
    flag = true;
    return std::nullopt;
  });
  timing.hold = 10;
  EXPECT_EQ(measure(driver, reader, Stop(&flag)).outcome, ended);
}

TEST_F(MeasurementRuns, AReadingIsDoubtedBesideTheFileAndWithoutTheBackground) {
  Measurement made{.outcome = measured,
                   .reading = actuation::FieldReading{},
                   .expected = rig.system.at(step.position).total_field(step.currents)};
  const Eigen::Vector3d background(0.5, -1, 0);
  const auto doubt = [&](double factor) {
    made.reading->mean = background + factor * *made.expected;
    return reading_doubt(rig, made, step, background);
  };
  EXPECT_EQ(doubt(1), "");
  EXPECT_EQ(doubt(0.75), "");
  EXPECT_TRUE(test::names(doubt(10), "gauss")) << doubt(10);
  EXPECT_TRUE(test::names(doubt(-1), "reversed")) << doubt(-1);
  made.expected = Eigen::Vector3d::Zero();
  EXPECT_EQ(doubt(1), "") << "without current";
  made.expected.reset();
  EXPECT_EQ(reading_doubt(rig, made, step, background), "") << "outside the workspace";
}

TEST_F(MeasurementRuns, TheBackgroundIsTheNewestReadingWithoutCurrent) {
  actuation::MeasurementLog log(folder / "measured.csv", rig.system.coil_names());
  std::vector<actuation::MeasurementStep> steps(2, step);
  steps[0].currents.setZero();
  MeasurementRun run(steps, log);
  EXPECT_EQ(run.background(), Eigen::Vector3d::Zero());
  for (const Eigen::Vector3d& mean : {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(4, 5, 6)})
    run.take({.outcome = measured,
              .currents = run.next()->currents,
              .reading = actuation::FieldReading{.mean = mean}},
             true);
  EXPECT_EQ(run.background(), Eigen::Vector3d(1, 2, 3));
}

TEST_F(MeasurementRuns, MissingStepsComeInOrderAndAttemptsWithoutOneEnd) {
  actuation::MeasurementLog log(folder / "measured.csv", rig.system.coil_names());
  std::vector<actuation::MeasurementStep> steps(3, step);
  for (int k = 0; k < 3; ++k) steps[static_cast<std::size_t>(k)].currents[0] = k;
  MeasurementRun run(steps, log);
  const auto is_next = [&](double current) {
    return run.next() && run.next()->currents[0] == current;
  };
  const auto read = [&] {
    return Measurement{.outcome = measured,
                       .currents = run.next()->currents,
                       .reading = actuation::FieldReading{}};
  };
  EXPECT_TRUE(is_next(0));
  run.take(read(), false);
  EXPECT_TRUE(is_next(1));
  EXPECT_EQ(run.made(), 1u);
  run.take({.outcome = back}, true);
  EXPECT_TRUE(is_next(0));
  run.take(read(), true);
  run.take(read(), true);
  for (int k = 1; k <= 3; ++k) {
    run.take({.outcome = unanswered}, false);
    EXPECT_EQ(run.attempts(), k);
  }
  run.take({.outcome = unanswered}, true);
  EXPECT_EQ(run.attempts(), 0) << "a person decides";
  // Back and again makes nothing new.
  for (int k = 1; k <= 2; ++k) {
    run.take({.outcome = back}, false);
    run.take(read(), false);
    EXPECT_EQ(run.attempts(), 2 * k);
  }
  MeasurementRun later(steps, log);
  EXPECT_EQ(later.made(), 2u);
  later.take(read(), false);
  EXPECT_FALSE(later.next());
  EXPECT_EQ(later.made(), later.size());
}

}  // namespace
}  // namespace microswarm::rig

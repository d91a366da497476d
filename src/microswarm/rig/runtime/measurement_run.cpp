// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/measurement_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "microswarm/actuation/coils/field_comparison.hpp"

namespace microswarm::rig {
namespace {

constexpr double max_settling = 10;  // after the ramp, until the currents are reached [s]
constexpr double max_arriving = 1;   // time for which a device may report other currents [s]
constexpr double weakened = 1 - 1e-6;
constexpr double least_compared = 0.01;  // expected field that says something of a reading [mT]
constexpr double resolution = 2e-3;      // share of full scale by which a device may differ

/// The measurement of one step while its currents flow.
class StepMeasurement {
 public:
  StepMeasurement(const Rig& rig, const actuation::CoilDriver& driver,
                  const actuation::MeasurementStep& step, const MeasurementTiming& timing,
                  FieldReader& reader)
      : rig_(rig),
        driver_(driver),
        step_(step),
        counts_from_(timing.ramp + timing.settle),
        tolerance_(resolution * driver_full_scale(rig.params)),
        reader_(reader),
        currents_(Eigen::VectorXd::Zero(step.currents.size())) {}

  bool has_ended() const { return answer_.has_value(); }
  void look(const ManualMoment& moment);
  Measurement result(const ManualResult& drive) const;

 private:
  void end(MeasurementOutcome outcome) { answer_ = {outcome, {}}; }
  bool is_reached() const {
    return (currents_ - step_.currents).cwiseAbs().maxCoeff() <= tolerance_;
  }
  void settle(double t);
  SettledCurrents settled() const;

  const Rig& rig_;
  const actuation::CoilDriver& driver_;
  const actuation::MeasurementStep& step_;
  double counts_from_;  // [s]
  double tolerance_;    // between planned and reported currents [A]
  FieldReader& reader_;
  Eigen::VectorXd currents_;  // as the device reports them [A]
  std::optional<double> settled_at_;
  std::optional<FieldAnswer> answer_;
};

/// Called after each output to the coils.
void StepMeasurement::look(const ManualMoment& moment) {
  if (answer_ || !settled_at_) reader_.watch();
  if (answer_) return;
  const bool full = moment.output.scale >= weakened;
  const std::vector<double>& reported = driver_.report().currents;
  currents_ = Eigen::Map<const Eigen::VectorXd>(reported.data(), currents_.size());
  if (settled_at_ && !full)
    end(MeasurementOutcome::weak);
  else if (settled_at_)
    answer_ = reader_.poll(moment.t - *settled_at_);
  else if (moment.t >= counts_from_ && full)
    settle(moment.t);
  else if (moment.t > counts_from_ + max_settling)
    end(MeasurementOutcome::weak);
}

/// Detects settled currents after the ramp: as planned, or other ones for long enough.
void StepMeasurement::settle(double t) {
  if (!is_reached() && t < counts_from_ + max_arriving) return;
  if (!is_reached() && currents_.cwiseAbs().maxCoeff() <= tolerance_ / 4)
    return end(MeasurementOutcome::no_current);
  settled_at_ = t;
  reader_.begin(settled());
}

SettledCurrents StepMeasurement::settled() const {
  SettledCurrents out{.step = step_, .currents = currents_, .limited = {}, .expected = {}};
  for (Eigen::Index k = 0; k < currents_.size(); ++k)
    if (std::abs(step_.currents[k]) - std::abs(currents_[k]) > tolerance_) out.limited.push_back(k);
  if (rig_.system.in_workspace(step_.position))
    out.expected =
        rig_.system.at(step_.position).total_field(is_reached() ? step_.currents : currents_);
  return out;
}

Measurement StepMeasurement::result(const ManualResult& drive) const {
  using enum MeasurementOutcome;
  Measurement out{.outcome = answer_ ? answer_->outcome : unanswered,
                  .currents = currents_,
                  .zero = drive.zero,
                  .why = drive.why};
  // A measurement counts even if something fails while the currents ramp down.
  if (answer_ && answer_->outcome == measured) {
    out.reading = actuation::mean_reading(answer_->readings);
    out.expected = settled().expected;
  }
  if (!drive.why.empty() || !drive.zero.good())
    out.outcome = failed;
  else if (drive.status == Status::stopped)
    out.outcome = ended;
  return out;
}

}  // namespace

Measurement measure_field(const Rig& rig, actuation::CoilDriver& driver,
                          const actuation::MeasurementStep& step, const MeasurementTiming& timing,
                          FieldReader& reader, const Eigen::VectorXd& temperatures,
                          const std::function<void(const actuation::CoilOutput&)>& listener,
                          const Stop& stop) {
  StepMeasurement measurement(rig, driver, step, timing, reader);
  const ManualCommand command{.wanted = step.currents,
                              .seconds = 2 * timing.ramp + timing.settle + timing.hold,
                              .ramp = timing.ramp,
                              .enough = [&] { return measurement.has_ended(); }};
  return measurement.result(drive_by_hand(
      rig, driver, command, temperatures,
      [&](const ManualMoment& moment) {
        if (listener) listener(moment.output);
        measurement.look(moment);
      },
      stop));
}

std::string reading_doubt(const Rig& rig, const Measurement& measurement,
                          const actuation::MeasurementStep& step,
                          const Eigen::Vector3d& background) {
  if (!measurement.expected || !measurement.reading) return {};
  const Eigen::Vector3d expected =
      *measurement.expected - rig.system.at(step.position).offset.field;
  if (expected.norm() < least_compared) return {};
  return actuation::field_doubt(measurement.reading->mean - background, expected);
}

MeasurementRun::MeasurementRun(std::vector<actuation::MeasurementStep> steps,
                               actuation::MeasurementLog& log)
    : steps_(std::move(steps)),
      log_(log),
      missing_(actuation::missing_steps(steps_, log.measured().rows)),
      fewest_(missing_.size()) {}

void MeasurementRun::take(const Measurement& measurement, bool operated) {
  if (measurement.reading && next())
    log_.add(measurement.currents, next()->currents, next()->position, *measurement.reading);
  if (measurement.outcome == MeasurementOutcome::back) log_.remove_last();
  missing_ = actuation::missing_steps(steps_, log_.measured().rows);
  const bool person = operated && measurement.outcome != MeasurementOutcome::measured;
  attempts_ = person || missing_.size() < fewest_ ? 0 : attempts_ + 1;
  fewest_ = person ? missing_.size() : std::min(fewest_, missing_.size());
}

Eigen::Vector3d MeasurementRun::background() const {
  const std::vector<actuation::FieldMeasurement>& rows = log_.measured().rows;
  const auto newest = std::find_if(rows.rbegin(), rows.rend(),
                                   [](const auto& row) { return row.currents.isZero(0); });
  return newest == rows.rend() ? Eigen::Vector3d::Zero() : newest->field;
}

}  // namespace microswarm::rig

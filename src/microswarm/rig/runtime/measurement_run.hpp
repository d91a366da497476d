// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/actuation/coils/measurement_log.hpp"
#include "microswarm/actuation/coils/measurement_plan.hpp"
#include "microswarm/rig/runtime/manual_drive.hpp"

namespace microswarm::rig {

/// Times of a measurement [s].
struct MeasurementTiming {
  double ramp = 0.5;    ///< of each ramp
  double settle = 0.5;  ///< after the ramp, until the field counts
  double hold = 60;     ///< longest time for which a current waits for a reading
};

/// Outcome of the measurement of a step.
enum class MeasurementOutcome {
  measured,    ///< its field was read
  repeat,      ///< the operator wants it again
  back,        ///< the operator wants the one before it again
  unanswered,  ///< nothing was read within the hold
  weak,        ///< the limits of the coils weaken its currents
  no_current,  ///< the device reports no current
  ended,       ///< by the operator, or by a stop
  failed       ///< a fault, or a zero that is not confirmed
};

/// Currents that have settled.
struct SettledCurrents {
  const actuation::MeasurementStep& step;
  const Eigen::VectorXd& currents;      ///< as the device reports them [A]
  std::vector<Eigen::Index> limited{};  ///< coils that the device limits
  std::optional<Eigen::Vector3d>
      expected{};  ///< by the rig's coil file [mT]; only in the workspace
};

/// Answer of a reader of fields: readings [mT] if it is `measured`.
struct FieldAnswer {
  MeasurementOutcome outcome = MeasurementOutcome::measured;
  std::vector<Eigen::Vector3d> readings{};
};

/// Reads the field while currents flow: from an operator, or from the file of a probe. An exception
/// from it is a fault, which sets the coils to zero.
class FieldReader {
 public:
  virtual ~FieldReader() = default;
  /// Called once the currents have settled: the field counts from now on.
  virtual void begin(const SettledCurrents& settled) = 0;
  /// Called at each later output, `t` s after `begin`; the answer when there is one.
  virtual std::optional<FieldAnswer> poll(double t) = 0;
  /// Called at each output before and after that.
  virtual void watch() = 0;
};

/// Result of the measurement of a step.
struct Measurement {
  MeasurementOutcome outcome = MeasurementOutcome::ended;
  Eigen::VectorXd currents{};                        ///< as the device reported them [A]
  std::optional<actuation::FieldReading> reading{};  ///< also if it failed afterwards
  std::optional<Eigen::Vector3d> expected{};         ///< as in SettledCurrents
  actuation::StopReport zero{};                      ///< of the zero at the end
  std::string why{};                                 ///< reason of a fault
};

/// Drives the currents of a step, waits until they have settled and holds them until the reader
/// answers. The coils are at zero afterwards, also after an exception. `temperatures`: coils at the
/// start [°C]. `listener` is called after each output.
Measurement measure_field(const Rig& rig, actuation::CoilDriver& driver,
                          const actuation::MeasurementStep& step, const MeasurementTiming& timing,
                          FieldReader& reader, const Eigen::VectorXd& temperatures,
                          const std::function<void(const actuation::CoilOutput&)>& listener,
                          const Stop& stop);

/// Doubt about the reading of a step in words (field_doubt), beside the field that the rig's coil
/// file predicts and less `background`, the reading without current [mT]; empty if there is none.
std::string reading_doubt(const Rig& rig, const Measurement& measurement,
                          const actuation::MeasurementStep& step,
                          const Eigen::Vector3d& background);

/// Order of the measurements that a log lacks, and the end of attempts that lead to nothing.
class MeasurementRun {
 public:
  /// Attempts without operator, one after the other, that may make no measurement.
  static constexpr int max_attempts = 5;

  MeasurementRun(std::vector<actuation::MeasurementStep> steps, actuation::MeasurementLog& log);

  /// The first step that is missing; null if none is.
  const actuation::MeasurementStep* next() const {
    return missing_.empty() ? nullptr : &missing_.front();
  }
  std::size_t size() const { return steps_.size(); }
  std::size_t made() const { return steps_.size() - missing_.size(); }
  /// Takes what came of the next step: adds its reading to the log, or takes back the one before.
  /// `operated`: a person decides at each step, so attempts are not counted. Throws InputError if
  /// the log cannot be written.
  void take(const Measurement& measurement, bool operated);
  /// The newest reading without current [mT]; zero if there is none.
  Eigen::Vector3d background() const;
  /// Consecutive attempts that made no measurement.
  int attempts() const { return attempts_; }

 private:
  std::vector<actuation::MeasurementStep> steps_;
  actuation::MeasurementLog& log_;
  std::vector<actuation::MeasurementStep> missing_;
  std::size_t fewest_;
  int attempts_ = 0;
};

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/actuation/coils/probe_file.hpp"
#include "microswarm/rig/runtime/measurement_run.hpp"
#include "rig/keys/answer_line.hpp"

namespace microswarm::cli {

/// Fields that an operator types. Notes the currents that the device limits.
class TypedField : public rig::FieldReader {
 public:
  /// `what` begins the question; `coils` are the coils' names.
  TypedField(AnswerLine& answers, const std::vector<std::string>& coils, std::string what);

  void begin(const rig::SettledCurrents& settled) override;
  std::optional<rig::FieldAnswer> poll(double t) override;
  void watch() override { answers_.watch(); }

 private:
  AnswerLine& answers_;
  const std::vector<std::string>& coils_;
  std::string question_;
};

/// Fields that the logger of a probe writes, over `dwell` s. Notes the currents that the device
/// limits.
class LoggedField : public rig::FieldReader {
 public:
  LoggedField(AnswerLine& answers, const std::vector<std::string>& coils,
              actuation::ProbeFile& probe, double dwell);

  void begin(const rig::SettledCurrents& settled) override;
  std::optional<rig::FieldAnswer> poll(double t) override;
  void watch() override { answers_.watch(); }

 private:
  AnswerLine& answers_;
  const std::vector<std::string>& coils_;
  actuation::ProbeFile& probe_;
  double dwell_;
  std::vector<Eigen::Vector3d> readings_;
  double newest_ = 0;  ///< when the newest row came [s]
};

}  // namespace microswarm::cli

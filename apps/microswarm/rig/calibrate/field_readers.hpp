// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/actuation/coils/probe_file.hpp"
#include "microswarm/rig/runtime/measurement_run.hpp"
#include "rig/keys/answer_line.hpp"

namespace microswarm::cli {

/// Reads fields beside an operator, who can stop the coils. Notes the currents that the device
/// limits.
class OperatedField : public rig::FieldReader {
 public:
  /// `coils`: the coils' names.
  OperatedField(AnswerLine& answers, const std::vector<std::string>& coils)
      : answers_(answers), coils_(coils) {}

  void begin(const rig::SettledCurrents& settled) override;
  void watch() override { answers_.watch(); }

 protected:
  AnswerLine& answers() const { return answers_; }
  /// Takes a line if there is one. Returns the answer that a word of the operator (q, r, b) or the
  /// end of the input is; otherwise `text` is the line, or empty without one.
  std::optional<rig::FieldAnswer> take_line(std::optional<std::string>& text);

 private:
  AnswerLine& answers_;
  const std::vector<std::string>& coils_;
};

/// Fields that the operator types.
class TypedField : public OperatedField {
 public:
  /// `what` begins the question.
  TypedField(AnswerLine& answers, const std::vector<std::string>& coils, std::string what)
      : OperatedField(answers, coils), question_(std::move(what)) {}

  void begin(const rig::SettledCurrents& settled) override;
  std::optional<rig::FieldAnswer> poll(double t) override;

 private:
  std::string question_;
};

/// A current that the operator reads from a clamp meter, or none.
class TypedCurrent : public OperatedField {
 public:
  /// `what` names the current that should flow.
  TypedCurrent(AnswerLine& answers, const std::vector<std::string>& coils, const std::string& what);

  void begin(const rig::SettledCurrents& settled) override;
  std::optional<rig::FieldAnswer> poll(double t) override;
  /// The typed current [A]; empty if none was typed.
  std::optional<double> current() const { return current_; }

 private:
  std::string question_;
  std::optional<double> current_;
};

/// Fields that the logger of a probe writes, over `dwell` s.
class LoggedField : public OperatedField {
 public:
  LoggedField(AnswerLine& answers, const std::vector<std::string>& coils,
              actuation::ProbeFile& probe, double dwell)
      : OperatedField(answers, coils), probe_(probe), dwell_(dwell) {}

  void begin(const rig::SettledCurrents& settled) override;
  std::optional<rig::FieldAnswer> poll(double t) override;

 private:
  actuation::ProbeFile& probe_;
  double dwell_;
  std::vector<Eigen::Vector3d> readings_;
  double newest_ = 0;  ///< when the newest row came [s]
};

}  // namespace microswarm::cli

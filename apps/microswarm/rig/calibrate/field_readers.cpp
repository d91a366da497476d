// SPDX-License-Identifier: Apache-2.0
#include "rig/calibrate/field_readers.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "rig/rig.hpp"

namespace microswarm::cli {
namespace {

constexpr double probe_silence = 5;      // [s]
constexpr double max_typed_field = 1e4;  // [mT]

/// Parses a typed field; on failure `why` is the reason.
std::optional<Eigen::Vector3d> field_in(std::string line, std::string& why) {
  std::ranges::replace_if(
      line, [](char c) { return c == ',' || c == '\t'; }, ' ');
  const std::vector<std::string_view> cells = words(line);
  Eigen::Vector3d field;
  for (std::size_t k = 0; k < cells.size() && cells.size() == 3; ++k) {
    const std::optional<double> value = parse_number(cells[k]);
    if (!value || std::abs(*value) > max_typed_field) {
      why = fmt::format("{} is no field of at most {:.6g} mT", quote(cells[k]), max_typed_field);
      return std::nullopt;
    }
    field[static_cast<Eigen::Index>(k)] = *value;
  }
  if (cells.size() == 3) return field;
  why = fmt::format("three numbers are needed, Bx By Bz in mT, not {}", quote(line));
  return std::nullopt;
}

}  // namespace

void OperatedField::begin(const rig::SettledCurrents& settled) {
  std::vector<std::string> limited;
  for (const Eigen::Index k : settled.limited)
    limited.push_back(fmt::format("{} to {:.4g} A of {:.4g} A", coils_[static_cast<std::size_t>(k)],
                                  settled.currents[k], settled.step.currents[k]));
  if (!limited.empty()) note("note: the device limits {}\n", fmt::join(limited, ", "));
}

std::optional<rig::FieldAnswer> OperatedField::take_line(std::optional<std::string>& text) {
  using enum rig::MeasurementOutcome;
  const auto line = answers_.poll();
  if (!line) return answers_.ended() ? std::optional(rig::FieldAnswer{ended}) : std::nullopt;
  text = trimmed(*line);
  if (*text == "q") return rig::FieldAnswer{ended};
  if (*text == "r") return rig::FieldAnswer{repeat};
  if (*text == "b") return rig::FieldAnswer{back};
  return std::nullopt;
}

void TypedField::begin(const rig::SettledCurrents& settled) {
  OperatedField::begin(settled);
  if (const auto& b = settled.expected) {
    const auto shown = [&](Eigen::Index k) { return tidy((*b)[k], 1e3 * b->norm()); };
    question_ +=
        fmt::format(", ({:.4g}, {:.4g}, {:.4g}) mT expected", shown(0), shown(1), shown(2));
  }
  question_ += ". Bx By Bz in mT: ";
  answers().ask(question_);
}

std::optional<rig::FieldAnswer> TypedField::poll(double) {
  std::optional<std::string> text;
  if (const auto word = take_line(text); word || !text) return word;
  std::string why;
  if (const auto field = field_in(*text, why))
    return rig::FieldAnswer{rig::MeasurementOutcome::measured, {*field}};
  note("{}\n", why);
  answers().ask(question_);
  return std::nullopt;
}

TypedCurrent::TypedCurrent(AnswerLine& answers, const std::vector<std::string>& coils,
                           const std::string& what)
    : OperatedField(answers, coils),
      question_(what + ": amperes by a clamp meter (Enter: none at hand): ") {}

void TypedCurrent::begin(const rig::SettledCurrents& settled) {
  OperatedField::begin(settled);
  answers().ask(question_);
}

std::optional<rig::FieldAnswer> TypedCurrent::poll(double) {
  std::optional<std::string> text;
  if (const auto word = take_line(text); word || !text) return word;
  current_ = parse_number(*text);
  if (text->empty() || current_)
    return rig::FieldAnswer{rig::MeasurementOutcome::measured, {Eigen::Vector3d::Zero()}};
  note("a current in A, or Enter, is needed, not {}\n", quote(*text));
  answers().ask(question_);
  return std::nullopt;
}

void LoggedField::begin(const rig::SettledCurrents& settled) {
  OperatedField::begin(settled);
  probe_.skip_to_end();
}

std::optional<rig::FieldAnswer> LoggedField::poll(double t) {
  watch();
  const std::size_t before = readings_.size();
  probe_.read(readings_);
  if (readings_.size() > before) newest_ = t;
  if (t - newest_ > probe_silence)
    throw HardwareError(fmt::format("{}: no new row in {:.6g} s after {}", probe_.name(),
                                    probe_silence, quote(probe_.last_row())));
  if (readings_.empty() || t < dwell_) return std::nullopt;
  return rig::FieldAnswer{rig::MeasurementOutcome::measured, readings_};
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/missing_answer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr std::size_t max_quoted = 60;      // bytes
constexpr std::size_t flood = 500;          // bytes without an answer
constexpr std::size_t max_unanswered = 16;  // messages whose late answers are recognised

}  // namespace

std::string late_answer_text(double seconds, double reply_timeout) {
  return fmt::format("its answer came after {:.0f} ms, reply_timeout_s is {:g}", 1e3 * seconds,
                     reply_timeout);
}

void MissingAnswer::expect(std::uint32_t number, double t) {
  if (unanswered_.size() == max_unanswered) unanswered_.erase(unanswered_.begin());
  unanswered_.push_back({number, t});
  other_ = accepted_ = false;
  heard_.clear();
  bytes_ = 0;
}

void MissingAnswer::sent() {
  accepted_ = true;
  ++sent_;
}

void MissingAnswer::take(std::uint8_t byte) {
  sent_ = 0;
  ++bytes_;
  if (heard_.size() <= max_quoted) heard_ += static_cast<char>(byte);
}

void MissingAnswer::other(std::uint32_t number, double t) {
  const auto late = std::ranges::find(unanswered_, number, &Message::number);
  if (late == unanswered_.end())
    other_ = true;
  else
    late_ = t - late->t;
  heard_.clear();
  bytes_ = 0;
}

void MissingAnswer::answered() {
  unanswered_.clear();
  late_.reset();
  sent_ = 0;
}

std::string MissingAnswer::text() const {
  if (late_) return late_answer_text(*late_, reply_timeout_);
  const std::string_view said(heard_.data(), heard_.find_last_not_of("\r\n") + 1);
  const std::string quoted = one_line(said, max_quoted);
  if (bytes_ > flood)
    return fmt::format("it floods the line, {} bytes without an answer: '{}'", bytes_, quoted);
  if (bytes_ > 0) return fmt::format("it said '{}', which is no answer", quoted);
  if (other_) return "it answered another message";
  if (!accepted_) return "it accepts no bytes";
  return fmt::format("nothing came back, messages sent: {}", sent_);
}

}  // namespace microswarm::actuation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace microswarm::actuation {

/// Text for an answer that took `seconds`, of which `reply_timeout` were allowed.
std::string late_answer_text(double seconds, double reply_timeout);

/// Finds out why a device's answer is missing, from what was sent and what came back. Times are in
/// seconds, by any one clock.
class MissingAnswer {
 public:
  explicit MissingAnswer(double reply_timeout) : reply_timeout_(reply_timeout) {}

  /// A message with this number begins to be sent at `t`.
  void expect(std::uint32_t number, double t);
  /// All bytes of the message have been sent, once more or for the first time.
  void sent();
  void take(std::uint8_t byte);
  /// The bytes taken so far were an answer to another message than the last one.
  void other(std::uint32_t number, double t);
  /// The last message was answered in time.
  void answered();
  /// Whether answers come, but too late.
  bool is_late() const { return late_.has_value(); }
  /// The reason, one printable line.
  std::string text() const;

 private:
  struct Message {
    std::uint32_t number;
    double t;
  };
  double reply_timeout_;
  std::vector<Message> unanswered_;  // the newest ones
  std::optional<double> late_;       // delay of an answer that was no longer awaited [s]
  bool other_ = false, accepted_ = false;
  int sent_ = 0;       // since a byte came
  std::string heard_;  // start of what came since the last message, and the number of its bytes
  std::size_t bytes_ = 0;
};

}  // namespace microswarm::actuation

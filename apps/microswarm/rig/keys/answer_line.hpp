// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "rig/keys/key_terminal.hpp"

namespace microswarm::cli {

/// Lines that a person types at the terminal, or that come through a pipe, without waiting for
/// them, so that coils can be driven meanwhile. At a terminal Esc is an emergency stop at any time,
/// with `any_stop_key` also space and e; the line is edited with backspace and Ctrl-U. The terminal
/// is restored at the end.
class AnswerLine {
 public:
  explicit AnswerLine(bool any_stop_key);
  ~AnswerLine();
  AnswerLine(const AnswerLine&) = delete;
  AnswerLine& operator=(const AnswerLine&) = delete;

  bool is_terminal() const { return terminal_.is_there(); }
  /// Asks on stderr. What was typed before at a terminal is no answer.
  void ask(std::string_view question);
  /// The line, if it is complete by now. Throws HardwareError if an emergency key was pressed.
  std::optional<std::string> poll();
  /// Looks for the emergency key only; other keys are forgotten, what comes through a pipe waits.
  /// Errors as above.
  void watch();
  /// Nothing more can come.
  bool ended() const { return ended_; }

 private:
  void read_more();
  void take_key(char key);

  bool any_stop_key_;
  KeyTerminal terminal_;
  bool ended_ = false;
  std::string typed_;  // at a terminal the line so far; of a pipe, what was read and not used
  bool complete_ = false;
};

}  // namespace microswarm::cli

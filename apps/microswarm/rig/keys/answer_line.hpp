// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "rig/keys/key_terminal.hpp"

namespace microswarm::cli {

/// Non-blocking reader of lines that a user types at the terminal or a pipe delivers, so that coils
/// can be driven meanwhile. At a terminal Esc is an emergency stop at any time, with `any_stop_key`
/// also space and e; the line is edited with backspace and Ctrl-U. The destructor restores the
/// terminal.
class AnswerLine {
 public:
  explicit AnswerLine(bool any_stop_key);
  ~AnswerLine();
  AnswerLine(const AnswerLine&) = delete;
  AnswerLine& operator=(const AnswerLine&) = delete;

  bool is_terminal() const { return terminal_.is_there(); }
  /// Asks on stderr. Input typed at the terminal before is discarded.
  void ask(std::string_view question);
  /// The line, if it is complete. Throws HardwareError if an emergency key was pressed.
  std::optional<std::string> poll();
  /// Checks for the emergency key only; other keys are discarded, a pipe's input is kept. Errors as
  /// above.
  void watch();
  /// Whether the input has ended.
  bool ended() const { return ended_; }

 private:
  void read_more();
  void take_key(char key);

  bool any_stop_key_;
  KeyTerminal terminal_;
  bool ended_ = false;
  std::string typed_;  // at a terminal the line so far; from a pipe the unused input
  bool complete_ = false;
};

}  // namespace microswarm::cli

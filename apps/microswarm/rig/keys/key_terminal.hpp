// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <optional>
#include <string>

namespace microswarm::cli {

/// Whether the program receives a terminal's keys, so is not in the background.
bool has_keys();

/// Input of stdin within `ms`, possibly empty; nothing at its end.
std::optional<std::string> input_within(int ms);

/// The terminal at stdin, if any, in unbuffered mode without echo. In the background its settings
/// are unchanged.
class KeyTerminal {
 public:
  KeyTerminal();
  bool is_there() const { return is_there_; }
  /// To be called before each read, since a shell resets the terminal when the program is suspended
  /// and resumed. False in the background, where a read would stop the program.
  bool prepare() const;
  /// Restores the terminal's settings.
  void restore() const;

 private:
  termios before_{};
  bool is_there_;  // set with `before_`
};

}  // namespace microswarm::cli

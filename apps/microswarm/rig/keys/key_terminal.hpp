// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <termios.h>

#include <optional>
#include <string>

namespace microswarm::cli {

/// Whether the program has the keys of a terminal: it is not in the background.
bool has_keys();

/// What stdin has within `ms`, empty if there is nothing; none at its end.
std::optional<std::string> input_within(int ms);

/// The terminal at stdin, if there is one, that gives each key at once and does not show it. In the
/// background its settings are left alone.
class KeyTerminal {
 public:
  KeyTerminal();
  bool is_there() const { return is_there_; }
  /// To be called before each reading, because a shell resets the terminal when the program is
  /// suspended and resumed. False in the background, where a reading would stop the program.
  bool prepare() const;
  /// Gives it back as it was.
  void restore() const;

 private:
  termios before_{};
  bool is_there_;  // set with `before_`
};

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace microswarm {

/// Bad input from outside: a file, a key or a value. Thrown once, with one line per mistake that
/// names the file, position, value and limit. The command-line tool prints the lines and exits with
/// 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& what) : std::runtime_error(what) {}
  /// "file:line:column: what"; line and column count from 1, 0 leaves them out.
  InputError(const std::string& file, int line, int column, const std::string& what);
  /// Several lines, at least one; only the first 20 are listed, the rest are counted.
  explicit InputError(std::vector<std::string> lines);
};

/// A device is missing, does not answer or refuses. The command-line tool prints the message and
/// exits with 4.
class HardwareError : public std::runtime_error {
 public:
  explicit HardwareError(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace microswarm

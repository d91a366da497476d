// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "microswarm/core/errors/issue.hpp"

namespace microswarm {

/// Bad input from outside: a file, a key or a value. Thrown once, with an issue for each mistake;
/// `what` has a line for each of the first 20. The command-line tool prints the lines and exits
/// with 2.
class InputError : public std::runtime_error {
 public:
  /// One issue that is only a text.
  explicit InputError(const std::string& what);
  /// "location: what"; the location is a file, or another place in words of who gave it.
  InputError(const std::string& location, const std::string& what);
  /// "file:line:column: what"; line and column count from 1, 0 leaves them out.
  InputError(const std::string& file, int line, int column, const std::string& what);
  /// At least one issue, located.
  explicit InputError(Issues issues);
  explicit InputError(Issue issue);

  const Issues& issues() const { return *issues_; }

 private:
  std::shared_ptr<const Issues> issues_;  // shared: an exception is copied without throwing
};

/// Issues of an InputError; the text of any other exception as one. Catch an InputError first.
inline Issues to_issues(const InputError& error) { return error.issues(); }
Issues to_issues(const std::exception& error);

/// Calls `read` and adds the issues of its InputError as issues about `key`.
template <class Read>
void attempt(Issues& issues, std::string_view key, Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    issues.add_about(key, error.issues());
  }
}

/// A device is missing, does not answer or refuses. The command-line tool prints the message and
/// exits with 4.
class HardwareError : public std::runtime_error {
 public:
  explicit HardwareError(const std::string& what) : std::runtime_error(what) {}
};

}  // namespace microswarm

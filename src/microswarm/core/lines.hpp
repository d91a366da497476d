// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm {

/// The lines of a text file one by one, without their ends (LF or CRLF) and a byte order mark.
class Lines {
 public:
  /// `name` stands for the file in messages.
  Lines(std::string_view text, std::string_view name);

  /// The next line, or nothing at the end.
  std::optional<std::string_view> next();
  /// Number of the line last given, from 1.
  int number() const { return number_; }
  /// Throws InputError "NAME:LINE: WHY" at the line last given.
  [[noreturn]] void fail(const std::string& why) const;

 private:
  std::string_view rest_;
  std::string name_;
  int number_ = 0;
};

/// `text` without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// The pieces between separators, trimmed; one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The words between runs of blanks.
std::vector<std::string_view> words(std::string_view text);

}  // namespace microswarm

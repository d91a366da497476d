// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm {

/// Lines of a text file, one by one, without their ends (LF or CRLF) and without a byte order mark.
class Lines {
 public:
  /// `name` stands for the file in messages.
  Lines(std::string_view text, std::string_view name);

  /// Next line, or nothing at the end.
  std::optional<std::string_view> next();
  /// Number of the last line returned, from 1.
  int number() const { return number_; }
  /// Throws InputError "NAME:LINE: WHY" for the last line returned.
  [[noreturn]] void fail(const std::string& why) const;

 private:
  std::string_view rest_;
  std::string name_;
  int number_ = 0;
};

/// `text` without leading and trailing blanks.
std::string_view trimmed(std::string_view text);

/// Parts between separators, trimmed; one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Words separated by blanks.
std::vector<std::string_view> words(std::string_view text);

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm {

/// Lines of a text file, one by one, without their ends (LF, CRLF or CR), a byte order mark and a
/// first line "sep=;" of a spreadsheet.
class Lines {
 public:
  /// `name` stands for the file in messages. Throws as require_utf8.
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

/// Refuses a text in UTF-16 or UTF-32, by its byte order mark: "NAME: is in UTF-16: …".
void require_utf8(std::string_view text, std::string_view name);

/// `text` without leading and trailing blanks.
std::string_view trimmed(std::string_view text);

/// Parts between separators, trimmed; one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Words separated by blanks.
std::vector<std::string_view> words(std::string_view text);

}  // namespace microswarm

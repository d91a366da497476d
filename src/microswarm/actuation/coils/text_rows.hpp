// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/lines.hpp"

namespace microswarm {

/// The rows of a text of numbers, blank lines and lines that start with '#' passed over.
class TextRows {
 public:
  /// `name` stands for the file in messages.
  TextRows(std::string_view text, std::string_view name);

  /// The next row, trimmed; false at the end.
  bool next();
  /// The pieces of the row between separators, trimmed; a blank separates by runs of blanks.
  std::vector<std::string_view> pieces(char separator) const;
  /// The next row as exactly so many finite numbers. `what` names it in complaints.
  std::vector<double> numbers(std::size_t count, char separator, const char* what);
  /// The number that one piece of the row spells.
  double number(std::string_view piece, std::string_view what) const;
  /// Number of the line last given, from 1.
  int line() const { return lines_.number(); }
  /// Complains of a row that follows.
  void end();
  /// Throws InputError "NAME:LINE: WHY" at the row last given.
  [[noreturn]] void fail(const std::string& why) const;

 private:
  Lines lines_;
  std::string_view row_;
  std::string name_;
};

}  // namespace microswarm

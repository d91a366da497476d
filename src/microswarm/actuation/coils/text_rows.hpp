// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/text/lines.hpp"

namespace microswarm::actuation {

/// Reader of text rows of numbers. It skips blank lines and lines that start with '#'.
class TextRows {
 public:
  /// `name` is the file name in error messages.
  TextRows(std::string_view text, std::string_view name);

  /// Advances to the next row, trimmed; false at the end.
  bool next();
  /// The row, trimmed.
  std::string_view row() const { return row_; }
  /// Fields of the row between separators, trimmed. The separator ' ' matches runs of blanks.
  std::vector<std::string_view> pieces(char separator) const;
  /// Advances to the next row and parses exactly `count` finite numbers. `what` names the row in
  /// error messages.
  std::vector<double> numbers(std::size_t count, char separator, const char* what);
  /// Parses one field of the row as a number.
  double number(std::string_view piece, std::string_view what) const;
  /// Number of the line last given, from 1.
  int line() const { return lines_.number(); }
  /// Throws InputError if another row follows.
  void end();
  /// Throws InputError "NAME:LINE: WHY" for the current row.
  [[noreturn]] void fail(const std::string& why) const;

 private:
  Lines lines_;
  std::string_view row_;
  std::string name_;
};

}  // namespace microswarm::actuation

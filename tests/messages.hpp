// SPDX-License-Identifier: Apache-2.0
// What complaints must name, whatever their wording: file and place, key, value, limit.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace microswarm::test {

/// Whether `text` holds `part`, not as a piece of a longer word or number.
inline bool names(std::string_view text, std::string_view part) {
  const auto at = [&](std::size_t i) { return i < text.size() ? text[i] : ' '; };
  const auto is_digit = [&](std::size_t i) {
    return std::isdigit(static_cast<unsigned char>(at(i)));
  };
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (std::size_t i = text.find(part); i != std::string_view::npos; i = text.find(part, i + 1)) {
    const std::size_t end = i + part.size();
    // What stands before the first character is at i − 1, beyond the end of the text for i = 0.
    const bool goes_on_before =
        is_word(part.front()) &&
        (is_word(at(i - 1)) || (is_digit(i) && at(i - 1) == '.' && is_digit(i - 2)));
    const bool goes_on_behind =
        is_word(part.back()) &&
        (is_word(at(end)) || (is_digit(end - 1) && at(end) == '.' && is_digit(end + 1)));
    if (!goes_on_before && !goes_on_behind) return true;
  }
  return false;
}

/// Whether `what` is one line "PLACE: WHY" whose WHY names each of `parts`. A place is a file with
/// line and column, an option, or empty where there is none.
inline testing::AssertionResult is_one_line_naming(std::string_view what, std::string_view place,
                                                   const std::vector<std::string>& parts) {
  while (what.ends_with('\n')) what.remove_suffix(1);  // the program's last line
  const auto no = [&](std::string_view why) {
    return testing::AssertionFailure() << "\"" << what << "\" " << why;
  };
  if (what.find('\n') != std::string_view::npos) return no("is more than one line");
  if (!place.empty() && !what.starts_with(std::string(place) + ": "))
    return no("does not begin with ") << place << ':';
  std::string_view why = what.substr(place.empty() ? 0 : place.size() + 2);
  if (why.empty()) return no("gives no reason");
  for (const std::string& part : parts)
    if (!names(why, part)) return no("does not name ") << part;
  return testing::AssertionSuccess();
}

/// What is expected of a complaint: a whole line, or what one line must name.
struct Complaint {
  std::string line;  ///< the whole line, where the wording matters
  std::string place;
  std::vector<std::string> parts;

  Complaint(std::string whole) : line(std::move(whole)) {}
  Complaint(const char* whole) : line(whole) {}
  Complaint(std::string at, std::vector<std::string> named)
      : place(std::move(at)), parts(std::move(named)) {}

  /// The same about what is in `file`.
  Complaint in(const std::string& file) const {
    if (!line.empty()) return file + ": " + line;
    return {place.empty() ? file : file + ": " + place, parts};
  }
};

/// One line "PLACE: WHY" that names each of `parts`, see is_one_line_naming.
inline Complaint naming(std::string place, std::vector<std::string> parts) {
  return {std::move(place), std::move(parts)};
}

inline testing::AssertionResult is(const std::string& what, const Complaint& expected) {
  if (expected.line.empty()) return is_one_line_naming(what, expected.place, expected.parts);
  if (what == expected.line || what == expected.line + "\n") return testing::AssertionSuccess();
  return testing::AssertionFailure() << "\"" << what << "\" is not \"" << expected.line << '"';
}

}  // namespace microswarm::test

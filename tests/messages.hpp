// SPDX-License-Identifier: Apache-2.0
// What complaints must name, whatever their wording: the file and place, the key, the value, the
// limit.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <initializer_list>
#include <string>
#include <string_view>

namespace microswarm::test {

/// Whether `text` holds `part`, not as a piece of a longer word or number.
inline bool names(std::string_view text, std::string_view part) {
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (std::size_t at = text.find(part); at != std::string_view::npos;
       at = text.find(part, at + 1)) {
    const std::size_t end = at + part.size();
    const bool begins = at == 0 || !is_word(part.front()) || !is_word(text[at - 1]);
    const bool ends = end == text.size() || !is_word(part.back()) || !is_word(text[end]);
    if (begins && ends) return true;
  }
  return false;
}

/// Whether `what` is one line "PLACE: WHY" whose WHY names each of `parts`. A place is a file with
/// line and column, an option, or empty where there is none.
inline testing::AssertionResult is_one_line_naming(std::string_view what, std::string_view place,
                                                   std::initializer_list<std::string_view> parts) {
  while (what.ends_with('\n')) what.remove_suffix(1);  // the program's last line
  const auto no = [&](std::string_view why) {
    return testing::AssertionFailure() << "\"" << what << "\" " << why;
  };
  if (what.find('\n') != std::string_view::npos) return no("is more than one line");
  if (!place.empty() && !what.starts_with(std::string(place) + ": "))
    return no("does not begin with ") << place << ':';
  std::string_view why = what.substr(place.empty() ? 0 : place.size() + 2);
  if (why.empty()) return no("gives no reason");
  for (const std::string_view part : parts)
    if (!names(why, part)) return no("does not name ") << part;
  return testing::AssertionSuccess();
}

}  // namespace microswarm::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace microswarm {

/// Shortest decimal text that reads back to the same bits: "0.1", "60", "1e5", "-2.5e-7", "nan",
/// "inf", "-inf". Independent of the locale.
std::string number_text(double value);

/// Removes the plus sign and the leading zeros of the exponent that std::to_chars writes: "1e+05"
/// becomes "1e5".
std::string tidy_exponent(std::string text);

/// Text that is safe on a terminal and in a page: control characters other than newline and tab,
/// characters that turn the direction of writing, and bytes that are no UTF-8 become '?'.
std::string printable(std::string_view text);

/// Text for a one-line message: control characters become '?', text after `most` bytes becomes "…".
std::string one_line(std::string_view text, std::size_t most = 200);

/// The text on one line of at most 40 bytes, in single quotes.
std::string quote(std::string_view text);

/// Finite decimal number spelled by the whole text, or nothing. Independent of the locale; rejects
/// spaces, hexadecimal, "nan" and "inf"; accepts a leading '+'.
std::optional<double> parse_number(std::string_view text);

/// Minimum number of single-byte insertions, deletions, replacements and swaps of neighbours that
/// turn `a` into `b` (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Candidate nearest to a mistyped word, the first among equals. Empty if none is near: more than a
/// third of the longer word and more than one letter differ.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace microswarm {

/// Shortest decimal text that reads back to the same bits: "0.1", "60", "1e5", "-2.5e-7", and
/// "nan", "inf", "-inf". It does not depend on the locale.
std::string number_text(double value);

/// What std::to_chars wrote, without the plus and the zeros of its exponent: "1e+05" is "1e5".
std::string tidy_exponent(std::string text);

/// The text fit for a message of one line: control characters as '?', and "…" after `most` bytes.
std::string one_line(std::string_view text, std::size_t most = 200);

/// One line of no more than 40 bytes, in single quotes.
std::string quote(std::string_view text);

/// The finite number that all of `text` spells in decimal, or nothing. It does not depend on the
/// locale and takes no spaces, no hexadecimal, no "nan" and no "inf"; a leading '+' is allowed.
std::optional<double> parse_number(std::string_view text);

/// Fewest single-letter insertions, deletions, replacements and swaps of neighbours that turn `a`
/// into `b` (optimal string alignment, bytes).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to a mistyped word, the first among equals; empty when none is near
/// (more than a third of the longer word differs, and more than one letter).
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace microswarm

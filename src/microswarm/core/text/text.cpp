// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "microswarm/core/text/read_float.hpp"
#include "microswarm/core/text/utf8.hpp"

namespace microswarm {

std::string number_text(double value) {
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return tidy_exponent(std::string(buffer.data(), end));
}

std::string tidy_exponent(std::string text) {
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  const std::size_t sign = e + 1;
  const std::size_t digits = text.find_first_not_of('0', sign + 1);
  const bool negative = text[sign] == '-';
  return text.erase(sign + negative, digits - sign - negative);
}

namespace {

/// Control characters, also those of the second set, and those that turn the direction of writing.
bool is_control(std::uint32_t c) {
  if (c == '\n' || c == '\t') return false;
  return c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x61c || c == 0x200e || c == 0x200f ||
         (c >= 0x2028 && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character next = first_character(text);
    if (next.code && !is_control(*next.code))
      result += text.substr(0, next.bytes);
    else
      result += '?';
    text.remove_prefix(next.bytes);
  }
  return result;
}

std::string one_line(std::string_view text, std::size_t most) {
  std::size_t end = std::min(text.size(), most);
  if (end < text.size())  // do not split a UTF-8 character
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  std::string line = printable(text.substr(0, end));
  std::ranges::replace(line, '\n', '?');
  std::ranges::replace(line, '\t', '?');
  if (end < text.size()) line += "…";
  return line;
}

std::string quote(std::string_view text) { return fmt::format("'{}'", one_line(text, 40)); }

std::optional<double> parse_number(std::string_view text) {
  const std::size_t first = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  if (first >= text.size() || !(text[first] == '.' || (text[first] >= '0' && text[first] <= '9')))
    return std::nullopt;  // from_chars would accept "nan" and "inf" but not '+'
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  if (!read_float(text, value) || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view nearest;
  std::size_t least = word.size() + 1;
  for (std::string_view candidate : candidates) {
    const std::size_t longer = std::max(word.size(), candidate.size());
    const std::size_t allowed = std::max<std::size_t>(1, longer / 3);
    const std::size_t apart = longer - std::min(word.size(), candidate.size());
    if (apart > allowed || longer > 200) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance > allowed || distance >= least) continue;
    nearest = candidate;
    least = distance;
  }
  return nearest;
}

}  // namespace microswarm

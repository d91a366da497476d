// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/number.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "microswarm/config/type.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/text/read_float.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

/// Like number_text, but 100000 instead of 1e5: an exponent only for very large and very small
/// values.
std::string plain_text(double value) {
  if (!(std::abs(value) >= 1 && std::abs(value) < 1e15)) return number_text(value);
  std::array<char, 32> buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return std::string(buffer.data(), end);
}

bool in_degrees(Unit unit) { return unit == Unit::deg || unit == Unit::deg_per_s; }

/// Minimum number of digits in degrees that read back to this angle. The 17 of a double nearly
/// always suffice; long double's extra digits make every angle expressible.
std::string shown_angle(double stored) {
  const long double shown = stored * (180 / long_pi);
  std::array<char, 64> buffer;
  std::string text;
  for (int digits = 1; digits <= 21; ++digits) {
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), shown,
                                            std::chars_format::general, digits);
    text = tidy_exponent(std::string(buffer.data(), end));
    if (stored_number(text, Unit::deg) == stored) break;
  }
  const std::optional<double> rounded = parse_number(text);
  const std::string plain = rounded ? plain_text(*rounded) : text;
  return stored_number(plain, Unit::deg) == stored ? plain : text;
}

}  // namespace

std::optional<long double> exact_number(std::string_view text) {
  if (!parse_number(text)) return std::nullopt;
  if (text.starts_with('+')) text.remove_prefix(1);
  long double number = 0;
  read_float(text, number);
  return number;
}

std::optional<double> stored_number(std::string_view text, Unit unit) {
  if (!in_degrees(unit)) return parse_number(text);
  const std::optional<long double> shown = exact_number(text);
  return shown ? std::optional(radians(*shown)) : std::nullopt;
}

std::string shown_number(double stored, Unit unit) {
  return in_degrees(unit) && std::isfinite(stored) ? shown_angle(stored) : plain_text(stored);
}

std::string spaced_symbol(Unit unit) {
  return fmt::format("{}{}", unit == Unit::none || unit == Unit::deg ? "" : " ", unit_symbol(unit));
}

std::string range_text(const Range& range, Unit unit) {
  const bool below = std::isfinite(range.min), above = std::isfinite(range.max);
  const std::string least = number_text(range.min), most = number_text(range.max);
  if (below && above) return fmt::format("{}..{}{}", least, most, spaced_symbol(unit));
  if (below) return fmt::format("at least {}{}", least, spaced_symbol(unit));
  if (above) return fmt::format("at most {}{}", most, spaced_symbol(unit));
  return "";
}

}  // namespace microswarm

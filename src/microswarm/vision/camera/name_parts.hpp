// SPDX-License-Identifier: Apache-2.0
// Words and numbers of which the names of pictures consist.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::vision::name_parts {

namespace fs = std::filesystem;

/// Whether a letter is a digit of ASCII.
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A run of digits or of other letters at the beginning of a text.
inline std::string_view first_run(std::string_view text) {
  const auto end =
      std::ranges::find_if(text, [&](char c) { return is_digit(c) != is_digit(text.front()); });
  return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

/// Digits without leading zeros.
inline std::string_view without_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

/// A name as its runs, of which each second one is of digits.
inline std::vector<std::string> runs_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::vector<std::string> runs;
  std::string_view rest = stem;
  if (!rest.empty() && is_digit(rest.front())) runs.emplace_back();
  while (!rest.empty()) {
    runs.emplace_back(first_run(rest));
    rest.remove_prefix(runs.back().size());
  }
  return runs;
}

/// Value of digits; nothing if it is too large.
inline std::optional<std::int64_t> to_number(std::string_view digits) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

/// Small letters of ASCII.
inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Small letters of a text.
inline std::string lower(std::string_view text) {
  std::string all(text);
  for (char& c : all) c = lower(c);
  return all;
}

/// A number of a name and the text before it; the last one of a name may be without digits.
struct NamePart {
  std::string text{};  ///< in small letters
  std::string digits{}, fraction{};
  bool is_negative = false;

  /// Value in units of the last of `places` places; nothing if it is too large.
  std::optional<std::int64_t> value(std::size_t places) const {
    std::string all = digits + fraction;
    all.append(places - std::min(places, fraction.size()), '0');
    const auto number = to_number(all);
    return number && is_negative ? -*number : number;
  }
  bool operator==(const NamePart&) const = default;
};
using NameParts = std::vector<NamePart>;

/// Whether a point between two numbers, which is none of several in a row, stands behind number i.
inline bool has_point(const std::vector<std::string>& runs, std::size_t i) {
  return i + 2 < runs.size() && runs[i + 1] == "." && runs[i - 1] != "." &&
         (i + 3 >= runs.size() || runs[i + 3] != ".");
}

/// Points are decimal if the digits behind them are not equally many and no longer ones end in 0,
/// as programs print numbers. Counters have 1.10; equally many are in order either way.
inline bool are_decimal(const std::vector<std::vector<std::string>>& names) {
  std::set<std::size_t> lengths;
  for (const auto& runs : names)
    for (std::size_t i = 1; i < runs.size(); i += 2) {
      if (!has_point(runs, i)) continue;
      const std::string& fraction = runs[i + 2];
      if (fraction.size() > 1 && fraction.back() == '0') return false;
      lengths.insert(fraction.size());
    }
  return lengths.size() > 1;
}

/// Text before the signs of these texts, if they differ in nothing but a last '-' or '+'.
inline std::optional<std::string> text_before_signs(const std::set<std::string>& texts) {
  const std::string& first = *texts.begin();
  for (const std::string& base : {first, first.substr(0, first.empty() ? 0 : first.size() - 1)})
    if (std::ranges::all_of(texts, [&](const std::string& text) {
          return text == base || text == base + "-" || text == base + "+";
        }))
      return base;
  return std::nullopt;
}

/// A '-' or '+' is a sign where names differ in nothing else before a number.
inline void take_signs(std::vector<NameParts>& names) {
  const auto same_size = [&](const NameParts& n) { return n.size() == names.front().size(); };
  if (names.empty() || !std::ranges::all_of(names, same_size)) return;
  for (std::size_t i = 0; i < names.front().size(); ++i) {
    std::set<std::string> texts;
    for (const NameParts& name : names) texts.insert(name[i].text);
    const std::optional<std::string> before = text_before_signs(texts);
    if (!before) continue;
    for (NameParts& name : names) {
      if (name[i].text == *before || name[i].digits.empty()) continue;
      name[i].is_negative = name[i].text.back() == '-';
      name[i].text = *before;
    }
  }
}

/// Parts of the names of files that belong together.
inline std::vector<NameParts> parts_of(const std::vector<fs::path>& files) {
  std::vector<std::vector<std::string>> names;
  names.reserve(files.size());
  for (const fs::path& file : files) names.push_back(runs_of(file));
  const bool decimal = are_decimal(names);
  std::vector<NameParts> all;
  all.reserve(files.size());
  for (const auto& runs : names) {
    NameParts parts;
    for (std::size_t i = 0; i < runs.size(); i += 2) {
      NamePart part{.text = lower(runs[i]), .digits = {}, .fraction = {}};
      if (i + 1 < runs.size()) part.digits = runs[i + 1];
      if (decimal && has_point(runs, i + 1)) {
        part.fraction = runs[i + 3];
        i += 2;
      }
      parts.push_back(part);
    }
    all.push_back(parts);
  }
  take_signs(all);
  return all;
}

}  // namespace microswarm::vision::name_parts

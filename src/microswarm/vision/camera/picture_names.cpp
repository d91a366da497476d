// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/picture_names.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace microswarm::vision {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A run of digits or of other letters at the beginning of a text.
std::string_view first_run(std::string_view text) {
  const auto end =
      std::ranges::find_if(text, [&](char c) { return is_digit(c) != is_digit(text.front()); });
  return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

std::string_view without_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

/// A name as its runs, of which each second one is of digits.
std::vector<std::string> runs_of(const fs::path& file) {
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

std::optional<std::int64_t> to_number(std::string_view digits) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

/// The only run in which names of as many runs differ, which must be a number.
std::optional<std::size_t> varying_run(const std::vector<std::vector<std::string>>& names) {
  std::optional<std::size_t> varying;
  for (const auto& name : names) {
    if (name.size() != names.front().size()) return std::nullopt;
    for (std::size_t i = 0; i < name.size(); ++i) {
      if (name[i] == names.front()[i]) continue;
      if (i % 2 == 0 || varying.value_or(i) != i) return std::nullopt;
      varying = i;
    }
  }
  return varying;
}

}  // namespace

bool naturally_before(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    const std::string_view p = first_run(a), q = first_run(b);
    if (is_digit(p.front()) && is_digit(q.front())) {
      const std::string_view m = without_zeros(p), n = without_zeros(q);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else if (p != q) {
      return p < q;
    }
    a.remove_prefix(p.size());
    b.remove_prefix(q.size());
  }
  return a.size() < b.size();
}

void sort_naturally(std::vector<fs::path>& files) {
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const std::string p = a.stem().string(), q = b.stem().string();
    if (naturally_before(p, q)) return true;
    return !naturally_before(q, p) && a < b;
  });
}

std::optional<NumberedNames> numbers_in(const std::vector<fs::path>& files) {
  if (files.size() < 2) return std::nullopt;
  std::vector<std::vector<std::string>> names;
  names.reserve(files.size());
  for (const fs::path& file : files) names.push_back(runs_of(file));
  const std::optional<std::size_t> varying = varying_run(names);
  if (!varying) return std::nullopt;
  std::vector<std::int64_t> numbers, apart;
  for (const auto& name : names) {
    const std::optional<std::int64_t> number = to_number(name[*varying]);
    if (!number) return std::nullopt;
    if (!numbers.empty()) apart.push_back(*number - numbers.back());
    if (!apart.empty() && apart.back() <= 0) return std::nullopt;
    numbers.push_back(*number);
  }
  std::vector<std::int64_t> sorted = apart;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const std::int64_t step = *middle;
  NumberedNames found;
  for (std::size_t i = 0; i < files.size(); ++i) {
    found.steps.push_back(static_cast<double>(numbers[i] - numbers[0]) / static_cast<double>(step));
    if (i == 0 || apart[i - 1] == step) continue;
    if (found.gaps++ == 0)
      found.first_gap = files[i - 1].filename().string() + " and " + files[i].filename().string();
  }
  return found;
}

}  // namespace microswarm::vision

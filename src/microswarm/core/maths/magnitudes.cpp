// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/magnitudes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace microswarm {
namespace {

constexpr int buckets = 512;
constexpr int kept_bits = 5;  // of the mantissa: 32 buckets an octave

std::int64_t leading_bits(double v) {
  return static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(v) >> (52 - kept_bits));
}

}  // namespace

// Bits of positive numbers are in their order. Those more than 16 octaves below the greatest share
// the first bucket.
double median_of_magnitudes(std::span<const double> values) {
  if (values.empty()) return 0;
  const std::int64_t first =
      leading_bits(*std::max_element(values.begin(), values.end())) - (buckets - 1);
  const auto find_bucket = [&](double v) {
    return static_cast<std::size_t>(
        std::clamp<std::int64_t>(leading_bits(v) - first, 0, buckets - 1));
  };
  std::array<std::uint32_t, buckets> count{};
  for (const double v : values) ++count[find_bucket(v)];
  const std::size_t lower = (values.size() - 1) / 2;  // ranks of the two middle values
  const std::size_t upper = values.size() / 2;
  std::size_t before = 0;
  std::size_t bucket = 0;
  while (before + count[bucket] <= lower) before += count[bucket++];
  std::size_t last = bucket;
  for (std::size_t all = before + count[last]; all <= upper;) all += count[++last];
  std::vector<double> middle;
  middle.reserve(count[bucket] + count[last]);
  for (const double v : values)
    if (const std::size_t b = find_bucket(v); b == bucket || b == last) middle.push_back(v);
  const auto at = middle.begin() + static_cast<std::ptrdiff_t>(upper - before);
  std::nth_element(middle.begin(), at, middle.end());
  return lower == upper ? *at : std::midpoint(*std::max_element(middle.begin(), at), *at);
}

}  // namespace microswarm

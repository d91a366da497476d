// SPDX-License-Identifier: Apache-2.0
#include "microswarm/world/obstacles/contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm {
namespace {

constexpr int full_turn = 12;  // unit sectors

/// Solid whose corner at the origin spans `width` unit sectors, counter-clockwise from `start`.
/// Half a turn is an edge through the origin.
Polygon wedge(int start, int width, double size) {
  const auto at = [&](int k) {
    const Vec2 u =
        unit_vector(2 * pi * (k % (full_turn / 2)) / full_turn);  // opposite ones exactly
    return (k % full_turn < full_turn / 2 ? size : -size) * u;
  };
  Polygon out;
  for (int k = 0; k <= width; ++k) out.outer.push_back(at(start + k));
  if (2 * width != full_turn) out.outer.push_back({0, 0});
  return out;
}

/// Whether any direction is in both closed sectors.
bool share_a_direction(int start, int width, int other_start, int other_width) {
  for (int k = start; k <= start + width; ++k)
    for (int m = other_start; m <= other_start + other_width; ++m)
      if (k % full_turn == m % full_turn) return true;
  return false;
}

TEST(Contacts, CornersThatMeetOverlapIfTheyShareADirection) {
  for (int width = 1; width < full_turn; ++width)
    for (int other_width = 1; other_width < full_turn; ++other_width)
      for (int other_start = 0; other_start < full_turn; ++other_start) {
        const std::vector<Polygon> walls{wedge(3, width, 1), wedge(other_start, other_width, 2)};
        const auto contacts = find_contacts(walls, {});
        ASSERT_FALSE(contacts.empty());
        const bool overlap = std::any_of(contacts.begin(), contacts.end(),
                                         [](const Contact& c) { return c.overlap; });
        ASSERT_EQ(overlap, share_a_direction(3, width, other_start, other_width))
            << width << ", " << other_start << ": " << other_width;
      }
}

}  // namespace
}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/thinning.hpp"

#include <array>
#include <bit>
#include <vector>

namespace microswarm::vision {
namespace {

struct ThinCell {
  int column, row;
};

/// Whether a cell with these neighbours can be unset without joining or splitting anything: its
/// 8-connectivity number (Yokoi et al. 1975) is 1.
constexpr bool is_simple(unsigned around) {
  const auto unset = [&](int k) { return (around >> (k % 8) & 1U) == 0 ? 1 : 0; };
  int number = 0;
  for (int k = 0; k < 8; k += 2) number += unset(k) - unset(k) * unset(k + 1) * unset(k + 2);
  return number == 1;
}

constexpr std::array<bool, 256> removable_table() {
  std::array<bool, 256> table{};
  for (unsigned n = 0; n < 256; ++n) table[n] = std::popcount(n) > 1 && is_simple(n);
  return table;
}

}  // namespace

unsigned set_neighbours(const formats::Mask& mask, int column, int row) {
  unsigned bits = 0;
  for (int k = 0; k < 8; ++k) {
    const int c = column + neighbour_columns[k];
    const int r = row + neighbour_rows[k];
    if (c >= 0 && r >= 0 && c < mask.width && r < mask.height && mask.at(c, r))
      bits |= 1U << static_cast<unsigned>(k);
  }
  return bits;
}

void thin(formats::Mask& mask, const Stop& stop) {
  static constexpr std::array<bool, 256> removable = removable_table();
  std::vector<ThinCell> left;
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column)
      if (mask.at(column, row)) left.push_back({column, row});
  for (bool changed = true; changed && !stop();) {
    changed = false;
    for (const unsigned side : {2U, 6U, 0U, 4U}) {
      std::vector<ThinCell> border;
      for (const ThinCell c : left) {
        const unsigned n = set_neighbours(mask, c.column, c.row);
        if ((n >> side & 1U) == 0 && removable[n]) border.push_back(c);
      }
      for (const ThinCell c : border) {
        if (!removable[set_neighbours(mask, c.column, c.row)]) continue;
        mask.at(c.column, c.row) = 0;
        changed = true;
      }
      std::erase_if(left, [&](ThinCell c) { return !mask.at(c.column, c.row); });
    }
  }
}

}  // namespace microswarm::vision

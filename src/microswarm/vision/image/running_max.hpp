// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace microswarm {

/// The highest value in the square around each pixel: `side` pixels wide, of which (side − 1) / 2
/// lie before the pixel (left of it, above it); beyond the border is 0. Working rows are kept.
class RunningMax {
 public:
  explicit RunningMax(int side) : side_(side) {}
  /// `in` and `out` hold width · height values and are not the same.
  void run(const std::vector<std::uint8_t>& in, int width, int height,
           std::vector<std::uint8_t>& out);

 private:
  void run_row(const std::uint8_t* in, int width, std::uint8_t* out);

  int side_;
  std::vector<std::uint8_t> margins_;  ///< a row with zeros at both ends
  std::vector<std::uint8_t> across_;   ///< rows of highest values, a row of zeros before and after
};

}  // namespace microswarm

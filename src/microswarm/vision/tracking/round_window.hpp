// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace microswarm::vision {

/// Sums over the pixels of a picture within a radius of one of them, as whole numbers.
class RoundWindow {
 public:
  /// Rows are read in pieces of this length, so up to as many bytes after the window.
  static constexpr int read_beyond = 32;

  struct Moments {
    std::int64_t mass = 0;                  ///< Σ value
    std::int64_t along_x = 0, along_y = 0;  ///< Σ value · offset from the middle
  };

  explicit RoundWindow(int radius);

  /// `middle` is the pixel in the middle, `stride` the distance of rows.
  Moments moments(const std::uint8_t* middle, std::ptrdiff_t stride) const;

 private:
  int radius_;
  int pieces_;                      ///< of a row
  std::vector<std::uint8_t> mask_;  ///< 255 in the window, by piece, row and column
};

}  // namespace microswarm::vision

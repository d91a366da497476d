// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/round_window.hpp"

#include "microswarm/core/execution/each_cpu.hpp"

namespace microswarm::vision {
namespace {

constexpr int lanes = RoundWindow::read_beyond;

/// Sums over a piece of the window, far below 2^32 for radii up to 500.
struct PieceSums {
  std::uint32_t mass = 0;     ///< Σ value
  std::uint32_t along_x = 0;  ///< Σ value · column
  std::uint32_t along_y = 0;  ///< Σ value · rows from the first to it
};

/// From the last row upwards: a value is once more in the sum down its column for each row above.
MICROSWARM_EACH_CPU PieceSums sum_piece(const std::uint8_t* last_row, std::ptrdiff_t stride,
                                        const std::uint8_t* mask, int rows) {
  std::uint32_t sum[lanes] = {};
  std::uint32_t sums[lanes] = {};
  for (int row = rows - 1; row >= 0; --row) {
    const std::uint8_t* in = mask + static_cast<std::ptrdiff_t>(row) * lanes;
    for (int k = 0; k < lanes; ++k) sum[k] += static_cast<std::uint32_t>(last_row[k] & in[k]);
    for (int k = 0; k < lanes; ++k) sums[k] += sum[k];
    last_row -= stride;
  }
  PieceSums out;
  for (std::uint32_t k = 0; k < lanes; ++k) {
    out.mass += sum[k];
    out.along_x += k * sum[k];
    out.along_y += sums[k];
  }
  return out;
}

}  // namespace

RoundWindow::RoundWindow(int radius) : radius_(radius), pieces_(2 * radius / lanes + 1) {
  for (int first = -radius; first <= radius; first += lanes)
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = first; dx < first + lanes; ++dx)
        mask_.push_back(dx * dx + dy * dy <= radius * radius ? 255 : 0);
}

RoundWindow::Moments RoundWindow::moments(const std::uint8_t* middle, std::ptrdiff_t stride) const {
  const int rows = 2 * radius_ + 1;
  Moments out;
  for (int p = 0; p < pieces_; ++p) {
    const int first = p * lanes - radius_;
    const PieceSums piece =
        sum_piece(middle + radius_ * stride + first, stride,
                  mask_.data() + static_cast<std::ptrdiff_t>(p) * rows * lanes, rows);
    out.mass += piece.mass;
    out.along_x += piece.along_x + static_cast<std::int64_t>(first) * piece.mass;
    out.along_y += piece.along_y;
  }
  out.along_y -= out.mass * (radius_ + 1);
  return out;
}

}  // namespace microswarm::vision

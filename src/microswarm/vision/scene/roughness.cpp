// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <vector>

#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/vision/scene/blob_search.hpp"

namespace microswarm::vision {
namespace {

/// Repeats each value `side` times.
template <int side>
void widen(const std::uint8_t* in, int count, std::uint8_t* out) {
  for (int x = 0; x < count; ++x)
    for (int k = 0; k < side; ++k) out[side * x + k] = in[x];
}

/// Squared differences of neighbours in a row, of those of `count` <= 32,768 pixels that are
/// chosen.
MICROSWARM_EACH_CPU int sum_squares(const std::uint8_t* row, const std::uint8_t* chosen,
                                    int count) {
  int sum = 0;
  for (int x = 0; x < count; ++x) {
    const auto step = static_cast<std::int16_t>(row[x + 1] - row[x]);
    const auto counted = static_cast<std::int16_t>(chosen[x] != 0 ? step : 0);
    sum += counted * counted;
  }
  return sum;
}

}  // namespace

double roughness(const BlobContext& field, const cv::Rect& box, const cv::Mat& chosen, int step) {
  constexpr int piece = 32'768;  // pixels whose squares fit into an int
  const int side = field.side;
  const int first = side * box.x;
  const int count = std::min(side * box.br().x, field.fine.cols - 1) - first;
  const int whole = std::max(0, count) / side;  // working pixels
  const auto widen_row = side == 4 ? widen<4> : side == 2 ? widen<2> : widen<1>;
  std::vector<std::uint8_t> wide(static_cast<std::size_t>(side * box.width));
  double sum = 0;
  double all = 0;
  for (int y = 0; y < box.height; y += step) {
    const auto* row =
        field.fine.ptr<std::uint8_t>(std::min(side * (box.y + y), field.fine.rows - 1));
    const auto* in = chosen.ptr<std::uint8_t>(y);
    widen_row(in, box.width, wide.data());
    for (int x = 0; x < count; x += piece)
      sum += sum_squares(row + first + x, wide.data() + x, std::min(piece, count - x));
    const auto set = std::count_if(in, in + whole, [](std::uint8_t v) { return v != 0; });
    all += static_cast<double>(side * set);
    if (count > side * whole && in[whole] != 0) all += count - side * whole;
  }
  return all > 0 ? sum / all : 0;
}

}  // namespace microswarm::vision

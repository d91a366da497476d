// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/image/running_max.hpp"

#include <algorithm>
#include <cstddef>

#include "microswarm/core/each_cpu.hpp"

namespace microswarm {
namespace {

MICROSWARM_EACH_CPU void raise(std::uint8_t* values, const std::uint8_t* others,
                               std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) values[i] = std::max(values[i], others[i]);
}

}  // namespace

void RunningMax::run(const std::vector<std::uint8_t>& in, int width, int height,
                     std::vector<std::uint8_t>& out) {
  const auto w = static_cast<std::size_t>(width);
  const int before = (side_ - 1) / 2;
  const auto rows = static_cast<std::size_t>(height + side_ - 1);
  // Rows of maxima across, with rows of 0 above and below; each window of rows then doubles.
  across_.assign(rows * w, 0);
  for (int y = 0; y < height; ++y)
    run_row(in.data() + y * w, width, across_.data() + (y + before) * w);
  int size = 1;
  for (; 2 * size <= side_; size *= 2)
    raise(across_.data(), across_.data() + size * w, (rows - 2 * size + 1) * w);
  out.assign(across_.begin(), across_.begin() + static_cast<std::ptrdiff_t>(height * w));
  raise(out.data(), across_.data() + (side_ - size) * w, height * w);
}

void RunningMax::run_row(const std::uint8_t* in, int width, std::uint8_t* out) {
  const int before = (side_ - 1) / 2;
  const std::size_t length = static_cast<std::size_t>(width + side_ - 1);
  margins_.assign(length, 0);
  std::copy_n(in, width, margins_.begin() + before);
  int size = 1;
  for (; 2 * size <= side_; size *= 2)
    raise(margins_.data(), margins_.data() + size, length - 2 * size + 1);
  std::copy_n(margins_.begin(), width, out);
  raise(out, margins_.data() + side_ - size, static_cast<std::size_t>(width));
}

}  // namespace microswarm

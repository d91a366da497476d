// SPDX-License-Identifier: Apache-2.0
// Frames that no two have in common.
#pragma once

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/vision/camera/frames.hpp"

namespace microswarm::test {

/// A frame of random samples; the same for the same index.
inline vision::VideoFrame noise(int index, int width, int height, int channels) {
  Rng rng(1, Purpose::test, index);
  vision::VideoFrame frame{.index = index, .t = 0, .picture = {width, height, channels, {}}};
  frame.picture.pixels.resize(frame.picture.index(0, height));
  for (auto& sample : frame.picture.pixels) sample = static_cast<std::uint8_t>(rng.uniform(0, 256));
  return frame;
}

}  // namespace microswarm::test

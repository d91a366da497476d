// SPDX-License-Identifier: Apache-2.0
// Data of a camera: they become a picture of the right size, or are refused in one line. The first
// byte is the format, the next two are width and height, the fourth is what a line has too many.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/camera/raw_pixels.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  if (size < 4) return 0;
  constexpr auto formats = vision::enum_names(vision::PixelFormat{});
  vision::RawPicture raw{.format = formats[data[0] % formats.size()].first,
                         .width = 1 + data[1],
                         .height = 1 + data[2],
                         .bytes_per_line = 0,
                         .bytes = std::as_bytes(std::span(data + 4, size - 4))};
  if (data[3] > 0) raw.bytes_per_line = static_cast<std::size_t>(3 * raw.width + data[3]);
  formats::Image image;
  try {
    vision::take_raw(raw, "/dev/video0", image);
    if (image.width != raw.width || image.height != raw.height ||
        image.pixels.size() != image.index(0, image.height))
      std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}

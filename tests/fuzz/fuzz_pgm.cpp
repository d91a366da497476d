// SPDX-License-Identifier: Apache-2.0
// Pictures of every kind, Netpbm above all: what is read has all its pixels and can be traced.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/formats/images/pnm.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  try {
    const formats::Image image =
        formats::decode_image(std::as_bytes(std::span(data, size)), "fuzz.pgm");
    if (image.width < 1 || image.height < 1 || image.pixels.size() != image.index(0, image.height))
      std::abort();
    const std::string text = formats::encode_pnm(image);
    if (formats::decode_image(std::as_bytes(std::span(text)), "again.pgm").pixels != image.pixels)
      std::abort();
    formats::mask_walls(formats::threshold(image, 128, true), 1);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}

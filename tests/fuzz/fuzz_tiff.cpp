// SPDX-License-Identifier: Apache-2.0
// TIFFs and the descriptions in them: every page is a picture of its size, or one line says why
// not.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/images/samples.hpp"
#include "microswarm/formats/images/tiff.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  constexpr int most = 8;  // pages read
  try {
    formats::TiffPages pages(std::as_bytes(std::span(data, size)), "fuzz.tif");
    for (int k = 0; k < std::min(pages.count(), most); ++k) {
      formats::DecodedImage page = pages.next();
      const formats::GreyScale scale = formats::scale_of(page);
      formats::Image image;
      formats::take_pixels(std::move(page), scale, image);
      if (image.pixels.size() != image.index(0, image.height) || image.pixels.empty()) std::abort();
    }
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto told = formats::parse_tiff_description(text, 2, 2);
  if (told.images < 1 || told.channels < 1 || told.slices < 1 || told.times < 1 ||
      told.order.size() != 3 || (told.um_per_px && !(*told.um_per_px > 0)))
    std::abort();
  return 0;
}

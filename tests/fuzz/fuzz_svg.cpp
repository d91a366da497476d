// SPDX-License-Identifier: Apache-2.0
// Drawings in SVG, of 100 pixels at most: drawn, or refused in one line.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/svg/renderer.hpp"
#include "microswarm/formats/svg/svg.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const formats::SvgSize measured = formats::svg_renderer().measure(text);
    const double side = measured.width > measured.height ? measured.width : measured.height;
    const auto drawn = formats::draw_svg(text, "fuzz.svg", 1.0, side / 100);
    const auto pixels = static_cast<std::size_t>(drawn.image.width * drawn.image.height);
    if (drawn.image.pixels.size() != pixels) std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}

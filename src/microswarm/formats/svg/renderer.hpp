// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::formats {

// SVG by librsvg, which depends on some 40 shared libraries: a module that is loaded at the first
// use.

/// Size of a drawing.
struct SvgSize {
  double width = 0;  ///< [units of the drawing]: of its viewBox, else px
  double height = 0;
  std::optional<double> width_um{};  ///< if width and height are given in mm, cm, in, pt or pc
  std::optional<double> height_um{};
  std::string error{};  ///< why it cannot be read; empty if it can
};

/// Grey pixels of a drawing in front of white, row by row from the top.
struct SvgPixels {
  std::vector<std::uint8_t> grey{};  ///< columns · rows
  std::string error{};               ///< why it cannot be drawn; empty if it can
};

/// Interface of the module. Reads no other files, and no network.
class SvgRenderer {
 public:
  virtual ~SvgRenderer() = default;
  virtual SvgSize measure(std::string_view svg) const = 0;
  /// Draws it so that it fills `width` × `height` pixels, which need not be whole, from the top
  /// left corner of `columns` × `rows` pixels.
  virtual SvgPixels draw(std::string_view svg, double width, double height, int columns,
                         int rows) const = 0;
};

/// The module, loaded by the first call. Throws InputError if it cannot be loaded.
const SvgRenderer& svg_renderer();

}  // namespace microswarm::formats

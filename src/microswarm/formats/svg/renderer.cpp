// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/svg/renderer.hpp"

#include "microswarm/core/execution/module.hpp"

namespace microswarm::formats {

const SvgRenderer& svg_renderer() {
  static const SvgRenderer& loaded =
      *reinterpret_cast<const SvgRenderer* (*)()>(load_module("svg", "maps in SVG"))();
  return loaded;
}

}  // namespace microswarm::formats

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/media/media.hpp"

#include "microswarm/core/execution/module.hpp"

namespace microswarm::formats {

const Media& media() {
  static const Media& loaded =
      *reinterpret_cast<const Media* (*)()>(load_module("media", "videos, JPEG and BMP"))();
  return loaded;
}

}  // namespace microswarm::formats

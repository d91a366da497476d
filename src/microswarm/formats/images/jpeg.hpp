// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/formats/images/image.hpp"

namespace microswarm {

/// Decodes a JPEG of a camera's stream into `image`, grey or in colours, whose memory is used
/// again. Its Huffman tables may be missing. A frame that is cut or damaged is an error; bytes too
/// many before its end, which some cameras add, are none. Throws InputError "NAME: WHY".
void decode_jpeg_frame(std::span<const std::byte> bytes, std::string_view name, Image& image);

/// A JPEG of the image, `quality` 1 to 100. Throws InputError if it cannot be made.
std::string encode_jpeg(const Image& image, int quality);

}  // namespace microswarm

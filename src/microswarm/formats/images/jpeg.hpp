// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::formats {

/// Decodes a JPEG of a camera's stream into `image`, grey or colour, reusing its memory. Its
/// Huffman tables may be missing. A truncated or damaged frame is an error; surplus bytes before
/// its end, which some cameras add, are accepted. Throws InputError "NAME: WHY".
void decode_jpeg_frame(std::span<const std::byte> bytes, std::string_view name, Image& image);

/// Encodes an image as JPEG, `quality` 1 to 100. Throws InputError on failure.
std::string encode_jpeg(const Image& image, int quality);

}  // namespace microswarm::formats

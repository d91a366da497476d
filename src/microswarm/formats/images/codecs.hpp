// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/formats/images/deep_image.hpp"

namespace microswarm::formats {

/// Whether the bytes begin with a PNG's signature.
bool is_png(std::span<const std::byte> bytes);

/// Pixels of a PNG, JPEG, BMP, or of the first page of a TIFF: one channel (grey) or three (red,
/// green, blue) of 8 or 16 bits, composed over white. Strict: a warning of the decoder, a wrong
/// checksum and a truncated file are errors, and the size is checked before decoding. A picture is
/// turned by its EXIF or its TIFF's orientation; a BMP always has three channels. Throws
/// InputError "NAME: WHY".
DecodedImage decode_pixels(std::span<const std::byte> bytes, std::string_view name);

/// Pixels of a picture file of any kind that read_image takes; throws as it.
DecodedImage read_stored(const std::filesystem::path& path);

/// 1 for each pixel of a PNG or TIFF that is not opaque, else 0; empty for a picture without
/// transparency. Throws as `decode_pixels`.
std::vector<std::uint8_t> transparency(std::span<const std::byte> bytes, std::string_view name);

/// Encodes an image as an 8-bit PNG. Throws InputError "cannot encode a PNG: WHY".
std::string encode_png(const Image& image);

}  // namespace microswarm::formats

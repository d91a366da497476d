// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace cv {
class Mat;
}  // namespace cv

namespace microswarm {

/// Whether the bytes begin as a PNG does.
bool is_png(std::span<const std::byte> bytes);

/// Pixels of a PNG, JPEG or BMP: one channel (grey) or three (red, green, blue) of 8 or 16 bits,
/// transparency in front of white. Strict: a warning of the decoder, a wrong checksum and a file
/// that ends early are errors, and the size is checked before anything is decoded. A JPEG is turned
/// as its EXIF says; a BMP has three channels always. Throws InputError "NAME: WHY".
cv::Mat decode_pixels(std::span<const std::byte> bytes, std::string_view name);

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace microswarm {

/// Image formats that are read.
enum class ImageKind : std::uint8_t { png, jpeg, bmp, pnm };

/// Header of an image.
struct ImageHeader {
  ImageKind kind = ImageKind::png;
  std::int64_t width = 0;
  std::int64_t height = 0;
  bool grey = false;  ///< one channel suffices: neither palette nor colours
};

/// Throws InputError "NAME: 20000 × 20000 pixels, at most …" if a side is 0 or exceeds the limits
/// of image.hpp, which also hold for maps in cells.
void check_image_size(std::int64_t width, std::int64_t height, std::string_view name,
                      std::string_view unit = "pixels");

/// Reads the header and checks that the file is structurally complete: chunks and their checksums
/// up to IEND in PNG, segments up to EOI in JPEG, the declared rows in BMP. Netpbm files are only
/// recognised. Throws InputError "NAME: WHY".
ImageHeader check_image(std::span<const std::byte> bytes, std::string_view name);

/// A complete PNG without the chunks that do not affect its pixels (texts, colour profiles, times),
/// about which decoders complain on stderr.
std::string pixel_chunks(std::span<const std::byte> png);

}  // namespace microswarm

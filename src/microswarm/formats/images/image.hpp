// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace microswarm::formats {

/// Image with 8 bits per sample: row by row, y down, `channels` 1 (grey) or 3 (red, green, blue).
struct Image {
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<std::uint8_t> pixels;  ///< width · height · channels samples

  std::size_t index(int column, int row) const {
    return (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(column)) *
           static_cast<std::size_t>(channels);
  }
};

/// Limits of images read: length of a side and total number of pixels.
inline constexpr int max_image_side = 16384;
inline constexpr std::int64_t max_image_pixels = 64'000'000;

/// Throws InputError "NAME: 20000 × 20000 pixels, at most …" when a side is 0 or above these
/// limits; maps in cells keep them too.
void check_image_size(std::int64_t width, std::int64_t height, std::string_view name,
                      std::string_view unit = "pixels");

/// Reads PNG, JPEG, BMP, TIFF (its first page), PGM, PPM or PBM: deeper samples are scaled to 8
/// bits, those of PNG and TIFF as numbers of `depth` bits (8 to 16; what is larger becomes white),
/// palettes and 1-bit pictures expanded, a PNG composed over white. The structure
/// is checked before anything is decoded; throws InputError "x.png: WHY" for no file, an empty one,
/// no image, a truncated or damaged one, 0 pixels, or more than max_image_side or max_image_pixels.
Image read_image(const std::filesystem::path& path, int depth = 16);

/// The same from memory; `name` replaces the file's name in messages.
Image decode_image(std::span<const std::byte> bytes, std::string_view name, int depth = 16);

/// Extensions of the files that read_image takes, in small letters.
inline constexpr std::array<std::string_view, 10> image_extensions{
    ".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm", ".ppm", ".pbm", ".pnm"};
bool has_image_extension(const std::filesystem::path& path);

/// 1 for each pixel of a PNG that is not opaque, else 0; empty for a picture without transparency.
/// Throws as `read_image`.
std::vector<std::uint8_t> read_transparency(const std::filesystem::path& path);

/// Bits, 8 to 16, that the largest sample of a PNG or TIFF with more than 8 bits needs; nothing for
/// another picture or file. Throws as `read_image` for a damaged one.
std::optional<int> sample_depth(const std::filesystem::path& path);

/// Reads a camera image. The depth of a 16-bit picture is taken from its largest sample, 12 bits
/// for many cameras. Throws as `read_image`.
Image read_photograph(const std::filesystem::path& path);

/// The image as one grey channel. The luma of a colour is 0.299 R + 0.587 G + 0.114 B, rounded.
Image to_grey(const Image& image);

/// Writes an 8-bit PNG through a temporary file. Throws InputError "PATH: cannot write: REASON".
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace microswarm::formats

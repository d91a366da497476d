// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::formats {

/// Image with 8 bits per sample: row by row, y down, `channels` 1 (grey) or 3 (red, green, blue).
struct Image {
  int width = 0;
  int height = 0;
  int channels = 1;
  std::vector<std::uint8_t> pixels{};  ///< width · height · channels samples

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
/// bits, those of PNG and TIFF as numbers of `depth` bits (8 to 16; what is larger becomes white;
/// signed, floating and 32-bit ones from the smallest to the largest),
/// palettes and 1-bit pictures expanded, a PNG or TIFF composed over white. The structure
/// is checked before anything is decoded; throws InputError "x.png: WHY" for no file, an empty one,
/// no image, a truncated or damaged one, 0 pixels, or more than max_image_side or max_image_pixels.
Image read_image(const std::filesystem::path& path, int depth = 16);

/// The same from memory; `name` replaces the file's name in messages.
Image decode_image(std::span<const std::byte> bytes, std::string_view name, int depth = 16);

/// Extensions of the files that read_image takes, in small letters.
inline constexpr std::array<std::string_view, 10> image_extensions{
    ".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm", ".ppm", ".pbm", ".pnm"};
bool has_image_extension(const std::filesystem::path& path);

/// 1 for each pixel of a PNG or TIFF that is not opaque, else 0; empty for a picture without
/// transparency. Throws as `read_image`.
std::vector<std::uint8_t> read_transparency(const std::filesystem::path& path);

/// A picture of a camera, and what was assumed in reading it.
struct ReadPicture {
  Image image{};
  double black = 0;                   ///< sample of the file that became 0
  double white = 255;                 ///< sample of the file that became 255
  std::optional<double> um_per_px{};  ///< by a description of ImageJ or OME
  std::vector<std::string> notes{};   ///< "FILE: its 16-bit samples are read as …", for people
};

/// Reads a camera image of any depth and scales its samples to 8 bits: those of 9 to 16 bits are
/// numbers of as many bits as the largest needs, 12 for many cameras; signed and floating ones, and
/// those of 32 bits, reach from the smallest to the largest. Throws as `read_image`.
ReadPicture read_picture(const std::filesystem::path& path);

/// The image of `read_picture`.
Image read_photograph(const std::filesystem::path& path);

/// The image as one grey channel. The luma of a colour is 0.299 R + 0.587 G + 0.114 B, rounded.
Image to_grey(const Image& image);

/// Writes an 8-bit PNG through a temporary file. Throws InputError "PATH: cannot write: REASON".
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace microswarm::formats

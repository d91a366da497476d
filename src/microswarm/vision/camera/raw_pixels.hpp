// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "microswarm/formats/images/image.hpp"

namespace microswarm {

/// Formats of a camera's data that can be read, by their V4L2 names.
enum class PixelFormat {
  mjpg,
  jpeg,
  yuyv,
  uyvy,
  nv12,
  grey,
  y10,
  y12,
  y16,
  rgb3,
  bgr3,
  rggb,  ///< Bayer, 8 bits, by its first four pixels
  grbg,
  gbrg,
  bggr
};
constexpr auto enum_names(PixelFormat) {
  return std::array<std::pair<PixelFormat, std::string_view>, 15>{{{PixelFormat::mjpg, "MJPG"},
                                                                   {PixelFormat::jpeg, "JPEG"},
                                                                   {PixelFormat::yuyv, "YUYV"},
                                                                   {PixelFormat::uyvy, "UYVY"},
                                                                   {PixelFormat::nv12, "NV12"},
                                                                   {PixelFormat::grey, "GREY"},
                                                                   {PixelFormat::y10, "Y10"},
                                                                   {PixelFormat::y12, "Y12"},
                                                                   {PixelFormat::y16, "Y16"},
                                                                   {PixelFormat::rgb3, "RGB3"},
                                                                   {PixelFormat::bgr3, "BGR3"},
                                                                   {PixelFormat::rggb, "RGGB"},
                                                                   {PixelFormat::grbg, "GRBG"},
                                                                   {PixelFormat::gbrg, "GBRG"},
                                                                   {PixelFormat::bggr, "BA81"}}};
}

/// Four letters in a number, as V4L2 names formats; shorter names end in spaces.
std::uint32_t fourcc_of(PixelFormat format);
/// The format of these letters, if it can be read.
std::optional<PixelFormat> format_of(std::uint32_t fourcc);
/// The letters without spaces at the end; what cannot be printed is "?".
std::string fourcc_text(std::uint32_t fourcc);

/// Data of a picture as they came from a camera.
struct RawPicture {
  PixelFormat format = PixelFormat::grey;
  int width = 0;
  int height = 0;
  std::size_t bytes_per_line = 0;  ///< 0: rows without gaps
  std::span<const std::byte> bytes;
  std::string_view damage;  ///< what is wrong with them, where the device tells
};

/// Turns the data into grey (GREY, Y10, Y12, Y16, a grey JPEG) or colours, in `image`, whose memory
/// is used again. Colours of Bayer are interpolated between neighbours. Samples of 10, 12 and 16
/// bits keep their upper 8. Throws InputError "NAME: WHY" when data are missing, or a JPEG is
/// damaged or of another size.
void take_raw(const RawPicture& raw, std::string_view name, Image& image);

}  // namespace microswarm

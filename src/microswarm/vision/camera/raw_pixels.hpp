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

namespace microswarm::vision {

/// Supported formats of camera data, by their V4L2 names.
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
  rggb,  ///< Bayer, 8 bits, named by its first four pixels
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

/// V4L2 code of a format: four letters in a number, padded with spaces.
std::uint32_t to_fourcc(PixelFormat format);
/// Format of a V4L2 code, if supported.
std::optional<PixelFormat> find_format(std::uint32_t fourcc);
/// Letters of a V4L2 code without trailing spaces; unprintable ones become "?".
std::string fourcc_text(std::uint32_t fourcc);

/// Data of a picture as received from a camera.
struct RawPicture {
  PixelFormat format = PixelFormat::grey;
  int width = 0;
  int height = 0;
  std::size_t bytes_per_line = 0;  ///< 0: rows without gaps
  std::span<const std::byte> bytes{};
  std::string_view damage{};  ///< error reported by the device; empty without one
};

/// Converts the data into a grey (GREY, Y10, Y12, Y16, a grey JPEG) or colour `image`, reusing its
/// memory. Bayer colours are interpolated from neighbours. Samples of 10, 12 and 16 bits keep their
/// upper 8. Throws InputError "NAME: WHY" if data is missing or a JPEG is damaged or has another
/// size.
void take_raw(const RawPicture& raw, std::string_view name, formats::Image& image);

}  // namespace microswarm::vision

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
enum class PixelFormat { mjpg, jpeg, yuyv, uyvy, nv12, grey, y10, y12, y16, rgb3, bgr3 };
constexpr auto enum_names(PixelFormat) {
  return std::array<std::pair<PixelFormat, std::string_view>, 11>{{{PixelFormat::mjpg, "MJPG"},
                                                                   {PixelFormat::jpeg, "JPEG"},
                                                                   {PixelFormat::yuyv, "YUYV"},
                                                                   {PixelFormat::uyvy, "UYVY"},
                                                                   {PixelFormat::nv12, "NV12"},
                                                                   {PixelFormat::grey, "GREY"},
                                                                   {PixelFormat::y10, "Y10"},
                                                                   {PixelFormat::y12, "Y12"},
                                                                   {PixelFormat::y16, "Y16"},
                                                                   {PixelFormat::rgb3, "RGB3"},
                                                                   {PixelFormat::bgr3, "BGR3"}}};
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
};

/// Turns the data into grey (GREY, Y10, Y12, Y16, a grey JPEG) or colours, in `image`, whose memory
/// is used again. Samples of 10, 12 and 16 bits keep their upper 8. Throws InputError "NAME: WHY"
/// when data are missing, or a JPEG is damaged or of another size.
void take_raw(const RawPicture& raw, std::string_view name, Image& image);

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/raw_pixels.hpp"

#include <opencv2/imgproc.hpp>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/jpeg.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm::vision {
namespace {

bool is_bayer(PixelFormat format) {
  return format == PixelFormat::rggb || format == PixelFormat::grbg ||
         format == PixelFormat::gbrg || format == PixelFormat::bggr;
}

bool is_jpeg(PixelFormat format) {
  return format == PixelFormat::mjpg || format == PixelFormat::jpeg;
}

std::size_t bytes_of_pixel(PixelFormat format) {
  switch (format) {
    case PixelFormat::yuyv:
    case PixelFormat::uyvy:
    case PixelFormat::y10:
    case PixelFormat::y12:
    case PixelFormat::y16:
      return 2;
    case PixelFormat::rgb3:
    case PixelFormat::bgr3:
      return 3;
    case PixelFormat::mjpg:
    case PixelFormat::jpeg:
    case PixelFormat::nv12:
    case PixelFormat::grey:
    case PixelFormat::rggb:
    case PixelFormat::grbg:
    case PixelFormat::gbrg:
    case PixelFormat::bggr:
      return 1;
  }
  return 0;
}

/// OpenCV's code of the conversion to red, green, blue; -1 for a copy.
int colour_conversion(PixelFormat format) {
  switch (format) {
    case PixelFormat::yuyv:
      return cv::COLOR_YUV2RGB_YUYV;
    case PixelFormat::uyvy:
      return cv::COLOR_YUV2RGB_UYVY;
    case PixelFormat::bgr3:
      return cv::COLOR_BGR2RGB;
    case PixelFormat::rggb:
      return cv::COLOR_BayerRGGB2RGB;
    case PixelFormat::grbg:
      return cv::COLOR_BayerGRBG2RGB;
    case PixelFormat::gbrg:
      return cv::COLOR_BayerGBRG2RGB;
    case PixelFormat::bggr:
      return cv::COLOR_BayerBGGR2RGB;
    case PixelFormat::mjpg:
    case PixelFormat::jpeg:
    case PixelFormat::nv12:
    case PixelFormat::grey:
    case PixelFormat::y10:
    case PixelFormat::y12:
    case PixelFormat::y16:
    case PixelFormat::rgb3:
      return -1;
  }
  return -1;
}

int bit_depth(PixelFormat format) {
  return format == PixelFormat::y10 ? 10 : format == PixelFormat::y12 ? 12 : 16;
}

void take_deep(const cv::Mat& samples, int bits, cv::Mat& out) {
  for (int row = 0; row < samples.rows; ++row) {
    const auto* in = samples.ptr<std::uint8_t>(row);  // little-endian
    auto* grey = out.ptr<std::uint8_t>(row);
    for (int column = 0; column < samples.cols; ++column) {
      const int sample = in[2 * column] | in[2 * column + 1] << 8;
      grey[column] = cv::saturate_cast<std::uint8_t>(sample >> (bits - 8));
    }
  }
}

void convert(const RawPicture& raw, std::size_t step, formats::Image& image) {
  auto* data = const_cast<std::byte*>(raw.bytes.data());
  cv::Mat out = as_mat(image);
  const auto rows = [&](int type) { return cv::Mat(raw.height, raw.width, type, data, step); };
  switch (raw.format) {
    case PixelFormat::y10:
    case PixelFormat::y12:
    case PixelFormat::y16:
      return take_deep(rows(CV_8UC2), bit_depth(raw.format), out);
    case PixelFormat::nv12: {
      const cv::Mat colours(raw.height / 2, raw.width / 2, CV_8UC2,
                            data + step * static_cast<std::size_t>(raw.height), step);
      return cv::cvtColorTwoPlane(rows(CV_8UC1), colours, out, cv::COLOR_YUV2RGB_NV12);
    }
    default: {
      const cv::Mat in = rows(CV_8UC(static_cast<int>(bytes_of_pixel(raw.format))));
      const int how = colour_conversion(raw.format);
      if (how < 0)
        in.copyTo(out);
      else
        cv::cvtColor(in, out, how);
    }
  }
}

}  // namespace

std::uint32_t to_fourcc(PixelFormat format) {
  std::uint32_t code = 0;
  const std::string_view name = enum_name(format);
  for (std::size_t i = 4; i-- > 0;)
    code = code << 8 | static_cast<unsigned char>(i < name.size() ? name[i] : ' ');
  return code;
}

std::optional<PixelFormat> find_format(std::uint32_t fourcc) {
  for (const auto& [format, name] : enum_names(PixelFormat{}))
    if (to_fourcc(format) == fourcc) return format;
  return std::nullopt;
}

std::string fourcc_text(std::uint32_t fourcc) {
  std::string text;
  for (int i = 0; i < 4; ++i, fourcc >>= 8) {
    const auto letter = static_cast<char>(fourcc & 0x7f);
    text += letter >= ' ' && letter < 0x7f ? letter : '?';
  }
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

void take_raw(const RawPicture& raw, std::string_view name, formats::Image& image) {
  const auto fail = [&](const std::string& why) { throw InputError(std::string(name), why); };
  if (is_jpeg(raw.format)) {
    formats::decode_jpeg_frame(raw.bytes, name, image);
    if (image.width != raw.width || image.height != raw.height)
      fail("a JPEG of " + std::to_string(image.width) + "x" + std::to_string(image.height) +
           " pixels among pictures of " + std::to_string(raw.width) + "x" +
           std::to_string(raw.height));
    return;
  }
  const bool nv12 = raw.format == PixelFormat::nv12;
  const bool bayer = is_bayer(raw.format);
  const bool pairs = nv12 || raw.format == PixelFormat::yuyv || raw.format == PixelFormat::uyvy;
  if ((pairs && raw.width % 2 != 0) || (nv12 && raw.height % 2 != 0))
    fail(std::string(enum_name(raw.format)) + " with an odd number of pixels");
  if (bayer && std::min(raw.width, raw.height) < 4) fail("a Bayer pattern of less than 4x4 pixels");
  const std::size_t line = static_cast<std::size_t>(raw.width) * bytes_of_pixel(raw.format);
  const std::size_t step = std::max(raw.bytes_per_line, line);
  const auto lines = static_cast<std::size_t>(nv12 ? raw.height * 3 / 2 : raw.height);
  const std::size_t needed = step * (lines - 1) + line;
  if (raw.bytes.size() < needed)
    fail("only " + std::to_string(raw.bytes.size()) + " of " + std::to_string(needed) +
         " bytes of a picture came");
  const bool colours = pairs || bayer || bytes_of_pixel(raw.format) == 3;
  image.width = raw.width;
  image.height = raw.height;
  image.channels = colours ? 3 : 1;
  image.pixels.resize(image.index(0, image.height));
  convert(raw, step, image);
}

}  // namespace microswarm::vision

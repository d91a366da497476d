// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/image.hpp"

#include <algorithm>
#include <bit>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/formats/images/image_header.hpp"
#include "microswarm/formats/images/pnm.hpp"

namespace microswarm {
namespace {

constexpr std::uint64_t max_file_bytes = 512ULL << 20;

/// Pixels as decoded by OpenCV, one or three channels of 8 or 16 bits; empty if decoding fails.
cv::Mat decoded(std::string_view bytes) {
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  try {
    return cv::imdecode(raw, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH);
  } catch (const cv::Exception&) {
    return {};
  }
}

Image from_mat(cv::Mat mat, bool grey, int depth) {
  if (mat.depth() == CV_16U) mat.convertTo(mat, CV_8U, 255.0 / ((1 << depth) - 1));
  Image image{mat.cols, mat.rows, grey ? 1 : 3, {}};
  image.pixels.resize(image.index(0, image.height));
  cv::Mat out(image.height, image.width, grey ? CV_8UC1 : CV_8UC3, image.pixels.data());
  if (mat.channels() == 3 && grey)
    cv::extractChannel(mat, out, 0);  // the three channels are equal
  else if (mat.channels() == 3)
    cv::cvtColor(mat, out, cv::COLOR_BGR2RGB);
  else if (grey)
    mat.copyTo(out);
  else
    cv::cvtColor(mat, out, cv::COLOR_GRAY2RGB);
  return image;
}

}  // namespace

Image decode_image(std::span<const std::byte> bytes, std::string_view name, int depth) {
  const ImageHeader header = check_image(bytes, name);
  if (header.kind == ImageKind::pnm) return decode_pnm(bytes, name);
  cv::Mat mat = header.kind == ImageKind::png
                    ? decoded(pixel_chunks(bytes))
                    : decoded({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (mat.empty() || (mat.depth() != CV_8U && mat.depth() != CV_16U) ||
      (mat.channels() != 1 && mat.channels() != 3))
    throw InputError(std::string(name) + ": damaged image: its pixels cannot be decoded");
  return from_mat(std::move(mat), header.grey, depth);
}

Image read_image(const std::filesystem::path& path, int depth) {
  const std::string bytes = read_file(path, max_file_bytes);
  return decode_image(std::as_bytes(std::span(bytes.data(), bytes.size())), path.string(), depth);
}

std::optional<int> sample_depth(const std::filesystem::path& path) {
  const std::string bytes = read_file(path, max_file_bytes);
  const auto raw = std::as_bytes(std::span(bytes.data(), bytes.size()));
  if (check_image(raw, path.string()).kind != ImageKind::png) return std::nullopt;
  const cv::Mat mat = decoded(pixel_chunks(raw));
  if (mat.depth() != CV_16U) return std::nullopt;
  double largest = 0;
  cv::minMaxIdx(mat.reshape(1), nullptr, &largest);
  return std::clamp(static_cast<int>(std::bit_width(static_cast<unsigned>(largest))), 8, 16);
}

Image read_photograph(const std::filesystem::path& path) {
  return read_image(path, sample_depth(path).value_or(16));
}

Image to_grey(const Image& image) {
  if (image.channels == 1) return image;
  Image grey{image.width, image.height, 1, {}};
  grey.pixels.resize(grey.index(0, image.height));
  for (std::size_t i = 0; i < grey.pixels.size(); ++i) {
    const std::uint8_t* rgb = &image.pixels[3 * i];
    grey.pixels[i] =
        static_cast<std::uint8_t>((299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000);
  }
  return grey;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  cv::Mat mat(image.height, image.width, image.channels == 3 ? CV_8UC3 : CV_8UC1,
              const_cast<std::uint8_t*>(image.pixels.data()));
  if (image.channels == 3) {
    cv::Mat bgr;
    cv::cvtColor(mat, bgr, cv::COLOR_RGB2BGR);
    mat = bgr;
  }
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", mat, bytes))
    throw InputError(path.string() + ": cannot write: the picture cannot be encoded");
  write_file_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace microswarm

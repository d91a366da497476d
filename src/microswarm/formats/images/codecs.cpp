// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/codecs.hpp"

#include <spng.h>
#include <turbojpeg.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/tiff.hpp"
#include "microswarm/formats/media/media.hpp"

namespace microswarm {
namespace {

using Bytes = std::span<const std::byte>;

[[noreturn]] void fail_image(std::string_view name, const std::string& why) {
  throw InputError(std::string(name) + ": " + why);
}

bool starts_with(Bytes bytes, std::string_view text) {
  return bytes.size() >= text.size() &&
         std::equal(text.begin(), text.end(), bytes.begin(),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

// --- PNG -----------------------------------------------------------------------------------------

constexpr std::size_t max_chunk_bytes = 64
                                        << 20;  // of a text or profile, before and after inflation

constexpr int alpha_bit = 4;  // of a colour type

/// A sample with its alpha, composed over white.
template <class Sample>
Sample over_white(Sample sample, std::uint64_t alpha) {
  constexpr std::uint64_t white = std::numeric_limits<Sample>::max();
  return static_cast<Sample>((sample * alpha + white * (white - alpha) + white / 2) / white);
}

template <class Sample>
cv::Mat over_white(const cv::Mat& rgba) {
  cv::Mat rgb(rgba.rows, rgba.cols, CV_MAKETYPE(rgba.depth(), 3));
  const auto* in = rgba.ptr<Sample>();
  auto* out = rgb.ptr<Sample>();
  for (std::size_t i = 0; i < rgba.total(); ++i, in += 4)
    for (int k = 0; k < 3; ++k) *out++ = over_white(in[k], in[3]);
  return rgb;
}

/// Colours of packed indices. libspng would map an index beyond the palette to black.
cv::Mat looked_up(const cv::Mat& packed, const spng_ihdr& header, const spng_plte& palette,
                  const spng_trns& of_colours, std::string_view name) {
  const std::uint32_t bits = header.bit_depth;
  cv::Mat rgb(packed.rows, static_cast<int>(header.width), CV_8UC3);
  for (int row = 0; row < rgb.rows; ++row) {
    const auto* in = packed.ptr<std::uint8_t>(row);
    auto* out = rgb.ptr<std::uint8_t>(row);
    for (std::uint32_t column = 0; column < header.width; ++column) {
      const std::uint32_t at = column * bits;
      const std::uint32_t index = (in[at / 8] >> (8 - bits - at % 8)) & ((1U << bits) - 1);
      if (index >= palette.n_entries)
        fail_image(name, "damaged PNG: index " + std::to_string(index) + " of a palette of " +
                             std::to_string(palette.n_entries) + " colours");
      const spng_plte_entry& c = palette.entries[index];
      const std::uint8_t alpha =
          index < of_colours.n_type3_entries ? of_colours.type3_alpha[index] : 255;
      for (const std::uint8_t sample : {c.red, c.green, c.blue}) *out++ = over_white(sample, alpha);
    }
  }
  return rgb;
}

/// A PNG that is being decoded.
struct OpenPng {
  OpenPng(Bytes bytes, std::string_view file) : name(file) {
    check(spng_set_crc_action(png.get(), SPNG_CRC_ERROR, SPNG_CRC_ERROR));
    check(spng_set_chunk_limits(png.get(), max_chunk_bytes, max_chunk_bytes));
    check(spng_set_png_buffer(png.get(), bytes.data(), bytes.size()));
    check(spng_get_ihdr(png.get(), &header));
    check_image_size(header.width, header.height, name);
    const int no_trns = spng_get_trns(png.get(), &of_colours);
    if (no_trns != SPNG_ECHUNKAVAIL) check(no_trns);
    transparent = (header.color_type & alpha_bit) != 0 || no_trns == 0;
  }
  void check(int code) const {
    if (code) fail_image(name, std::string("damaged PNG: ") + spng_strerror(code));
  }
  void decode(cv::Mat& pixels, int format) const {
    check(spng_decode_image(png.get(), pixels.data, pixels.total() * pixels.elemSize(), format,
                            SPNG_DECODE_TRNS));
    check(spng_decode_chunks(png.get()));  // up to IEND
  }

  std::string_view name;
  std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> png{spng_ctx_new(0), spng_ctx_free};
  spng_ihdr header{};
  spng_trns of_colours{};
  bool transparent = false;  ///< whether pixels may be transparent
};

cv::Mat decode_png(Bytes bytes, std::string_view name) {
  const OpenPng png(bytes, name);
  const spng_ihdr& header = png.header;
  const auto width = static_cast<int>(header.width), height = static_cast<int>(header.height);
  const bool grey = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE ||
                    header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
  cv::Mat pixels;
  int format = SPNG_FMT_PNG;
  if (header.color_type == SPNG_COLOR_TYPE_INDEXED) {
    pixels.create(height, (width * header.bit_depth + 7) / 8, CV_8UC1);
  } else if (png.transparent) {
    pixels.create(height, width, header.bit_depth == 16 ? CV_16UC4 : CV_8UC4);
    format = header.bit_depth == 16 ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
  } else if (header.bit_depth == 16) {
    pixels.create(height, width, grey ? CV_16UC1 : CV_16UC3);
  } else {
    pixels.create(height, width, grey ? CV_8UC1 : CV_8UC3);
    format = grey ? SPNG_FMT_G8 : SPNG_FMT_RGB8;
  }
  png.decode(pixels, format);
  if (header.color_type == SPNG_COLOR_TYPE_INDEXED) {
    spng_plte palette{};
    png.check(spng_get_plte(png.png.get(), &palette));
    return looked_up(pixels, header, palette, png.of_colours, name);
  }
  if (png.transparent)
    pixels = pixels.depth() == CV_16U ? over_white<std::uint16_t>(pixels)
                                      : over_white<std::uint8_t>(pixels);
  if (grey && pixels.channels() > 1) cv::extractChannel(pixels, pixels, 0);
  return pixels;
}

// --- JPEG and BMP: checked here, then decoded by OpenCV ------------------------------------------

/// Checks a JPEG by decoding it at an eighth of its size; every warning is an error.
void check_jpeg(Bytes bytes, std::string_view name) {
  const std::unique_ptr<void, int (*)(tjhandle)> jpeg(tjInitDecompress(), tjDestroy);
  const auto check = [&](bool ok) {
    if (!ok) fail_image(name, std::string("damaged JPEG: ") + tjGetErrorStr2(jpeg.get()));
  };
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, subsampling = 0, colours = 0;
  const int code =
      tjDecompressHeader3(jpeg.get(), data, bytes.size(), &width, &height, &subsampling, &colours);
  check(code == 0 ||
        (subsampling < 0 && width > 0 && height > 0));  // one without a name can be decoded
  if (width == 0 && height == 0) fail_image(name, "truncated JPEG: no header of the picture");
  check_image_size(width, height, name);

  constexpr tjscalingfactor eighth{1, 8};
  const int small_width = TJSCALED(width, eighth), small_height = TJSCALED(height, eighth);
  const bool four = colours == TJCS_CMYK || colours == TJCS_YCCK;
  std::vector<unsigned char> small(static_cast<std::size_t>(small_width) *
                                   static_cast<std::size_t>(small_height) * (four ? 4 : 1));
  check(tjDecompress2(jpeg.get(), data, bytes.size(), small.data(), small_width, 0, small_height,
                      four ? TJPF_CMYK : TJPF_GRAY, TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS) == 0);
}

/// Checks a BMP: a file header, the size of the info header, then little-endian fields.
void check_bmp(Bytes bytes, std::string_view name) {
  const auto number = [&](std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    while (count-- > 0) value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + count]);
    return value;
  };
  const auto field = [&](std::size_t at) {
    return static_cast<std::int64_t>(static_cast<std::int32_t>(number(at, 4)));
  };
  if (bytes.size() < 26) fail_image(name, "truncated BMP: no header");
  const std::size_t pixels = number(10, 4);
  const bool old = number(14, 4) == 12;
  if (bytes.size() < (old ? 26U : 54U)) fail_image(name, "truncated BMP: no header");
  const std::int64_t width = old ? number(18, 2) : field(18);
  const std::int64_t height = old ? number(20, 2) : std::abs(field(22));
  const std::int64_t bits = number(old ? 24 : 28, 2);
  const std::uint32_t compression = old ? 0 : number(30, 4);
  check_image_size(width, height, name);
  if (compression != 0 && compression != 3)
    fail_image(name, "compressed BMP: only plain pixels are read");
  if (bits != 1 && bits != 4 && bits != 8 && bits != 16 && bits != 24 && bits != 32)
    fail_image(name, "damaged BMP: " + std::to_string(bits) + " bits a pixel");
  const std::int64_t colours = old ? 0 : number(46, 4);
  if (bits <= 8 && colours > (1 << bits))
    fail_image(name, "damaged BMP: a palette of " + std::to_string(colours) + " colours");
  const std::int64_t needed = (width * bits + 31) / 32 * 4 * height;
  if (pixels > bytes.size() || static_cast<std::int64_t>(bytes.size() - pixels) < needed)
    fail_image(name, "truncated BMP: " + std::to_string(needed) + " bytes of pixels expected");
}

cv::Mat decode_with_opencv(Bytes bytes, std::string_view name) {
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1,
                    const_cast<std::byte*>(bytes.data()));
  cv::Mat pixels = media().decode(raw);
  if (pixels.empty()) fail_image(name, "damaged image: its pixels cannot be decoded");
  if (pixels.channels() == 3) cv::cvtColor(pixels, pixels, cv::COLOR_BGR2RGB);
  return pixels;
}

}  // namespace

std::string encode_png(const Image& image) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> png(spng_ctx_new(SPNG_CTX_ENCODER),
                                                           spng_ctx_free);
  const auto check = [](int code) {
    if (code) throw InputError(std::string("cannot encode a PNG: ") + spng_strerror(code));
  };
  // Fast, and small enough for pictures with large uniform areas.
  check(spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1));
  check(spng_set_option(png.get(), SPNG_IMG_COMPRESSION_LEVEL, 3));
  check(spng_set_option(png.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB));
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(image.width);
  header.height = static_cast<std::uint32_t>(image.height);
  header.bit_depth = 8;
  header.color_type = image.channels == 3 ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_GRAYSCALE;
  check(spng_set_ihdr(png.get(), &header));
  check(spng_encode_image(png.get(), image.pixels.data(), image.pixels.size(), SPNG_FMT_PNG,
                          SPNG_ENCODE_FINALIZE));
  std::size_t size = 0;
  int error = 0;
  const std::unique_ptr<void, void (*)(void*)> bytes(spng_get_png_buffer(png.get(), &size, &error),
                                                     std::free);
  check(error);
  return {static_cast<const char*>(bytes.get()), size};
}

std::vector<std::uint8_t> transparency_of(Bytes bytes, std::string_view name) {
  if (!is_png(bytes)) return {};
  const OpenPng png(bytes, name);
  if (!png.transparent) return {};
  cv::Mat rgba(static_cast<int>(png.header.height), static_cast<int>(png.header.width), CV_8UC4);
  png.decode(rgba, SPNG_FMT_RGBA8);
  std::vector<std::uint8_t> out(rgba.total());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = rgba.data[4 * i + 3] < 255;
  return out;
}

bool is_png(Bytes bytes) { return starts_with(bytes, "\x89PNG\r\n\x1a\n"); }

cv::Mat decode_pixels(Bytes bytes, std::string_view name) {
  if (bytes.empty()) fail_image(name, "empty file");
  if (is_png(bytes)) return decode_png(bytes, name);
  if (starts_with(bytes, "\xff\xd8")) {
    check_jpeg(bytes, name);
    return decode_with_opencv(bytes, name);
  }
  if (is_tiff(bytes)) return TiffPages(bytes, name).next();
  if (!starts_with(bytes, "BM"))
    fail_image(name, "not an image (PNG, JPEG, BMP, TIFF, PGM, PPM or PBM)");
  check_bmp(bytes, name);
  cv::Mat pixels = decode_with_opencv(bytes, name);
  if (pixels.channels() == 1) cv::cvtColor(pixels, pixels, cv::COLOR_GRAY2RGB);
  return pixels;
}

int depth_of(const cv::Mat& pixels) {
  double largest = 0;
  cv::minMaxIdx(pixels.reshape(1), nullptr, &largest);
  return std::clamp(static_cast<int>(std::bit_width(static_cast<unsigned>(largest))), 8, 16);
}

void take_pixels(const cv::Mat& pixels, int depth, Image& image) {
  image.width = pixels.cols;
  image.height = pixels.rows;
  image.channels = pixels.channels();
  image.pixels.resize(image.index(0, image.height));
  cv::Mat out(image.height, image.width, CV_8UC(image.channels), image.pixels.data());
  pixels.convertTo(out, CV_8U, pixels.depth() == CV_16U ? 255.0 / ((1 << depth) - 1) : 1.0);
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/codecs.hpp"

#include <spng.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/images/orientation.hpp"
#include "microswarm/formats/images/tiff.hpp"
#include "microswarm/formats/media/media.hpp"

namespace microswarm::formats {
namespace {

using Bytes = std::span<const std::byte>;

[[noreturn]] void fail_image(std::string_view name, const std::string& why) {
  throw InputError(std::string(name), why);
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
std::vector<Sample> over_white(const std::vector<Sample>& rgba, int channels) {
  std::vector<Sample> out;
  out.reserve(rgba.size() / 4 * static_cast<std::size_t>(channels));
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    for (int k = 0; k < channels; ++k)
      out.push_back(over_white(rgba[i + static_cast<std::size_t>(k)], rgba[i + 3]));
  return out;
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
  template <class Sample>
  void decode(std::vector<Sample>& samples, int format) const {
    check(spng_decode_image(png.get(), samples.data(), samples.size() * sizeof(Sample), format,
                            SPNG_DECODE_TRNS));
    check(spng_decode_chunks(png.get()));  // up to IEND
  }
  /// After decoding; 1 without EXIF.
  int orientation() const {
    spng_exif exif{};
    if (spng_get_exif(png.get(), &exif) != 0) return 1;
    std::vector<std::byte> block{std::byte{'E'}, std::byte{'x'}, std::byte{'i'},
                                 std::byte{'f'}, std::byte{0},   std::byte{0}};  // as in a JPEG
    const auto* data = reinterpret_cast<const std::byte*>(exif.data);
    block.insert(block.end(), data, data + exif.length);
    return exif_orientation(block);
  }
  int width() const { return static_cast<int>(header.width); }
  int height() const { return static_cast<int>(header.height); }
  std::size_t pixels() const { return std::size_t{header.width} * header.height; }

  std::string_view name;
  std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> png{spng_ctx_new(0), spng_ctx_free};
  spng_ihdr header{};
  spng_trns of_colours{};
  bool transparent = false;  ///< whether pixels may be transparent
};

/// Colours of packed indices. libspng would map an index beyond the palette to black.
Image decode_indexed(const OpenPng& png) {
  const std::uint32_t bits = png.header.bit_depth, width = png.header.width;
  const std::size_t in_row = (std::size_t{width} * bits + 7) / 8;
  std::vector<std::uint8_t> packed(in_row * png.header.height);
  png.decode(packed, SPNG_FMT_PNG);
  spng_plte palette{};
  png.check(spng_get_plte(png.png.get(), &palette));
  Image image{png.width(), png.height(), 3, {}};
  image.pixels.reserve(3 * png.pixels());
  for (std::size_t row = 0; row < packed.size(); row += in_row)
    for (std::uint32_t column = 0; column < width; ++column) {
      const std::uint32_t at = column * bits;
      const std::uint32_t index =
          (packed[row + at / 8] >> (8 - bits - at % 8)) & ((1U << bits) - 1);
      if (index >= palette.n_entries)
        fail_image(png.name, "damaged PNG: index " + std::to_string(index) + " of a palette of " +
                                 std::to_string(palette.n_entries) + " colours");
      const spng_plte_entry& c = palette.entries[index];
      const std::uint8_t alpha =
          index < png.of_colours.n_type3_entries ? png.of_colours.type3_alpha[index] : 255;
      for (const std::uint8_t sample : {c.red, c.green, c.blue})
        image.pixels.push_back(over_white(sample, alpha));
    }
  return image;
}

template <class Sample>
std::vector<Sample> decode_samples(const OpenPng& png, int channels) {
  constexpr bool deep = sizeof(Sample) > 1;
  if (png.transparent) {
    std::vector<Sample> rgba(4 * png.pixels());
    png.decode(rgba, deep ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8);
    return over_white(rgba, channels);
  }
  std::vector<Sample> samples(png.pixels() * static_cast<std::size_t>(channels));
  png.decode(samples, deep ? SPNG_FMT_PNG : channels == 1 ? SPNG_FMT_G8 : SPNG_FMT_RGB8);
  return samples;
}

DecodedImage decode_stored_png(const OpenPng& png) {
  const int kind = png.header.color_type;
  if (kind == SPNG_COLOR_TYPE_INDEXED) return decode_indexed(png);
  const bool grey = kind == SPNG_COLOR_TYPE_GRAYSCALE || kind == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
  const int channels = grey ? 1 : 3;
  if (png.header.bit_depth == 16)
    return DeepImage{png.width(), png.height(), channels,
                     decode_samples<std::uint16_t>(png, channels), 16};
  return Image{png.width(), png.height(), channels, decode_samples<std::uint8_t>(png, channels)};
}

DecodedImage decode_png(Bytes bytes, std::string_view name) {
  const OpenPng png(bytes, name);
  DecodedImage picture = decode_stored_png(png);
  orient(picture, png.orientation());
  return picture;
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

Image decode_with_opencv(Bytes bytes, std::string_view name) {
  Photograph decoded = media().decode(bytes);
  if (decoded.samples.empty()) fail_image(name, "damaged image: its pixels cannot be decoded");
  return {decoded.width, decoded.height, decoded.channels, std::move(decoded.samples)};
}

/// The same image with three channels.
Image in_colours(Image image) {
  if (image.channels == 3) return image;
  Image out{image.width, image.height, 3, {}};
  out.pixels.reserve(3 * image.pixels.size());
  for (const std::uint8_t grey : image.pixels) out.pixels.insert(out.pixels.end(), 3, grey);
  return out;
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

void write_png(const std::filesystem::path& path, const Image& image) {
  write_file_atomically(path, encode_png(image));
}

std::vector<std::uint8_t> transparency(Bytes bytes, std::string_view name) {
  if (is_tiff(bytes)) return TiffPages(bytes, name).transparency();
  if (!is_png(bytes)) return {};
  const OpenPng png(bytes, name);
  if (!png.transparent) return {};
  std::vector<std::uint8_t> rgba(4 * png.pixels()), out(png.pixels());
  png.decode(rgba, SPNG_FMT_RGBA8);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = rgba[4 * i + 3] < 255;
  DecodedImage picture = Image{png.width(), png.height(), 1, std::move(out)};
  orient(picture, png.orientation());
  return std::get<Image>(std::move(picture)).pixels;
}

bool is_png(Bytes bytes) { return starts_with(bytes, "\x89PNG\r\n\x1a\n"); }

DecodedImage decode_pixels(Bytes bytes, std::string_view name) {
  if (bytes.empty()) fail_image(name, "empty file");
  if (is_png(bytes)) return decode_png(bytes, name);
  if (starts_with(bytes, "\xff\xd8")) {
    check_jpeg(bytes, name);
    DecodedImage picture = decode_with_opencv(bytes, name);
    orient(picture, exif_orientation(bytes));
    return picture;
  }
  if (is_tiff(bytes)) {
    TiffPages pages(bytes, name);
    if (const int channels = pages.description().pixel_channels; channels > 1)
      fail_image(name, "its pixels have " + std::to_string(channels) +
                           " channels that are no colours: save one of them");
    return pages.next();
  }
  if (!starts_with(bytes, "BM"))
    fail_image(name, "not an image (PNG, JPEG, BMP, TIFF, PGM, PPM or PBM)");
  check_bmp(bytes, name);
  return in_colours(decode_with_opencv(bytes, name));
}

}  // namespace microswarm::formats

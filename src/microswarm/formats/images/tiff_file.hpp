// SPDX-License-Identifier: Apache-2.0
// The open file of a TIFF's reader; for the latter only.
#pragma once

#include <sys/stat.h>
#include <tiffio.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/formats/images/deep_image.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/tiff.hpp"
#include "microswarm/formats/images/tiff_colours.hpp"
#include "microswarm/formats/images/tiff_page.hpp"
#include "microswarm/formats/images/tiff_samples.hpp"

namespace microswarm::formats {
namespace tiff {

inline constexpr tmsize_t max_allocation = 512L << 20;  // [bytes] of the library at once

/// Handler of libtiff that shows nothing.
inline int keep_silent(TIFF*, void*, const char*, const char*, va_list) { return 1; }

/// Handler of libtiff that counts.
inline int keep_count(TIFF*, void* errors, const char*, const char*, va_list) {
  ++*static_cast<int*>(errors);
  return 1;
}

}  // namespace tiff

/// The open file. libtiff's errors are counted, its messages are not shown.
struct TiffPages::File {
  /// Pages that follow each other without directories.
  struct Row {
    std::uint64_t begin = 0;  ///< of the first page in the file [B]
    std::uint64_t size = 0;   ///< of a page [B]
  };

  std::span<const std::byte> bytes{};  // of a file in memory
  toff_t at = 0;                       // place in it
  TIFF* tiff = nullptr;
  int errors = 0;
  std::optional<Row> in_row{};

  File() = default;
  ~File() {
    if (tiff) TIFFClose(tiff);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  template <class Open>
  void open(Open&& with) {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, tiff::max_allocation);
    TIFFOpenOptionsSetErrorHandlerExtR(options, tiff::keep_count, &errors);
    TIFFOpenOptionsSetWarningHandlerExtR(options, tiff::keep_silent, nullptr);
    tiff = with(options);
    TIFFOpenOptionsFree(options);
  }

  static File& of(thandle_t handle) { return *static_cast<File*>(handle); }
  static tmsize_t read(thandle_t handle, void* to, tmsize_t size) {
    File& f = of(handle);
    if (size <= 0 || f.at >= f.bytes.size()) return 0;
    const auto count = std::min<std::size_t>(static_cast<std::size_t>(size), f.bytes.size() - f.at);
    std::memcpy(to, &f.bytes[f.at], count);
    f.at += count;
    return static_cast<tmsize_t>(count);
  }
  static tmsize_t write(thandle_t, void*, tmsize_t) { return -1; }
  static toff_t seek(thandle_t handle, toff_t offset, int whence) {
    File& f = of(handle);
    f.at = whence == SEEK_SET ? offset : offset + (whence == SEEK_CUR ? f.at : f.bytes.size());
    return f.at;
  }
  static int close(thandle_t) { return 0; }
  static toff_t size(thandle_t handle) { return of(handle).bytes.size(); }
  // Without a map, libtiff 4.5 refuses small tiles that are not compressed.
  static int map(thandle_t handle, void** begin, toff_t* size) {
    const auto bytes = of(handle).bytes;
    *begin = const_cast<std::byte*>(bytes.data());
    *size = bytes.size();
    return 1;
  }
  static void unmap(thandle_t, void*, toff_t) {}

  tiff::Page page() const {
    tiff::Page p;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &p.width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &p.height);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &p.bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &p.samples);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &p.format);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &p.planes);
    std::uint16_t count = 0;
    const std::uint16_t* kinds = nullptr;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds);
    if (!kinds || count > p.samples) count = 0;
    // Without a photometric interpretation the samples decide, as in libtiff.
    if (TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &p.photometric) != 1 && p.samples - count == 3)
      p.photometric = PHOTOMETRIC_RGB;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_INKSET, &p.inks);
    TIFFGetField(tiff, TIFFTAG_ORIENTATION, &p.orientation);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &p.compression);
    p.pixel = tiff::PixelSamples::of(p.samples, tiff::colours_of(p), p.is_grey(), {kinds, count});
    return p;
  }

  /// Whether every strip or tile is in the file. libtiff would read a missing one as black.
  bool is_all_there() const {
    const std::uint32_t count =
        TIFFIsTiled(tiff) ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
    for (std::uint32_t i = 0; i < count; ++i)
      if (TIFFGetStrileOffset(tiff, i) == 0) return false;
    return true;
  }

  /// Decodes samples of at most 8 bits by libtiff's own conversion to red, green, blue.
  std::optional<DecodedImage> decode_8(const tiff::Page& p) const {
    std::vector<std::uint32_t> rgba(std::size_t{p.width} * p.height);
    // In the order stored: libtiff mirrors, but does not transpose.
    if (!TIFFReadRGBAImageOriented(tiff, p.width, p.height, rgba.data(),
                                   p.orientation ? p.orientation : ORIENTATION_TOPLEFT, 1))
      return std::nullopt;
    const bool grey = p.is_grey();
    Image image{static_cast<int>(p.width), static_cast<int>(p.height), grey ? 1 : 3, {}};
    image.pixels.resize(image.index(0, image.height));
    std::uint8_t* out = image.pixels.data();
    for (const std::uint32_t pixel : rgba) {
      *out++ = static_cast<std::uint8_t>(TIFFGetR(pixel));
      if (grey) continue;
      *out++ = static_cast<std::uint8_t>(TIFFGetG(pixel));
      *out++ = static_cast<std::uint8_t>(TIFFGetB(pixel));
    }
    return image;
  }

  /// Decodes whole samples of 1 to 16 bits that libtiff's conversion does not know, or drops.
  std::optional<DecodedImage> decode_whole(const tiff::Page& p) const {
    std::vector<std::uint16_t> samples;
    if (!decode_colours(p, tiff::PackedSamples{p.bits}, samples)) return std::nullopt;
    const std::uint32_t full = p.full();
    if (p.photometric == PHOTOMETRIC_MINISWHITE)
      for (std::uint16_t& s : samples) s = static_cast<std::uint16_t>(full - s);
    if (p.photometric == PHOTOMETRIC_SEPARATED) samples = tiff::rgb_of_cmyk(samples, full);
    int bits = p.bits;
    if (p.photometric == PHOTOMETRIC_PALETTE) {
      if (!take_palette(p, samples)) return std::nullopt;
      bits = 8;
    }
    const int channels = p.pixel.colours == 1 && p.photometric != PHOTOMETRIC_PALETTE ? 1 : 3;
    if (p.pixel.alpha >= 0) {
      std::vector<std::uint16_t> alpha;
      if (!decode_samples(p, tiff::PackedSamples{p.bits}, p.pixel.alpha, 1, alpha))
        return std::nullopt;
      if (bits != p.bits)
        for (std::uint16_t& a : alpha) a = static_cast<std::uint16_t>(a * 255U / full);
      tiff::put_over_white(samples, alpha, static_cast<std::size_t>(channels), p.pixel.multiplied,
                           bits == 8 ? 255 : full);
    }
    const int width = static_cast<int>(p.width), height = static_cast<int>(p.height);
    if (bits > 8) return DeepImage{width, height, channels, std::move(samples), bits};
    Image image{width, height, channels, {}};
    image.pixels.reserve(samples.size());
    const std::uint32_t white = bits == 8 ? 255 : full;
    for (const std::uint16_t s : samples)
      image.pixels.push_back(static_cast<std::uint8_t>((s * 255U + white / 2) / white));
    return image;
  }

  /// Replaces indices by colours of 8 bits.
  bool take_palette(const tiff::Page& p, std::vector<std::uint16_t>& samples) const {
    std::uint16_t *red = nullptr, *green = nullptr, *blue = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_COLORMAP, &red, &green, &blue) != 1) return false;
    const std::size_t entries = std::size_t{p.full()} + 1;
    const auto is_small = [&](const std::uint16_t* c) {
      return std::all_of(c, c + entries, [](std::uint16_t v) { return v < 256; });
    };
    // Some writers fill a palette with 8-bit colours; libtiff takes them as such too.
    const int shift = is_small(red) && is_small(green) && is_small(blue) ? 0 : 8;
    std::vector<std::uint16_t> rgb;
    rgb.reserve(3 * samples.size());
    for (const std::uint16_t index : samples)
      for (const std::uint16_t* c : {red, green, blue})
        rgb.push_back(static_cast<std::uint16_t>(c[index] >> shift));
    samples = std::move(rgb);
    return true;
  }

  /// Decodes signed and floating samples, and those of 32 bits.
  std::optional<DecodedImage> decode_real(const tiff::Page& p) const {
    RealImage image{.width = static_cast<int>(p.width),
                    .height = static_cast<int>(p.height),
                    .channels = p.pixel.colours,
                    .samples = {},
                    .kind = tiff::real_kind(p)};
    std::vector<float> alpha;
    const bool good = tiff::with_real_reader(p, [&](auto reader) {
      return decode_colours(p, reader, image.samples) &&
             (p.pixel.alpha < 0 || decode_samples(p, reader, p.pixel.alpha, 1, alpha));
    });
    if (!good) return std::nullopt;
    if (p.photometric == PHOTOMETRIC_MINISWHITE)
      for (float& sample : image.samples) sample = -sample;
    if (p.pixel.alpha >= 0)
      tiff::put_over_white(image.samples, alpha, static_cast<std::size_t>(image.channels),
                           p.pixel.multiplied, full_opacity(p, alpha));
    return image;
  }

  static double full_opacity(const tiff::Page& p, std::span<const float> alpha) {
    if (p.format == SAMPLEFORMAT_IEEEFP) return tiff::full_opacity(alpha);
    return std::ldexp(1.0, p.bits - (p.format == SAMPLEFORMAT_INT ? 1 : 0)) - 1;
  }

  /// 1 for each pixel that is not opaque; empty for a page without an opacity, nothing for one that
  /// cannot be read.
  std::optional<std::vector<std::uint8_t>> transparency(const tiff::Page& p) const {
    std::vector<std::uint8_t> out;
    if (p.pixel.alpha < 0) return out;
    std::vector<float> alpha;
    const bool real = !tiff::real_kind(p).empty();
    const bool good =
        real ? tiff::with_real_reader(
                   p,
                   [&](auto reader) { return decode_samples(p, reader, p.pixel.alpha, 1, alpha); })
             : decode_samples(p, tiff::PackedSamples{p.bits}, p.pixel.alpha, 1, alpha);
    if (!good) return std::nullopt;
    const double full = real ? full_opacity(p, alpha) : p.full();
    for (const float a : alpha) out.push_back(static_cast<double>(a) < full);
    return out;
  }

  /// The samples that are shown: of the colour, or of the channel that was chosen.
  template <class Sample, class Reader>
  bool decode_colours(const tiff::Page& p, Reader reader, std::vector<Sample>& samples) const {
    return decode_samples(p, reader, p.pixel.channels > 1 ? channel : 0, p.pixel.colours, samples);
  }

  /// Samples `first` and those behind it of each pixel, `count` in all.
  template <class Sample, class Reader>
  bool decode_samples(const tiff::Page& p, Reader reader, int first, int count,
                      std::vector<Sample>& samples) const {
    if (first < 0 || first + count > p.samples) return false;  // fewer than its colours
    const auto channels = static_cast<std::size_t>(count);
    samples.resize(std::size_t{p.width} * p.height * channels);
    const bool apart = p.planes == PLANARCONFIG_SEPARATE;
    for (int k = 0; k < (apart ? count : 1); ++k) {
      const tiff::SampleRow row{p.bits, apart ? 1 : p.samples, apart ? first + k : -1, first};
      const tiff::SamplePlacer<Sample, Reader> placer{row, reader, samples.data(), p.width,
                                                      channels};
      if (!(in_row              ? decode_in_row(p, placer)
            : TIFFIsTiled(tiff) ? decode_tiles(p, placer)
                                : decode_rows(p, placer)))
        return false;
    }
    return true;
  }

  bool decode_rows(const tiff::Page& p, const auto& placer) const {
    const std::size_t size = placer.row.bytes(p.width);
    if (TIFFScanlineSize64(tiff) != size) return false;
    std::vector<std::uint8_t> row(size);
    for (std::uint32_t y = 0; y < p.height; ++y) {
      if (TIFFReadScanline(tiff, row.data(), y, placer.row.plane_number()) != 1) return false;
      placer.place(row.data(), 0, y, p.width);
    }
    return true;
  }

  bool decode_tiles(const tiff::Page& p, const auto& placer) const {
    std::uint32_t width = 0, height = 0;
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
    if (width == 0 || height == 0 || width > max_image_side || height > max_image_side)
      return false;
    const std::size_t a_row = placer.row.bytes(width);
    const std::size_t size = a_row * height;
    if (size > tiff::max_allocation || TIFFTileSize64(tiff) != size) return false;
    std::vector<std::uint8_t> tile(size);
    for (std::uint32_t y = 0; y < p.height; y += height)
      for (std::uint32_t x = 0; x < p.width; x += width) {
        if (TIFFReadTile(tiff, tile.data(), x, y, 0, placer.row.plane_number()) < 0) return false;
        for (std::uint32_t k = 0; k < std::min(height, p.height - y); ++k)
          placer.place(&tile[k * a_row], x, y + k, std::min(width, p.width - x));
      }
    return true;
  }

  /// Page `page_in_row` of those that follow each other.
  bool decode_in_row(const tiff::Page& p, const auto& placer) const {
    std::vector<std::uint8_t> page(in_row->size);
    const auto number = static_cast<std::uint64_t>(page_in_row);
    if (!read_at(in_row->begin + in_row->size * number, page)) return false;
    const auto count = static_cast<tmsize_t>(page.size()) / std::max(1, p.bits / 8);
    if (TIFFIsByteSwapped(tiff) && p.bits == 16)
      TIFFSwabArrayOfShort(reinterpret_cast<std::uint16_t*>(page.data()), count);
    if (TIFFIsByteSwapped(tiff) && p.bits == 32)
      TIFFSwabArrayOfLong(reinterpret_cast<std::uint32_t*>(page.data()), count);
    const std::size_t a_row = placer.row.bytes(p.width);
    for (std::uint32_t y = 0; y < p.height; ++y) placer.place(&page[y * a_row], 0, y, p.width);
    return true;
  }
  bool read_at(std::uint64_t from, std::vector<std::uint8_t>& to) const {
    if (!bytes.empty()) {
      if (from > bytes.size() || to.size() > bytes.size() - from) return false;
      std::memcpy(to.data(), &bytes[from], to.size());
      return true;
    }
    for (std::size_t done = 0; done < to.size();) {
      const ssize_t got =
          ::pread(TIFFFileno(tiff), &to[done], to.size() - done, static_cast<off_t>(from + done));
      if (got <= 0) return false;
      done += static_cast<std::size_t>(got);
    }
    return true;
  }

  /// Size of the file [B].
  std::uint64_t file_size() const {
    if (!bytes.empty()) return bytes.size();
    struct stat info {};
    return ::fstat(TIFFFileno(tiff), &info) == 0 ? static_cast<std::uint64_t>(info.st_size) : 0;
  }

  /// Place of the pages without directories, if the only page is plain and in one piece.
  std::optional<Row> find_row() const {
    const tiff::Page p = page();
    if (p.width > max_image_side || p.height > max_image_side) return std::nullopt;
    const bool known = p.bits == 8 || p.bits == 16 || p.bits == 32;
    if (!known || p.compression != COMPRESSION_NONE || TIFFIsTiled(tiff) ||
        p.planes != PLANARCONFIG_CONTIG || !p.is_plain() || p.photometric == PHOTOMETRIC_PALETTE)
      return std::nullopt;
    const std::uint64_t size = std::uint64_t{p.width} * p.height * p.samples * p.bits / 8;
    std::uint64_t end = TIFFGetStrileOffset(tiff, 0);
    const Row row{end, size};
    for (std::uint32_t i = 0; i + 1 < TIFFNumberOfStrips(tiff); ++i) {
      end += TIFFGetStrileByteCount(tiff, i);
      if (TIFFGetStrileOffset(tiff, i + 1) != end) return std::nullopt;
    }
    return size > 0 && row.begin > 0 ? std::optional(row) : std::nullopt;
  }

  /// Place of the second directory by the first [B]; 0: there is none.
  std::uint64_t second_directory() const {
    const bool big = TIFFIsBigTIFF(tiff) != 0;
    const auto number = [&](std::uint64_t from, std::size_t size) {
      std::vector<std::uint8_t> raw(size);
      if (!read_at(from, raw)) return std::uint64_t{0};
      if (!TIFFIsBigEndian(tiff)) std::ranges::reverse(raw);
      std::uint64_t value = 0;
      for (const std::uint8_t byte : raw) value = value << 8 | byte;
      return value;
    };
    const std::uint64_t first = TIFFCurrentDirOffset(tiff);
    const std::uint64_t entries = number(first, big ? 8 : 2);
    if (entries > 65'535) return 0;
    return number(first + (big ? 8 + 20 * entries : 2 + 12 * entries), big ? 8 : 4);
  }

  /// Whether tifffile wrote a page of 1 bit from true and false, of which it shows true as black.
  bool is_of_bools() const {
    const char* software = nullptr;
    return page().bits == 1 && page().photometric == PHOTOMETRIC_MINISWHITE &&
           TIFFGetField(tiff, TIFFTAG_SOFTWARE, &software) == 1 && software &&
           std::string_view(software).starts_with("tifffile");
  }

  TiffDescription description(const std::string& name) const {
    const char* text = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) != 1 || !text) return {};
    float x = 0, y = 0;
    TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x);
    TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y);
    return parse_tiff_description(text, x, y, name, page().samples);
  }

  int channel = 0;  ///< that is chosen of a pixel's, from 0
  int page_in_row = 0;
  std::vector<toff_t> places{};  ///< of the directories read so far [B]
};

}  // namespace microswarm::formats

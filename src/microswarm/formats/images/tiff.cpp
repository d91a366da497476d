// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/tiff.hpp"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <optional>
#include <vector>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::formats {
namespace {

constexpr tmsize_t max_allocation = 512L << 20;  // [bytes] of the library at once
constexpr int max_pages = 1'000'000;

/// Header of a page.
struct Page {
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT;
  std::uint16_t planes = PLANARCONFIG_CONTIG, photometric = PHOTOMETRIC_MINISBLACK;
};

/// Layout of samples of 9 to 16 bits in a row: of all channels, or of one plane.
struct SampleLayout {
  int bits = 16;
  int step = 1;    ///< samples a pixel
  int plane = -1;  ///< channel of the only sample; -1: all channels

  std::uint16_t plane_number() const { return static_cast<std::uint16_t>(std::max(plane, 0)); }
  /// Size of a row [B].
  std::size_t bytes(std::uint32_t pixels) const {
    return (std::size_t{pixels} * static_cast<std::size_t>(step * bits) + 7) / 8;
  }
  /// Sample of a row. 16-bit samples have the computer's byte order; others are packed, high bits
  /// first.
  std::uint16_t at(const std::uint8_t* row, std::size_t sample) const {
    if (bits == 16) {
      std::uint16_t value = 0;
      std::memcpy(&value, row + 2 * sample, sizeof value);
      return value;
    }
    std::uint32_t value = 0;
    const std::size_t first = sample * static_cast<std::size_t>(bits);
    const std::size_t end = first + static_cast<std::size_t>(bits);
    for (std::size_t byte = first / 8; 8 * byte < end; ++byte) value = value << 8 | row[byte];
    const std::size_t after = (8 - end % 8) % 8;
    return static_cast<std::uint16_t>(value >> after & ((1u << bits) - 1));
  }
  /// Copies `count` pixels of a row to column `x` of row `y`.
  void place(const std::uint8_t* row, DeepImage& image, std::uint32_t x, std::uint32_t y,
             std::uint32_t count) const {
    const auto channels = static_cast<std::size_t>(image.channels);
    auto* out = &image.samples[(y * static_cast<std::size_t>(image.width) + x) * channels];
    for (std::size_t i = 0; i < count; ++i, out += channels) {
      const std::size_t first = i * static_cast<std::size_t>(step);
      if (plane >= 0)
        out[plane] = at(row, first);
      else
        for (std::size_t c = 0; c < channels; ++c) out[c] = at(row, first + c);
    }
  }
};

int keep_silent(TIFF*, void*, const char*, const char*, va_list) { return 1; }

}  // namespace

/// The open file; libtiff's own messages are suppressed.
struct TiffPages::File {
  std::span<const std::byte> bytes;  // of a file in memory
  toff_t at = 0;                     // place in it
  TIFF* tiff = nullptr;

  File() = default;
  ~File() {
    if (tiff) TIFFClose(tiff);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  template <class Open>
  void open(Open&& with) {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, max_allocation);
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_silent, nullptr);
    TIFFOpenOptionsSetWarningHandlerExtR(options, keep_silent, nullptr);
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

  Page page() const {
    Page p;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &p.width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &p.height);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &p.bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &p.samples);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &p.format);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &p.planes);
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &p.photometric);
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
  std::optional<DecodedImage> decode_8(const Page& p) const {
    std::vector<std::uint32_t> rgba(std::size_t{p.width} * p.height);
    if (!TIFFReadRGBAImageOriented(tiff, p.width, p.height, rgba.data(), ORIENTATION_TOPLEFT, 1))
      return std::nullopt;
    const bool grey =
        p.photometric == PHOTOMETRIC_MINISBLACK || p.photometric == PHOTOMETRIC_MINISWHITE;
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

  /// Decodes samples of 9 to 16 bits: grey, or the first three samples.
  std::optional<DecodedImage> decode_deep(const Page& p) const {
    const int channels = p.samples >= 3 ? 3 : 1;
    DeepImage image{static_cast<int>(p.width), static_cast<int>(p.height), channels, {}};
    image.samples.resize(std::size_t{p.width} * p.height * static_cast<std::size_t>(channels));
    const bool apart = p.planes == PLANARCONFIG_SEPARATE;
    for (int plane = 0; plane < (apart ? channels : 1); ++plane) {
      const SampleLayout layout{p.bits, apart ? 1 : p.samples, apart ? plane : -1};
      if (!(TIFFIsTiled(tiff) ? decode_tiles(p, layout, image) : decode_rows(p, layout, image)))
        return std::nullopt;
    }
    if (p.photometric == PHOTOMETRIC_MINISWHITE)
      for (std::uint16_t& sample : image.samples)
        sample = static_cast<std::uint16_t>((1 << p.bits) - 1 - sample);
    return image;
  }

  bool decode_rows(const Page& p, const SampleLayout& layout, DeepImage& image) const {
    const std::size_t size = layout.bytes(p.width);
    if (TIFFScanlineSize64(tiff) != size) return false;
    std::vector<std::uint8_t> row(size);
    for (std::uint32_t y = 0; y < p.height; ++y) {
      if (TIFFReadScanline(tiff, row.data(), y, layout.plane_number()) != 1) return false;
      layout.place(row.data(), image, 0, y, p.width);
    }
    return true;
  }

  bool decode_tiles(const Page& p, const SampleLayout& layout, DeepImage& image) const {
    std::uint32_t width = 0, height = 0;
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
    if (width == 0 || height == 0 || width > max_image_side || height > max_image_side)
      return false;
    const std::size_t in_row = layout.bytes(width);
    const std::size_t size = in_row * height;
    if (size > max_allocation || TIFFTileSize64(tiff) != size) return false;
    std::vector<std::uint8_t> tile(size);
    for (std::uint32_t y = 0; y < p.height; y += height)
      for (std::uint32_t x = 0; x < p.width; x += width) {
        if (TIFFReadTile(tiff, tile.data(), x, y, 0, layout.plane_number()) < 0) return false;
        for (std::uint32_t k = 0; k < std::min(height, p.height - y); ++k)
          layout.place(&tile[k * in_row], image, x, y + k, std::min(width, p.width - x));
      }
    return true;
  }
};

bool is_tiff(std::span<const std::byte> bytes) {
  constexpr std::array<std::string_view, 4> begins{
      std::string_view("II*\0", 4), std::string_view("MM\0*", 4), std::string_view("II+\0", 4),
      std::string_view("MM\0+", 4)};
  return std::ranges::any_of(begins, [&](std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
  });
}

TiffPages::TiffPages(const std::filesystem::path& file)
    : name_(file.string()), file_(std::make_unique<File>()) {
  file_->open([&](TIFFOpenOptions* options) { return TIFFOpenExt(name_.c_str(), "r", options); });
  count_pages();
}

TiffPages::TiffPages(std::span<const std::byte> bytes, std::string_view name)
    : name_(name), file_(std::make_unique<File>()) {
  file_->bytes = bytes;
  file_->open([&](TIFFOpenOptions* options) {
    return TIFFClientOpenExt(name_.c_str(), "r", file_.get(), File::read, File::write, File::seek,
                             File::close, File::size, File::map, File::unmap, options);
  });
  count_pages();
}

TiffPages::~TiffPages() = default;

void TiffPages::count_pages() {
  TIFF* const tiff = file_->tiff;
  if (!tiff) throw InputError(name_ + ": is no TIFF that can be read");
  count_ = static_cast<int>(std::min<std::uint64_t>(TIFFNumberOfDirectories(tiff), max_pages));
  if (count_ == 0) throw InputError(name_ + ": holds no picture");
}

DecodedImage TiffPages::next() {
  TIFF* const tiff = file_->tiff;
  const auto damaged = [&] {
    return InputError(
        fmt::format("{}: picture {} is damaged, or the file ends early", name_, next_));
  };
  if (next_ > 0 && !TIFFReadDirectory(tiff)) throw damaged();
  const Page page = file_->page();
  check_image_size(page.width, page.height, name_);
  const bool whole = page.format == SAMPLEFORMAT_UINT || page.format == SAMPLEFORMAT_VOID;
  if (!whole || page.samples < 1 || page.samples > 16 || page.bits > 16)
    throw InputError(fmt::format("{}: picture {} has no samples of 1 to 16 bits", name_, next_));
  if (!file_->is_all_there()) throw damaged();
  auto picture = page.bits > 8 ? file_->decode_deep(page) : file_->decode_8(page);
  if (!picture) throw damaged();
  ++next_;
  return *std::move(picture);
}

}  // namespace microswarm::formats

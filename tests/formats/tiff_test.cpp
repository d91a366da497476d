// SPDX-License-Identifier: Apache-2.0
// TIFF pages: kinds of samples and layouts, sizes that are refused, files that end early or go in
// circles.
#include "microswarm/formats/images/tiff.hpp"

#include <gtest/gtest.h>
#include <tiffio.h>

#include "microswarm/formats/images/image.hpp"
#include "tests/files.hpp"

namespace microswarm::formats {
namespace {

/// How a page is stored.
struct Layout {
  int bits = 8, samples = 1, tile = 0;
  int planes = PLANARCONFIG_CONTIG, compression = COMPRESSION_NONE;
  int photometric = PHOTOMETRIC_MINISBLACK;
};

/// Sample c at (x, y) of page k.
int sample(int k, int x, int y, int c, int bits) {
  return (7 * k + 3 * x + 5 * y + 60 * c) * (bits > 8 ? 200 : 1) % (1 << bits);
}

void write_pages(const std::filesystem::path& file, int pages, int width, int height,
                 const Layout& l, const char* mode = "w") {
  TIFF* tiff = TIFFOpen(file.c_str(), mode);
  ASSERT_TRUE(tiff);
  for (int k = 0; k < pages; ++k) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, l.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, l.samples);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, l.planes);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, l.compression);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, l.photometric);
    const bool apart = l.planes == PLANARCONFIG_SEPARATE;
    const int step = apart ? 1 : l.samples;
    const auto row = [&](int x0, int y, int count, int plane) {
      std::vector<std::uint8_t> bytes;
      std::vector<bool> packed;
      for (int x = x0; x < x0 + count; ++x)
        for (int c = 0; c < step; ++c) {
          const int value = sample(k, x, y, apart ? plane : c, l.bits);
          if (l.bits == 16) {
            bytes.push_back(static_cast<std::uint8_t>(value));
            bytes.push_back(static_cast<std::uint8_t>(value >> 8));
          } else {
            for (int bit = l.bits - 1; bit >= 0; --bit) packed.push_back(value >> bit & 1);
          }
        }
      packed.resize((packed.size() + 7) / 8 * 8);
      for (std::size_t i = 0; i < packed.size(); i += 8) {
        int byte = 0;
        for (std::size_t bit = 0; bit < 8; ++bit) byte = 2 * byte + packed[i + bit];
        bytes.push_back(static_cast<std::uint8_t>(byte));
      }
      return bytes;
    };
    if (l.tile > 0) {
      TIFFSetField(tiff, TIFFTAG_TILEWIDTH, l.tile);
      TIFFSetField(tiff, TIFFTAG_TILELENGTH, l.tile);
    } else {
      TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 3);
    }
    for (int plane = 0; plane < (apart ? l.samples : 1); ++plane) {
      for (int y = 0; y < height && l.tile == 0; ++y)
        TIFFWriteScanline(tiff, row(0, y, width, plane).data(), static_cast<std::uint32_t>(y),
                          static_cast<std::uint16_t>(plane));
      for (int y = 0; y < height && l.tile > 0; y += l.tile)
        for (int x = 0; x < width; x += l.tile) {
          std::vector<std::uint8_t> tile;
          for (int dy = 0; dy < l.tile; ++dy) {
            const auto part = row(x, y + dy, l.tile, plane);
            tile.insert(tile.end(), part.begin(), part.end());
          }
          TIFFWriteTile(tiff, tile.data(), static_cast<std::uint32_t>(x),
                        static_cast<std::uint32_t>(y), 0, static_cast<std::uint16_t>(plane));
        }
    }
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
}

TEST(Tiff, EveryLayoutIsReadAsItWasWritten) {
  const test::Folder folder;
  const std::vector<Layout> layouts{
      {},
      {.compression = COMPRESSION_LZW},
      {.bits = 16},
      {.bits = 16, .compression = COMPRESSION_ADOBE_DEFLATE},
      {.bits = 16, .tile = 16},
      {.tile = 16},
      {.tile = 16, .compression = COMPRESSION_LZW},
      {.bits = 12},
      {.bits = 10, .tile = 16},
      {.bits = 14, .samples = 3, .photometric = PHOTOMETRIC_RGB},
      {.bits = 16, .photometric = PHOTOMETRIC_MINISWHITE},
      {.bits = 12, .photometric = PHOTOMETRIC_MINISWHITE},
      {.samples = 3, .photometric = PHOTOMETRIC_RGB},
      {.bits = 16, .samples = 3, .photometric = PHOTOMETRIC_RGB},
      {.bits = 16, .samples = 4, .tile = 16, .photometric = PHOTOMETRIC_RGB},
      {.bits = 16, .samples = 3, .planes = PLANARCONFIG_SEPARATE, .photometric = PHOTOMETRIC_RGB},
      {.samples = 3, .planes = PLANARCONFIG_SEPARATE, .photometric = PHOTOMETRIC_RGB}};
  for (std::size_t i = 0; i < layouts.size(); ++i)
    for (const char* mode : {"w", "w8", "wb"}) {
      const Layout& l = layouts[i];
      const auto file = folder / "a.tif";
      SCOPED_TRACE(std::to_string(i) + mode);
      write_pages(file, 3, 37, 21, l, mode);
      TiffPages pages(file);
      ASSERT_EQ(pages.count(), 3) << i;
      for (int k = 0; k < 3; ++k) {
        const DecodedImage page = pages.next();
        const auto* of_8_bits = std::get_if<Image>(&page);
        const auto* deep = std::get_if<DeepImage>(&page);
        const int channels = std::min(l.samples, 3);
        ASSERT_EQ(deep != nullptr, l.bits > 8) << i;
        ASSERT_EQ(of_8_bits ? of_8_bits->pixels.size() : deep->samples.size(),
                  37u * 21u * static_cast<std::size_t>(channels))
            << i;
        for (int y = 0; y < 21; ++y)
          for (int x = 0; x < 37; ++x)
            for (int c = 0; c < channels; ++c) {
              const auto at = static_cast<std::size_t>((37 * y + x) * channels + c);
              const int value = deep ? deep->samples[at] : of_8_bits->pixels[at];
              const int wanted = sample(k, x, y, c, l.bits);
              const bool white = l.photometric == PHOTOMETRIC_MINISWHITE;
              ASSERT_EQ(value, white ? (1 << l.bits) - 1 - wanted : wanted)
                  << i << ": " << x << ", " << y;
            }
      }
    }
}

TEST(Tiff, IsAPictureLikeOthers) {
  const test::Folder folder;
  write_pages(folder / "a.tif", 2, 20, 10, {});
  const Image image = read_image(folder / "a.tif");
  EXPECT_EQ(image.width, 20);
  EXPECT_EQ(image.pixels[image.index(4, 5)], sample(0, 4, 5, 0, 8));
}

TEST(Tiff, TenThousandPagesAreReadOneAfterTheOther) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  write_pages(file, 10'000, 32, 32, {});
  TiffPages pages(file);
  ASSERT_EQ(pages.count(), 10'000);
  for (int k = 0; k < 10'000; ++k)
    ASSERT_EQ(std::get<Image>(pages.next()).pixels.at(2 * 32 + 1), sample(k, 1, 2, 0, 8));
}

TEST(Tiff, ALargePageIsRefusedBeforeItIsDecoded) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  write_pages(file, 1, 20, 10, {});
  std::string bytes = read_file(file);
  // Width and height are in the directory as 20 and 10: tags 256 and 257.
  const auto directory =
      static_cast<unsigned char>(bytes[4]) + 256u * static_cast<unsigned char>(bytes[5]);
  for (std::size_t at = directory + 2; at + 12 <= bytes.size(); at += 12) {
    const int tag = static_cast<unsigned char>(bytes[at]) + 256 * bytes[at + 1];
    if (tag == 256 || tag == 257) {
      bytes[at + 2] = 4, bytes[at + 3] = 0;  // long
      bytes[at + 8] = bytes[at + 11] = 0;
      bytes[at + 9] = 0x7D, bytes[at + 10] = 0;  // 32000
    }
  }
  const std::string error =
      test::error_of([&] { TiffPages(test::bytes_of(bytes), "bomb.tif").next(); });
  EXPECT_NE(error.find("bomb.tif: 32000 × 32000 pixels, at most 16384 a side"), std::string::npos)
      << error;
}

TEST(Tiff, DamagedFilesAreOneLine) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  write_pages(file, 3, 37, 21, {.bits = 16, .compression = COMPRESSION_LZW});
  const std::string whole = read_file(file);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    const std::string part = whole.substr(0, size);
    const std::string error = test::error_of([&] {
      TiffPages pages(test::bytes_of(part), "a.tif");
      for (int k = 0; k < pages.count(); ++k) pages.next();
      if (pages.count() < 3) throw InputError("a.tif: fewer pages");
    });
    EXPECT_TRUE(error.starts_with("a.tif: ")) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(Tiff, DirectoriesInACircleEnd) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  write_pages(file, 2, 8, 8, {});
  std::string bytes = read_file(file);
  const std::string first = bytes.substr(4, 4);
  const auto offset = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
    return value;
  };
  std::size_t second = offset(4) + 2 + 12 * static_cast<unsigned char>(bytes[offset(4)]);
  second = offset(second);  // the second directory; its next becomes the first
  bytes.replace(second + 2 + 12 * static_cast<unsigned char>(bytes[second]), 4, first);
  TiffPages pages(test::bytes_of(bytes), "circle.tif");
  EXPECT_LE(pages.count(), 3);
}

/// Number in a little-endian file.
std::uint32_t number_at(std::string_view bytes, std::size_t at, int size) {
  std::uint32_t value = 0;
  for (int k = size - 1; k >= 0; --k)
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(k)]);
  return value;
}

/// Where the entry of a tag begins in the first directory.
std::size_t entry_of(std::string_view bytes, std::uint32_t tag) {
  const std::size_t directory = number_at(bytes, 4, 4);
  for (std::size_t i = 0; i < number_at(bytes, directory, 2); ++i)
    if (const std::size_t at = directory + 2 + 12 * i; number_at(bytes, at, 2) == tag) return at;
  throw InputError("no such tag");
}

TEST(Tiff, AStripThatIsNotThereIsDamageNotBlack) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  for (const int bits : {8, 16}) {
    write_pages(file, 1, 37, 9, {.bits = bits});  // three strips
    std::string bytes = read_file(file);
    for (const std::uint32_t tag : {TIFFTAG_STRIPOFFSETS, TIFFTAG_STRIPBYTECOUNTS})
      bytes.replace(entry_of(bytes, tag) + 4, 1, 1, '\2');
    EXPECT_EQ(test::error_of([&] { TiffPages(test::bytes_of(bytes), "a.tif").next(); }),
              "a.tif: picture 0 is damaged, or the file ends early")
        << bits;
    write_pages(file, 1, 37, 3, {.bits = bits});  // one strip
    bytes = read_file(file);
    bytes.replace(entry_of(bytes, TIFFTAG_STRIPOFFSETS) + 8, 4, 4, '\0');
    EXPECT_EQ(test::error_of([&] { TiffPages(test::bytes_of(bytes), "a.tif").next(); }),
              "a.tif: picture 0 is damaged, or the file ends early")
        << bits;
  }
}

}  // namespace
}  // namespace microswarm::formats

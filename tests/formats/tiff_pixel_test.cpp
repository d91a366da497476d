// SPDX-License-Identifier: Apache-2.0
// What the samples of a TIFF's pixel are: opacity, channels, inks and indices.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/formats/images/codecs.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/tiff.hpp"
#include "microswarm/formats/map_file.hpp"
#include "tests/files.hpp"

namespace microswarm::formats {
namespace {

/// Layout and meaning of the samples of a pixel.
struct PixelTags {
  int photometric = PHOTOMETRIC_MINISBLACK, planes = PLANARCONFIG_CONTIG;
  int format = SAMPLEFORMAT_UINT;
  std::vector<std::uint16_t> extra{};
  const char* software = nullptr;
  int bits = 0;  ///< 0: those of the type
};

/// Writes a picture of one row.
template <class Sample>
void write_row(const std::filesystem::path& file, const std::vector<std::vector<Sample>>& pixels,
               const PixelTags& tags) {
  const auto samples = pixels.at(0).size();
  TIFF* tiff = TIFFOpen(file.c_str(), "w");
  ASSERT_TRUE(tiff);
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<int>(pixels.size()));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE,
               tags.bits > 0 ? tags.bits : static_cast<int>(8 * sizeof(Sample)));
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(samples));
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, tags.format);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, tags.planes);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, tags.photometric);
  if (tags.software) TIFFSetField(tiff, TIFFTAG_SOFTWARE, tags.software);
  if (!tags.extra.empty())
    TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, static_cast<int>(tags.extra.size()),
                 tags.extra.data());
  if (tags.photometric == PHOTOMETRIC_PALETTE) {
    std::vector<std::uint16_t> red(std::size_t{1} << (8 * sizeof(Sample))), green = red, blue = red;
    red[7] = 65535, green[7] = 0x8000, blue[9] = 65535;
    TIFFSetField(tiff, TIFFTAG_COLORMAP, red.data(), green.data(), blue.data());
  }
  const bool apart = tags.planes == PLANARCONFIG_SEPARATE;
  for (std::size_t plane = 0; plane < (apart ? samples : 1); ++plane) {
    std::vector<Sample> row;
    for (const auto& pixel : pixels)
      for (std::size_t c = 0; c < samples; ++c)
        if (!apart || c == plane) row.push_back(pixel[c]);
    TIFFWriteScanline(tiff, row.data(), 0, static_cast<std::uint16_t>(plane));
  }
  TIFFClose(tiff);
}

std::vector<int> pixels_of(const std::filesystem::path& file) {
  const Image image = read_image(file);
  return {image.pixels.begin(), image.pixels.end()};
}

/// What reading a picture notes.
std::string told(const std::filesystem::path& file) {
  return fmt::format("{}", fmt::join(read_picture(file).notes, "\n"));
}

/// Transparent, half and opaque pixels of a dark grey.
template <class Sample>
void expect_over_white(const std::filesystem::path& file, int colours, std::uint64_t full) {
  for (const int planes : {PLANARCONFIG_CONTIG, PLANARCONFIG_SEPARATE})
    for (const std::uint16_t kind :
         {std::uint16_t{EXTRASAMPLE_UNASSALPHA}, std::uint16_t{EXTRASAMPLE_ASSOCALPHA}}) {
      SCOPED_TRACE(
          fmt::format("{} colours of {}, planes {}, kind {}", colours, full, planes, kind));
      std::vector<std::vector<Sample>> pixels;
      for (const std::uint64_t alpha : {std::uint64_t{0}, full * 128 / 255, full}) {
        const std::uint64_t grey = full * 51 / 255;
        std::vector<Sample> pixel(
            static_cast<std::size_t>(colours),
            static_cast<Sample>(kind == EXTRASAMPLE_ASSOCALPHA ? (grey * alpha + full / 2) / full
                                                               : grey));
        pixel.push_back(static_cast<Sample>(alpha));
        pixels.push_back(pixel);
      }
      write_row(file, pixels,
                {.photometric = colours == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK,
                 .planes = planes,
                 .extra = {kind}});
      std::vector<int> wanted;
      for (const int grey : {255, 153, 51})
        wanted.insert(wanted.end(), static_cast<std::size_t>(colours), grey);
      EXPECT_EQ(pixels_of(file), wanted);
      EXPECT_EQ(read_transparency(file), (std::vector<std::uint8_t>{1, 1, 0}));
    }
}

TEST(TiffPixel, TransparentIsShownInFrontOfWhite) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  for (const int colours : {1, 3}) {
    expect_over_white<std::uint8_t>(file, colours, 255);
    expect_over_white<std::uint16_t>(file, colours, 65535);
  }
  write_row<float>(file, {{0, 0, 0, 0}, {0, 0, 0, 1}},
                   {.photometric = PHOTOMETRIC_RGB,
                    .format = SAMPLEFORMAT_IEEEFP,
                    .extra = {EXTRASAMPLE_UNASSALPHA}});
  EXPECT_EQ(pixels_of(file), (std::vector<int>{255, 255, 255, 0, 0, 0}));
  EXPECT_EQ(read_transparency(file), (std::vector<std::uint8_t>{1, 0}));
  // A sample of no kind is no opacity.
  write_row<std::uint8_t>(file, {{9, 9, 9, 0}},
                          {.photometric = PHOTOMETRIC_RGB, .extra = {EXTRASAMPLE_UNSPECIFIED}});
  EXPECT_EQ(pixels_of(file), (std::vector<int>{9, 9, 9}));
  EXPECT_NE(told(file).find("left out"), std::string::npos);
}

TEST(TiffPixel, TransparentIsUnknownInARosMap) {
  const test::Folder folder;
  for (const int negate : {0, 1}) {
    const auto yaml = folder.with(
        "m.yaml", fmt::format("image: a.tif\nresolution: 1\norigin: [0, 0, 0]\nnegate: {}\n"
                              "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                              negate));
    const std::uint16_t free = negate == 0 ? 65535 : 0;
    write_row<std::uint16_t>(folder / "a.tif", {{free, free, free, 65535}, {free, free, free, 0}},
                             {.photometric = PHOTOMETRIC_RGB, .extra = {EXTRASAMPLE_UNASSALPHA}});
    const MapParts parts = read_map_parts(RosMap{.file = yaml.string()});
    ASSERT_EQ(parts.walls.size(), 1u) << negate;
    EXPECT_EQ(bounding_box(parts.walls[0]).lo, (Vec2{1e6, 0})) << negate;
  }
}

TEST(TiffPixel, InksAndIndicesOf16BitsAreColours) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  write_row<std::uint8_t>(file, {{0, 0, 0, 0}, {0, 0, 0, 255}, {255, 0, 0, 0}},
                          {.photometric = PHOTOMETRIC_SEPARATED});
  const std::vector<int> white_black_cyan{255, 255, 255, 0, 0, 0, 0, 255, 255};
  EXPECT_EQ(pixels_of(file), white_black_cyan);
  write_row<std::uint16_t>(file, {{0, 0, 0, 0}, {0, 0, 0, 65535}, {65535, 0, 0, 0}},
                           {.photometric = PHOTOMETRIC_SEPARATED});
  EXPECT_EQ(pixels_of(file), white_black_cyan);
  write_row<std::uint8_t>(file, {{7}, {9}}, {.photometric = PHOTOMETRIC_PALETTE});
  EXPECT_EQ(pixels_of(file), (std::vector<int>{255, 128, 0, 0, 0, 255}));
  write_row<std::uint16_t>(file, {{7}, {9}}, {.photometric = PHOTOMETRIC_PALETTE});
  EXPECT_EQ(pixels_of(file), (std::vector<int>{255, 128, 0, 0, 0, 255}));
  write_row<std::uint16_t>(file, {{7, 7, 7}}, {.photometric = PHOTOMETRIC_CIELAB});
  EXPECT_NE(test::error_of([&] { read_image(file); }).find("colours of a kind"), std::string::npos);
}

TEST(TiffPixel, FewerSamplesThanColoursAreRefused) {
  const test::Folder folder;
  for (const int photometric : {PHOTOMETRIC_SEPARATED, PHOTOMETRIC_RGB}) {
    write_row<std::uint8_t>(folder / "a.tif", {{1}, {2}, {3}}, {.photometric = photometric});
    EXPECT_NE(test::error_of([&] { read_image(folder / "a.tif"); }), "") << photometric;
    write_row<std::uint16_t>(folder / "a.tif", {{1, 2}}, {.photometric = photometric});
    EXPECT_NE(test::error_of([&] { read_image(folder / "a.tif"); }), "") << photometric;
  }
}

template <class Sample>
void expect_channels(const std::filesystem::path& file, int format) {
  for (const int planes : {PLANARCONFIG_CONTIG, PLANARCONFIG_SEPARATE})
    for (std::size_t count = 2; count <= 5; ++count) {
      std::vector<std::vector<Sample>> pixels(3);
      for (std::size_t x = 0; x < 3; ++x)
        for (std::size_t c = 0; c < count; ++c)
          pixels[x].push_back(static_cast<Sample>(10 * c + x));
      write_row(file, pixels,
                {.planes = planes,
                 .format = format,
                 .extra = std::vector<std::uint16_t>(count - 1, EXTRASAMPLE_UNSPECIFIED)});
      for (std::size_t c = 0; c < count; ++c) {
        TiffPages pages(file);
        ASSERT_EQ(pages.description().pixel_channels, static_cast<int>(count));
        pages.take_channel(static_cast<int>(c));
        const DecodedImage page = pages.next();
        std::vector<double> seen;
        if (const auto* of_8_bits = std::get_if<Image>(&page))
          seen.assign(of_8_bits->pixels.begin(), of_8_bits->pixels.end());
        else if (const auto* deep = std::get_if<DeepImage>(&page))
          seen.assign(deep->samples.begin(), deep->samples.end());
        else
          seen.assign(std::get<RealImage>(page).samples.begin(),
                      std::get<RealImage>(page).samples.end());
        const double first = 10.0 * static_cast<double>(c);
        EXPECT_EQ(seen, (std::vector<double>{first, first + 1, first + 2})) << count << planes;
      }
    }
}

TEST(TiffPixel, GreySamplesAreChannels) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  expect_channels<std::uint8_t>(file, SAMPLEFORMAT_UINT);
  expect_channels<std::uint16_t>(file, SAMPLEFORMAT_UINT);
  expect_channels<float>(file, SAMPLEFORMAT_IEEEFP);
  TiffPages pages(file);
  pages.take_channel(7);
  EXPECT_NE(test::error_of([&] { pages.next(); }).find("5 channels, number 8"), std::string::npos);
  EXPECT_NE(told(file).find("5 channels"), std::string::npos);
  EXPECT_NE(test::error_of([&] { read_image(file); }).find("5 channels"), std::string::npos);
}

TEST(TiffPixel, WhatIsReadAsBlackIsTold) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  write_row<float>(file, {{0}, {std::nanf("")}, {1}}, {.format = SAMPLEFORMAT_IEEEFP});
  EXPECT_NE(told(file).find("1 of its samples are no number"), std::string::npos);
  for (const char* software : {"tifffile.py", "other"}) {
    TIFF* tiff = TIFFOpen(file.c_str(), "w");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 8);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 1);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISWHITE);
    TIFFSetField(tiff, TIFFTAG_SOFTWARE, software);
    std::uint8_t row = 0xf0;
    TIFFWriteScanline(tiff, &row, 0, 0);
    TIFFClose(tiff);
    EXPECT_EQ(told(file).find("WhiteIsZero") != std::string::npos,
              software == std::string("tifffile.py"));
  }
}

}  // namespace
}  // namespace microswarm::formats

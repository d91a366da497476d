// SPDX-License-Identifier: Apache-2.0
// Pictures of each format and depth, turned by each orientation, against pictures turned by hand.
#include "microswarm/formats/images/orientation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "microswarm/formats/images/image.hpp"
#include "tests/files.hpp"
#include "tests/formats/png.hpp"
#include "tests/formats/tiff_writer.hpp"

namespace microswarm::formats {
namespace {

constexpr int block = 8;  // a JPEG keeps even blocks

/// Three blocks in a row, two rows, as stored.
constexpr std::string_view stored = "abc def";

/// As shown with orientations 1 to 8; the EXIF standard calls them by the place of row 0 and
/// column 0.
constexpr std::array<std::string_view, 8> shown{"abc def",  "cba fed",  "fed cba",  "def abc",
                                                "ad be cf", "da eb fc", "fc eb da", "cf be ad"};

int grey_of(char name) { return 40 * (name - 'a') + 10; }

/// The stored picture; a sample is `scale` times the grey.
template <class Sample>
std::vector<Sample> samples(double scale, int channels = 1) {
  std::vector<Sample> made;
  for (int y = 0; y < 2 * block; ++y)
    for (int x = 0; x < 3 * block; ++x)
      for (int c = 0; c < channels; ++c)
        made.push_back(static_cast<Sample>(
            scale * grey_of(stored[static_cast<std::size_t>(4 * (y / block) + x / block)])));
  return made;
}

/// The blocks that an image shows, in the form above; a is its darkest, f its brightest.
std::string blocks(const Image& image) {
  const auto [least, most] = std::ranges::minmax(image.pixels);
  std::string text;
  for (int y = block / 2; y < image.height; y += block) {
    if (!text.empty()) text += ' ';
    for (int x = block / 2; x < image.width; x += block)
      text += static_cast<char>(
          'a' + std::lround(5.0 * (image.pixels[image.index(x, y)] - least) / (most - least)));
  }
  return text;
}

/// A block of EXIF that tells an orientation.
std::string exif(int orientation) {
  std::string bytes("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\0\0\0\0\0\0\0", 26);
  bytes[19] = static_cast<char>(orientation);
  return bytes;
}

std::string packed(const std::vector<std::uint8_t>& pixels, std::size_t in_row) {
  std::string rows;
  for (std::size_t at = 0; at < pixels.size(); at += in_row) {
    rows += '\0';
    rows.append(reinterpret_cast<const char*>(&pixels[at]), in_row);
  }
  return rows;
}

std::string jpeg(int orientation) {
  std::vector<std::uint8_t> pixels = samples<std::uint8_t>(1), bytes;
  cv::imencode(".jpg", cv::Mat(2 * block, 3 * block, CV_8U, pixels.data()), bytes);
  const std::string block_of_exif = std::string("Exif\0\0", 6) + exif(orientation);
  std::string marker("\xff\xe1\0", 3);
  marker += static_cast<char>(block_of_exif.size() + 2);
  std::string text(bytes.begin(), bytes.end());
  return text.insert(2, marker + block_of_exif);
}

TEST(Orientation, OfEachKindTurnsPicturesOfEachFormatAndDepth) {
  const test::Folder folder;
  for (int k = 1; k <= 8; ++k) {
    SCOPED_TRACE(k);
    const std::string_view wanted = shown[static_cast<std::size_t>(k - 1)];
    const std::string extra = test::chunk("eXIf", exif(k));
    EXPECT_EQ(blocks(read_image(folder.with("a.jpg", jpeg(k)))), wanted);
    EXPECT_EQ(blocks(read_image(folder.with(
                  "8.png", test::png(3 * block, 2 * block, 8, test::grey,
                                     packed(samples<std::uint8_t>(1), 3 * block), extra)))),
              wanted);
    EXPECT_EQ(blocks(read_image(folder.with(
                  "rgb.png", test::png(3 * block, 2 * block, 8, test::rgb,
                                       packed(samples<std::uint8_t>(1, 3), 9 * block), extra)))),
              wanted);
    std::vector<std::uint8_t> deep;
    for (const auto sample : samples<std::uint8_t>(1)) deep.insert(deep.end(), 2, sample);
    EXPECT_EQ(
        blocks(read_image(folder.with("16.png", test::png(3 * block, 2 * block, 16, test::grey,
                                                          packed(deep, 6 * block), extra)))),
        wanted);
    const auto tiff = [&](auto scale, int format, int channels) {
      using Sample = decltype(scale);
      test::write_tiff<Sample>(folder / "a.tif", 3 * block, {samples<Sample>(scale, channels)},
                               {.format = format, .samples = channels, .orientation = k});
      return blocks(read_image(folder / "a.tif"));
    };
    EXPECT_EQ(tiff(std::uint8_t{1}, SAMPLEFORMAT_UINT, 1), wanted);
    EXPECT_EQ(tiff(std::uint8_t{1}, SAMPLEFORMAT_UINT, 3), wanted);
    EXPECT_EQ(tiff(std::uint16_t{257}, SAMPLEFORMAT_UINT, 1), wanted);
    EXPECT_EQ(tiff(std::uint16_t{257}, SAMPLEFORMAT_UINT, 3), wanted);
    EXPECT_EQ(tiff(0.37F, SAMPLEFORMAT_IEEEFP, 1), wanted);
  }
}

TEST(Orientation, TransparencyTurnsWithThePicture) {
  const test::Folder folder;
  // 2 × 1 pixels of grey and alpha: the left one is transparent; 6 turns it to the top.
  const auto file = folder.with(
      "a.png", test::png(2, 1, 8, test::grey_alpha, std::string("\0\x80\x00\x80\xff", 5),
                         test::chunk("eXIf", exif(6))));
  EXPECT_EQ(read_image(file).height, 2);
  EXPECT_EQ(read_transparency(file), (std::vector<std::uint8_t>{1, 0}));
}

TEST(Orientation, ADamagedExifTurnsNothing) {
  const test::Folder folder;
  const std::string whole = exif(6);
  for (std::size_t size = 1; size < 22; ++size) {
    const auto file =
        folder.with("a.png", test::png(3 * block, 2 * block, 8, test::grey,
                                       packed(samples<std::uint8_t>(1), 3 * block),
                                       test::chunk("eXIf", "MM\0*" + whole.substr(4, size))));
    const std::string error = test::error_of([&] {
      EXPECT_EQ(blocks(read_image(file)), shown[0]) << size;
      throw InputError("read");
    });
    EXPECT_TRUE(error == "read" || error.find("damaged PNG") != std::string::npos) << error;
  }
}

}  // namespace
}  // namespace microswarm::formats

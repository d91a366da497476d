// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/raw_pixels.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <string>
#include <vector>

#include "microswarm/vision/image/mat.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::vision {
namespace {

using Bytes = std::vector<std::uint8_t>;

formats::Image pixels_of(PixelFormat format, int width, int height, const Bytes& data,
                         std::size_t bytes_per_line = 0) {
  formats::Image image;
  take_raw({format, width, height, bytes_per_line, std::as_bytes(std::span(data))}, "/dev/video0",
           image);
  return image;
}

std::string refusal(PixelFormat format, int width, int height, const Bytes& data) {
  return test::error_of([&] { pixels_of(format, width, height, data); });
}

TEST(RawPixels, NamesAreThoseOfV4l2) {
  EXPECT_EQ(to_fourcc(PixelFormat::mjpg), 0x47504a4dU);
  EXPECT_EQ(fourcc_text(to_fourcc(PixelFormat::y16)), "Y16");
  for (const auto& [format, name] : enum_names(PixelFormat{})) {
    EXPECT_EQ(find_format(to_fourcc(format)), format);
    EXPECT_EQ(fourcc_text(to_fourcc(format)), name);
  }
  EXPECT_EQ(find_format(0), std::nullopt);
  EXPECT_EQ(fourcc_text(0x01020304), "????");
}

TEST(RawPixels, GreyAndColoursKeepTheirValuesAndGapsAreLeftOut) {
  EXPECT_EQ(pixels_of(PixelFormat::grey, 2, 2, {1, 2, 9, 3, 4}, 3).pixels, (Bytes{1, 2, 3, 4}));
  EXPECT_EQ(pixels_of(PixelFormat::rgb3, 1, 2, {1, 2, 3, 4, 5, 6}).pixels,
            (Bytes{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(pixels_of(PixelFormat::bgr3, 1, 1, {1, 2, 3}).pixels, (Bytes{3, 2, 1}));
}

TEST(RawPixels, AFlatColourOfBayerIsThatColour) {
  // Red, green and blue of the first two pixels of the first two rows.
  const std::pair<PixelFormat, std::string_view> orders[]{{PixelFormat::rggb, "RGGB"},
                                                          {PixelFormat::grbg, "GRBG"},
                                                          {PixelFormat::gbrg, "GBRG"},
                                                          {PixelFormat::bggr, "BGGR"}};
  for (const auto& [format, order] : orders)
    for (const int width : {4, 5, 8}) {
      Bytes data;
      for (int y = 0; y < 6; ++y)
        for (int x = 0; x < width; ++x) {
          const char colour = order[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
          data.push_back(colour == 'R' ? 200 : colour == 'G' ? 100 : 30);
        }
      const formats::Image image = pixels_of(format, width, 6, data);
      ASSERT_EQ(image.channels, 3);
      for (std::size_t i = 0; i < image.pixels.size(); i += 3)
        EXPECT_TRUE(image.pixels[i] == 200 && image.pixels[i + 1] == 100 &&
                    image.pixels[i + 2] == 30)
            << order << " pixel " << i / 3;
    }
  EXPECT_NE(refusal(PixelFormat::rggb, 2, 6, Bytes(100)), "");
}

TEST(RawPixels, DeepSamplesKeepTheirUpperBits) {
  const Bytes two{0x34, 0x12, 0xff, 0x0f};  // 0x1234, 0x0fff
  EXPECT_EQ(pixels_of(PixelFormat::y16, 2, 1, two).pixels, (Bytes{0x12, 0x0f}));
  EXPECT_EQ(pixels_of(PixelFormat::y12, 2, 1, two).pixels, (Bytes{0xff, 0xff}));
  EXPECT_EQ(pixels_of(PixelFormat::y10, 1, 1, {0xff, 0x03}).pixels, (Bytes{0xff}));
  EXPECT_EQ(pixels_of(PixelFormat::y10, 1, 1, {0x00, 0x02}).pixels, (Bytes{0x80}));
}

TEST(RawPixels, BlackWhiteAndRedOfAVideo) {
  // BT.601: Y of 16 is black, of 235 white; red is Y 81, U 90, V 240.
  EXPECT_EQ(pixels_of(PixelFormat::yuyv, 2, 1, {16, 128, 235, 128}).pixels,
            (Bytes{0, 0, 0, 255, 255, 255}));
  EXPECT_EQ(pixels_of(PixelFormat::uyvy, 2, 1, {128, 16, 128, 235}).pixels,
            (Bytes{0, 0, 0, 255, 255, 255}));
  for (const formats::Image& red :
       {pixels_of(PixelFormat::yuyv, 2, 1, {81, 90, 81, 240}),
        pixels_of(PixelFormat::nv12, 2, 2, {81, 81, 81, 81, 90, 240})}) {
    EXPECT_NEAR(red.pixels[0], 255, 2);
    EXPECT_NEAR(red.pixels[1], 0, 2);
    EXPECT_NEAR(red.pixels[2], 0, 2);
  }
}

TEST(RawPixels, TooFewBytesAndOddSizesAreRefused) {
  for (const auto& [format, name] : enum_names(PixelFormat{})) {
    const std::string why = refusal(format, 4, 4, Bytes(10, 7));
    EXPECT_TRUE(test::is_one_line_naming(why, "/dev/video0", {})) << why;
    EXPECT_NE(refusal(format, 4, 4, {}), "") << name;
  }
  EXPECT_NE(refusal(PixelFormat::yuyv, 3, 1, Bytes(100)), "");
  EXPECT_NE(refusal(PixelFormat::nv12, 2, 3, Bytes(100)), "");
}

class JpegFrames : public testing::Test {
 protected:
  JpegFrames() : picture_(48, 64, CV_8UC3) {
    for (int y = 0; y < picture_.rows; ++y)
      for (int x = 0; x < picture_.cols; ++x)
        picture_.at<cv::Vec3b>(y, x) = cv::Vec3b::all(static_cast<std::uint8_t>(3 * x + y));
    cv::imencode(".jpg", picture_, jpeg_);
    whole_ = pixels_of(PixelFormat::mjpg, 64, 48, jpeg_);
  }
  cv::Mat picture_;
  Bytes jpeg_;
  formats::Image whole_;
};

TEST_F(JpegFrames, AreDecoded) {
  ASSERT_EQ(whole_.channels, 3);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x)
      EXPECT_NEAR(whole_.pixels[whole_.index(x, y)], picture_.at<cv::Vec3b>(y, x)[0], 6);
  EXPECT_TRUE(test::is_one_line_naming(refusal(PixelFormat::mjpg, 64, 40, jpeg_), "/dev/video0",
                                       {"64x48", "64x40"}));
}

TEST_F(JpegFrames, MayHaveNoHuffmanTables) {
  Bytes without;
  for (std::size_t at = 0; at < jpeg_.size();) {
    if (at + 3 < jpeg_.size() && jpeg_[at] == 0xff && jpeg_[at + 1] == 0xc4) {
      at += 2U + (jpeg_[at + 2] << 8 | jpeg_[at + 3]);
      continue;
    }
    without.push_back(jpeg_[at++]);
  }
  ASSERT_LT(without.size(), jpeg_.size() - 300);
  EXPECT_EQ(pixels_of(PixelFormat::mjpg, 64, 48, without).pixels, whole_.pixels);
}

TEST_F(JpegFrames, MayHaveBytesTooManyBeforeTheirEnd) {
  Bytes longer = jpeg_;
  longer.insert(longer.end() - 2, {0x12, 0x34, 0x56});
  EXPECT_EQ(pixels_of(PixelFormat::mjpg, 64, 48, longer).pixels, whole_.pixels);
}

TEST_F(JpegFrames, ThatAreCutOrDamagedAreRefused) {
  for (std::size_t size = 0; size + 3 < jpeg_.size(); size += 7) {
    Bytes cut = jpeg_;
    cut.resize(size);
    EXPECT_TRUE(
        test::is_one_line_naming(refusal(PixelFormat::mjpg, 64, 48, cut), "/dev/video0", {"JPEG"}))
        << size;
  }
}

}  // namespace
}  // namespace microswarm::vision

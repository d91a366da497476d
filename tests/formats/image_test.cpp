// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/image.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "microswarm/formats/images/pnm.hpp"
#include "microswarm/formats/images/samples.hpp"
#include "tests/files.hpp"
#include "tests/formats/png.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

using test::bytes_of;
using test::error_of;
using test::Folder;
using Pixels = std::vector<std::uint8_t>;
using namespace std::string_literals;

Image decode(std::string_view bytes) { return decode_image(bytes_of(bytes), "x.png"); }

std::string encoded(const std::string& extension, const cv::Mat& mat,
                    const std::vector<int>& options = {}) {
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(extension, mat, bytes, options));
  return {bytes.begin(), bytes.end()};
}

/// 5 × 3 pixels, all different.
cv::Mat grey_ramp() {
  cv::Mat mat(3, 5, CV_8UC1);
  std::iota(mat.begin<std::uint8_t>(), mat.end<std::uint8_t>(), std::uint8_t{7});
  return mat;
}

Pixels ramp_pixels() {
  Pixels pixels(15);
  std::iota(pixels.begin(), pixels.end(), std::uint8_t{7});
  return pixels;
}

void expect_image(const Image& image, int width, int height, int channels, const Pixels& pixels) {
  EXPECT_EQ(image.width, width);
  EXPECT_EQ(image.height, height);
  EXPECT_EQ(image.channels, channels);
  EXPECT_EQ(image.pixels, pixels);
}

TEST(Image, GreyOfEveryFormThatKeepsPixels) {
  for (const char* extension : {".png", ".bmp", ".pgm"}) {
    const Image image = decode(encoded(extension, grey_ramp()));
    SCOPED_TRACE(extension);
    EXPECT_EQ(to_grey(image).pixels, ramp_pixels());
    EXPECT_EQ(image.width, 5);
    EXPECT_EQ(image.height, 3);
  }
  expect_image(decode(encoded(".png", grey_ramp())), 5, 3, 1, ramp_pixels());
}

TEST(Image, ColoursAreRedGreenBlue) {
  const cv::Mat bgr = (cv::Mat_<cv::Vec3b>(1, 2) << cv::Vec3b(3, 2, 1), cv::Vec3b(6, 5, 4));
  for (const char* extension : {".png", ".bmp", ".ppm"}) {
    SCOPED_TRACE(extension);
    expect_image(decode(encoded(extension, bgr)), 2, 1, 3, {1, 2, 3, 4, 5, 6});
  }
}

TEST(Image, OneBitPngIsBlackAndWhite) {
  const cv::Mat mat = (cv::Mat_<std::uint8_t>(2, 3) << 0, 255, 255, 255, 0, 0);
  const std::string bytes = encoded(".png", mat, {cv::IMWRITE_PNG_BILEVEL, 1});
  ASSERT_EQ(bytes[24], 1) << "bit depth";
  expect_image(decode(bytes), 3, 2, 1, {0, 255, 255, 255, 0, 0});
}

TEST(Image, TwoAndFourBitsFillTheRange) {
  expect_image(decode(test::png(4, 1, 2, test::grey, "\0\x1b"s)), 4, 1, 1, {0, 85, 170, 255});
  expect_image(decode(test::png(2, 1, 4, test::grey, "\0\x1f"s)), 2, 1, 1, {17, 255});
}

TEST(Image, SixteenBitsAreScaledToEight) {
  const cv::Mat mat = (cv::Mat_<std::uint16_t>(1, 4) << 0, 257 * 100, 257 * 100 + 128, 65535);
  expect_image(decode(encoded(".png", mat)), 4, 1, 1, {0, 100, 100, 255});
  expect_image(decode(test::png(1, 1, 16, test::rgb, "\0\xff\xff\x80\x80\0\0"s)), 1, 1, 3,
               {255, 128, 0});
}

TEST(Image, APhotographHasTheBitsThatItsLargestSampleNeeds) {
  const Folder folder;
  const cv::Mat twelve = (cv::Mat_<std::uint16_t>(1, 3) << 0, 2048, 4095);
  const auto file = folder.with("twelve.png", encoded(".png", twelve));
  expect_image(read_photograph(file), 3, 1, 1, {0, 128, 255});
  expect_image(read_image(file), 3, 1, 1, {0, 8, 16});
  const cv::Mat eight = (cv::Mat_<std::uint8_t>(1, 2) << 7, 9);
  expect_image(read_photograph(folder.with("eight.png", encoded(".png", eight))), 2, 1, 1, {7, 9});
}

TEST(Image, SixteenBitsAreScaledToTheBitAsOpenCvDoes) {
  cv::Mat all(1, 65536, CV_16UC1), scaled;
  std::vector<std::uint16_t> samples;
  for (int k = 0; k < 65536; ++k)
    samples.push_back(all.at<std::uint16_t>(k) = static_cast<std::uint16_t>(k));
  std::vector<std::uint8_t> out(samples.size());
  for (int depth = 8; depth <= 16; ++depth) {
    all.convertTo(scaled, CV_8U, 255.0 / ((1 << depth) - 1));
    to_8_bits(samples, depth, out);
    EXPECT_TRUE(std::equal(out.begin(), out.end(), scaled.ptr())) << depth;
  }
}

TEST(Image, PaletteIsLookedUp) {
  const std::string colours = test::chunk("PLTE", "\1\2\3\4\5\6\7\x8\x9");
  expect_image(decode(test::png(3, 1, 8, test::palette, "\0\2\0\1"s, colours)), 3, 1, 3,
               {7, 8, 9, 1, 2, 3, 4, 5, 6});
  const std::string two = test::chunk("PLTE", "\1\2\3\4\5\6");
  expect_image(decode(test::png(2, 1, 1, test::palette, "\0\x40"s, two)), 2, 1, 3,
               {1, 2, 3, 4, 5, 6});
}

TEST(Image, TransparencyShowsWhite) {
  expect_image(decode(test::png(2, 1, 8, test::rgb_alpha, "\0\1\2\3\xff\0\0\0\0"s)), 2, 1, 3,
               {1, 2, 3, 255, 255, 255});
  expect_image(decode(test::png(3, 1, 8, test::grey_alpha, "\0\x1e\0\x1f\xff\0\x80"s)), 3, 1, 1,
               {255, 31, 127});
  expect_image(decode(test::png(2, 1, 16, test::grey_alpha, "\0\0\0\0\0\0\0\xff\xff"s)), 2, 1, 1,
               {255, 0});
  // One colour, or an entry of the palette, that the chunk tRNS declares as transparent.
  expect_image(decode(test::png(2, 1, 8, test::grey, "\0\5\6"s, test::chunk("tRNS", "\0\5"s))), 2,
               1, 1, {255, 6});
  const std::string palette = test::chunk("PLTE", "\1\2\3\4\5\6") + test::chunk("tRNS", "\0"s);
  expect_image(decode(test::png(2, 1, 1, test::palette, "\0\x40"s, palette)), 2, 1, 3,
               {255, 255, 255, 4, 5, 6});
}

TEST(Image, ChunksBesideThePixelsDoNotMatter) {
  const std::string junk = test::chunk("iCCP", "nonsense") + test::chunk("tEXt", "a\0b"s);
  expect_image(decode(test::png(1, 1, 8, test::grey, "\0\x2a"s, junk)), 1, 1, 1, {42});
}

TEST(Image, JpegComesNear) {
  cv::Mat mat(16, 16, CV_8UC1, cv::Scalar(200));
  const Image image = decode(encoded(".jpg", mat));
  EXPECT_EQ(image.channels, 1);
  for (const std::uint8_t v : image.pixels) EXPECT_NEAR(v, 200, 2);
  const Image progressive = decode(encoded(".jpg", mat, {cv::IMWRITE_JPEG_PROGRESSIVE, 1}));
  for (const std::uint8_t v : progressive.pixels) EXPECT_NEAR(v, 200, 2);
}

TEST(Image, NetpbmInAllSixForms) {
  expect_image(decode("P1\n# ink is 1\n3 2\n1 0 1\n010"), 3, 2, 1, {0, 255, 0, 255, 0, 255});
  expect_image(decode("P2 2 1 4 #\n 1 4"), 2, 1, 1, {64, 255});
  expect_image(decode("P3 1 1 255 1 2 3"), 1, 1, 3, {1, 2, 3});
  expect_image(decode("P4 9 1\n\x80\x7f"), 9, 1, 1, {0, 255, 255, 255, 255, 255, 255, 255, 255});
  expect_image(decode("P5 2 1 65535\n\xff\xff\x64\x64"), 2, 1, 1, {255, 100});
  expect_image(decode("P6 1 1 255\nabc"), 1, 1, 3, {'a', 'b', 'c'});
}

TEST(Image, LumaOfColours) {
  const Image image{2, 1, 3, {255, 0, 0, 0, 255, 0}};
  expect_image(to_grey(image), 2, 1, 1, {76, 150});
}

TEST(Image, WrittenAndReadAgain) {
  const Folder folder;
  const Image colours{2, 2, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
  write_png(folder / "a.png", colours);
  EXPECT_EQ(read_image(folder / "a.png").pixels, colours.pixels);
  const Image grey{5, 3, 1, ramp_pixels()};
  write_png(folder / "b.png", grey);
  expect_image(read_image(folder / "b.png"), 5, 3, 1, grey.pixels);
  expect_image(decode(encode_pnm(grey)), 5, 3, 1, grey.pixels);
  expect_image(decode(encode_pnm(colours)), 2, 2, 3, colours.pixels);
  EXPECT_NE(error_of([&] { write_png(folder / "no/a.png", grey); }).find("no/a.png: cannot write"),
            std::string::npos);
}

// Half a picture is no picture, wherever it was cut. Of a PNG the last chunk's checksum may be
// missing: that chunk is empty.
TEST(Image, NoProperPrefixIsRead) {
  cv::Mat mat(9, 7, CV_8UC3);
  cv::randu(mat, 0, 255);
  for (const char* extension : {".png", ".jpg", ".bmp", ".ppm"}) {
    const std::string whole = encoded(extension, mat);
    EXPECT_EQ(decode(whole).width, 7);
    const std::size_t needed = whole.size() - (std::string_view(extension) == ".png" ? 4 : 0);
    for (std::size_t n = 0; n < needed; ++n)
      EXPECT_THROW(decode(std::string_view(whole).substr(0, n)), InputError)
          << extension << " cut to " << n << " of " << whole.size();
  }
}

std::string image_complaint(std::string_view bytes) {
  return error_of([&] { decode(bytes); });
}

TEST(ImageErrors, AColourBeyondThePalette) {
  const std::string three = test::chunk("PLTE", "\1\2\3\4\5\6\7\x8\x9");
  EXPECT_TRUE(test::is_one_line_naming(
      image_complaint(test::png(3, 1, 8, test::palette, "\0\2\0\5"s, three)), "x.png",
      {"palette", "5", "3 colours"}));
  EXPECT_TRUE(test::is_one_line_naming(
      image_complaint(test::png(5, 1, 2, test::palette, "\0\x06\xc0"s, three)), "x.png",
      {"palette", "3", "3 colours"}));
}

TEST(ImageErrors, NothingThere) {
  const Folder folder;
  EXPECT_NE(error_of([&] { read_image(folder / "no.png"); }).find("no.png: cannot read: No such"),
            std::string::npos);
  EXPECT_EQ(image_complaint(""), "x.png: empty file");
  EXPECT_TRUE(test::is_one_line_naming(image_complaint("hello, world"), "x.png",
                                       {"PNG", "JPEG", "BMP", "PGM", "PPM", "PBM"}));
  EXPECT_TRUE(test::is_one_line_naming(image_complaint("P9 1 1 255 0"), "x.png",
                                       {"PNG", "JPEG", "BMP", "PGM", "PPM", "PBM"}));
}

/// A JPEG that begins a picture of the size and ends.
std::string hollow_jpeg(int width, int height) {
  const auto two_bytes = [](int v) {
    return std::string{static_cast<char>(v >> 8), static_cast<char>(v)};
  };
  return "\xff\xd8\xff\xc0\0\x0b\x08"s + two_bytes(height) + two_bytes(width) +
         "\1\1\x11\0\xff\xda\0\x08\1\1\0\0\x3f\0\xff\xd9"s;
}

TEST(ImageErrors, SizesAreRefusedBeforeAnythingIsDecoded) {
  const std::string head = test::png_signature;
  EXPECT_EQ(image_complaint(head + test::ihdr(20000, 20000, 8, test::grey)),
            "x.png: 20000 × 20000 pixels, at most 16384 a side");
  EXPECT_EQ(image_complaint(head + test::ihdr(10000, 10000, 8, test::grey)),
            "x.png: 10000 × 10000 pixels, at most 64 million");
  EXPECT_EQ(image_complaint(head + test::ihdr(0, 0, 8, test::grey)),
            "x.png: damaged PNG: invalid image width");
  EXPECT_EQ(image_complaint("P5 20000 20000 255\n"),
            "x.png: 20000 × 20000 pixels, at most 16384 a side");
  EXPECT_EQ(image_complaint("P2 0 3 255\n"), "x.png: 0 × 3 pixels, at least 1 × 1");
  EXPECT_EQ(image_complaint("P5 99999999999 1 255\n"), "x.png: the width is above 9999999");
  EXPECT_EQ(image_complaint(hollow_jpeg(20000, 20000)),
            "x.png: 20000 × 20000 pixels, at most 16384 a side");
  EXPECT_EQ(image_complaint(hollow_jpeg(0, 8)),
            "x.png: damaged JPEG: Empty JPEG image (DNL not supported)");
  cv::Mat one(1, 1, CV_8UC1, cv::Scalar(0));
  std::string bmp = encoded(".bmp", one);
  bmp.replace(18, 8, "\x20\x4e\0\0\x20\x4e\0\0"s);
  EXPECT_TRUE(test::is_one_line_naming(image_complaint(bmp), "x.png",
                                       {"20000 × 20000", "pixels", "16384", "side"}));
}

TEST(ImageErrors, DamageIsNamed) {
  std::string flipped = test::png(1, 1, 8, test::grey, "\0\x2a"s);
  flipped[45] = static_cast<char>(flipped[45] ^ 1);
  EXPECT_EQ(image_complaint(flipped), "x.png: damaged PNG: IDAT stream error");
  EXPECT_EQ(image_complaint(test::png_signature + test::chunk("IEND", "")),
            "x.png: damaged PNG: end of stream");
  EXPECT_EQ(image_complaint(test::png(9000, 7000, 8, test::grey, "\0\1"s)),
            "x.png: damaged PNG: IDAT stream too short");
  std::string text = test::png(1, 1, 8, test::grey, "\0\x2a"s, test::chunk("tEXt", "a\0b"s));
  text[text.find("tEXt") + 4] = 'c';
  EXPECT_EQ(image_complaint(text), "x.png: damaged PNG: invalid chunk checksum");
  EXPECT_EQ(image_complaint("\xff\xd8\xff\xd9"), "x.png: truncated JPEG: no header of the picture");
  std::string jpeg = encoded(".jpg", cv::Mat(16, 16, CV_8UC1, cv::Scalar(200)));
  const std::string cut = jpeg.substr(0, jpeg.size() - 2);
  EXPECT_EQ(image_complaint(cut), "x.png: damaged JPEG: Premature end of JPEG file");
  jpeg.insert(jpeg.find("\xff\xda"), jpeg.substr(jpeg.find("\xff\xc0"), 13));
  EXPECT_EQ(image_complaint(jpeg),
            "x.png: damaged JPEG: Invalid JPEG file structure: two SOF markers");
  EXPECT_EQ(image_complaint("P5 2 2 255\nabc"),
            "x.png: truncated: 4 bytes of pixels expected, 3 there");
  EXPECT_EQ(image_complaint("P2 2 1 9\n1 "),
            "x.png: truncated: 3 bytes of pixels expected, 2 there");
  EXPECT_EQ(image_complaint("P2 2 1 9\n1 x"), "x.png: damaged: a sample is not a number");
  EXPECT_TRUE(
      test::is_one_line_naming(image_complaint("P2 2 1 9\n1 10"), "x.png", {"sample", "9"}));
  EXPECT_TRUE(test::is_one_line_naming(image_complaint("P5 1 1 0\n1"), "x.png", {"maximum", "0"}));
  EXPECT_TRUE(
      test::is_one_line_naming(image_complaint("P1 2 1\n12"), "x.png", {"pixel", "0", "1"}));
  std::string bmp = encoded(".bmp", cv::Mat(1, 1, CV_8UC1, cv::Scalar(0)));
  std::string colours = bmp;
  colours.replace(28, 2, "\x08\0"s).replace(46, 4, "\x2c\1\0\0"s);
  EXPECT_EQ(image_complaint(colours), "x.png: damaged BMP: a palette of 300 colours");
  bmp[30] = 1;
  EXPECT_TRUE(test::is_one_line_naming(image_complaint(bmp), "x.png", {"BMP", "pixels"}));
}

}  // namespace
}  // namespace microswarm::formats

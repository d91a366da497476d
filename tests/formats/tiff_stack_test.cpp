// SPDX-License-Identifier: Apache-2.0
// Stacks: descriptions of ImageJ and OME, the layout of large ImageJ files, cut files, samples of
// every type.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/samples.hpp"
#include "microswarm/formats/images/tiff.hpp"
#include "microswarm/formats/images/tiff_description.hpp"
#include "tests/files.hpp"
#include "tests/formats/tiff_writer.hpp"

namespace microswarm::formats {
namespace {

/// Six pixels of a page.
std::vector<std::uint8_t> page(int k) {
  std::vector<std::uint8_t> made;
  for (int i = 0; i < 6; ++i) made.push_back(static_cast<std::uint8_t>(10 * k + i));
  return made;
}

std::string imagej(int images, const std::string& more = {}) {
  return "ImageJ=1.53t\nimages=" + std::to_string(images) + "\n" + more;
}

/// One directory, and the samples of more pages right behind the first's, as ImageJ writes them.
template <class Sample>
std::string one_directory(const test::Folder& folder, int images, const char* mode) {
  std::vector<Sample> samples(6 * static_cast<std::size_t>(images));
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = static_cast<Sample>(i * (sizeof(Sample) > 1 ? 300 : 1));
  // A page of all rows, whose length becomes that of the first.
  test::write_tiff<Sample>(folder / "a.tif", 3, {samples},
                           {.description = imagej(images), .mode = mode});
  std::string bytes = read_file(folder / "a.tif");
  const bool big = bytes[0] == 'M';
  const auto number = [&](std::size_t at, std::size_t size) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8 | static_cast<unsigned char>(bytes[at + (big ? i : size - 1 - i)]);
    return value;
  };
  const std::size_t directory = number(4, 4);
  for (std::size_t i = 0; i < number(directory, 2); ++i) {
    const std::size_t at = directory + 2 + 12 * i, tag = number(at, 2);
    const std::size_t bytes_of_page = 6 * sizeof(Sample);
    const std::size_t value = tag == TIFFTAG_STRIPBYTECOUNTS ? bytes_of_page : 2;
    if (tag != TIFFTAG_IMAGELENGTH && tag != TIFFTAG_STRIPBYTECOUNTS && tag != TIFFTAG_ROWSPERSTRIP)
      continue;
    const std::size_t size = number(at + 2, 2) == TIFF_SHORT ? 2 : 4;
    for (std::size_t k = 0; k < size; ++k)
      bytes[at + 8 + (big ? size - 1 - k : k)] = static_cast<char>(value >> (8 * k));
  }
  return bytes;
}

TEST(TiffStack, OneDirectoryOfImageJHoldsAllPages) {
  const test::Folder folder;
  for (const char* mode : {"wl", "wb"}) {
    const std::string of_8 = one_directory<std::uint8_t>(folder, 12, mode);
    TiffPages eight(test::bytes_of(of_8), "a.tif");
    ASSERT_EQ(eight.count(), 12) << mode;
    EXPECT_EQ(eight.why_fewer(), "");
    const std::string of_16 = one_directory<std::uint16_t>(folder, 12, mode);
    const auto file = folder.with("b.tif", of_16);
    TiffPages deep(file);
    ASSERT_EQ(deep.count(), 12) << mode;
    const std::string of_32 = one_directory<std::uint32_t>(folder, 12, mode);
    TiffPages real(test::bytes_of(of_32), "c.tif");
    ASSERT_EQ(real.count(), 12) << mode;
    for (int k = 0; k < 12; ++k) {
      const Image image = std::get<Image>(eight.next());
      EXPECT_EQ(image.height, 2);
      EXPECT_EQ(image.pixels[4], 6 * k + 4);
      EXPECT_EQ(std::get<DeepImage>(deep.next()).samples.at(4), 300 * (6 * k + 4)) << mode;
      EXPECT_EQ(std::get<RealImage>(real.next()).samples.at(5),
                static_cast<float>(300 * (6 * k + 5)))
          << mode;
    }
  }
}

TEST(TiffStack, ACutLayoutOfOneDirectorySaysHowManyAreThere) {
  const test::Folder folder;
  // The directory stands before the pages, as ImageJ writes it.
  std::string whole = one_directory<std::uint8_t>(folder, 12, "wl");
  std::uint32_t strip = 0;
  std::memcpy(&strip, &whole[4], 4);
  ASSERT_GT(strip, 72U);  // libtiff wrote the samples first
  const std::string more = whole.substr(8, 72);
  std::string cut = whole;
  const auto begin = static_cast<std::uint32_t>(cut.size());
  const std::size_t at = cut.find(std::string("\x11\x01\x04\0", 4));  // StripOffsets
  ASSERT_NE(at, std::string::npos);
  std::memcpy(&cut[at + 8], &begin, 4);
  cut += more.substr(0, 6 * 5 + 3);
  TiffPages pages(test::bytes_of(cut), "a.tif");
  EXPECT_EQ(pages.count(), 5);
  EXPECT_EQ(pages.why_fewer(), "a.tif: ImageJ states 12 pictures in it, 5 are there");
  for (int k = 0; k < 5; ++k) EXPECT_EQ(std::get<Image>(pages.next()).pixels[0], 6 * k);
}

TEST(TiffStack, ACutListOfPagesIsTold) {
  const test::Folder folder;
  for (const std::string& description : {std::string(), imagej(12)}) {
    std::vector<std::vector<std::uint8_t>> all;
    for (int k = 0; k < 12; ++k) all.push_back(page(k));
    test::write_tiff<std::uint8_t>(folder / "a.tif", 3, all, {.description = description});
    const std::string whole = read_file(folder / "a.tif");
    EXPECT_EQ(TiffPages(test::bytes_of(whole), "a.tif").why_fewer(), "");
    const std::string half = whole.substr(0, whole.size() / 2);
    const TiffPages pages(test::bytes_of(half), "a.tif");
    EXPECT_GT(pages.count(), 3);
    EXPECT_LT(pages.count(), 8);
    EXPECT_EQ(pages.why_fewer(), "a.tif: the list of its pictures breaks off after " +
                                     std::to_string(pages.count()) + ": it is cut or damaged");
    const TiffPages of_file(folder.with("half.tif", half));
    EXPECT_EQ(of_file.count(), pages.count());
    EXPECT_NE(of_file.why_fewer(), "");
  }
}

/// The pages of ImageJ and tifffile lie behind each other, the other directories at the end.
TEST(TiffStack, AFileThatIsCutInItsDirectoriesHasItsPages) {
  const test::Folder folder;
  std::string whole = one_directory<std::uint8_t>(folder, 12, "wl");
  const auto begin = static_cast<std::uint32_t>(whole.size());
  const std::size_t offset = whole.find(std::string("\x11\x01\x04\0", 4));  // StripOffsets
  ASSERT_NE(offset, std::string::npos);
  std::memcpy(&whole[offset + 8], &begin, 4);
  for (char k = 0; k < 12 * 6; ++k) whole += k;
  const auto told = [&](std::uint32_t second) {
    std::uint32_t first = 0;
    std::uint16_t entries = 0;
    std::memcpy(&first, &whole[4], 4);
    std::memcpy(&entries, &whole[first], 2);
    std::memcpy(&whole[first + 2 + 12U * entries], &second, 4);
  };
  told(begin + 12 * 6);  // behind all pages, and cut
  TiffPages pages(test::bytes_of(whole), "a.tif");
  ASSERT_EQ(pages.count(), 12);
  EXPECT_EQ(pages.why_fewer(), "");
  ASSERT_EQ(pages.notes().size(), 1u);
  EXPECT_NE(pages.notes()[0].find("is cut"), std::string::npos);
  for (int k = 0; k < 12; ++k) EXPECT_EQ(std::get<Image>(pages.next()).pixels[0], 6 * k);
  const std::string cut = whole.substr(0, whole.size() - 9);
  EXPECT_EQ(TiffPages(test::bytes_of(cut), "a.tif").count(), 10);
  EXPECT_EQ(TiffPages(test::bytes_of(cut), "a.tif").why_fewer(),
            "a.tif: ImageJ states 12 pictures in it, 10 are there: it is cut or damaged");
  // What lies between is not known where the second directory is said to lie among the pages.
  told(begin + 12 * 6 - 1);
  const std::string among = whole.substr(0, whole.size() - 9);
  EXPECT_EQ(TiffPages(test::bytes_of(among), "a.tif").count(), 1);
}

/// Writers of stacks put the tag in the first directory only.
TEST(TiffStack, PagesWithoutATagAreTurnedAsTheFirst) {
  const test::Folder folder;
  const auto file = folder / "a.tif";
  TIFF* tiff = TIFFOpen(file.c_str(), "w");
  ASSERT_TRUE(tiff);
  for (int k = 0; k < 3; ++k) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 3);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 8);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    if (k == 0) TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPRIGHT);
    if (k == 2) TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    std::uint8_t row[] = {1, 2, 3};
    TIFFWriteScanline(tiff, row, 0, 0);
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
  TiffPages pages(file);
  using Greys = std::vector<std::uint8_t>;
  EXPECT_EQ(std::get<Image>(pages.next()).pixels, (Greys{3, 2, 1}));
  EXPECT_EQ(std::get<Image>(pages.next()).pixels, (Greys{3, 2, 1}));
  EXPECT_EQ(std::get<Image>(pages.next()).pixels, (Greys{1, 2, 3}));
}

TEST(TiffStack, PagesThatAreMissingAtAPageAreTold) {
  const test::Folder folder;
  test::write_tiff<std::uint8_t>(folder / "a.tif", 3, {page(0), page(1)},
                                 {.description = imagej(3)});
  EXPECT_EQ(TiffPages(folder / "a.tif").why_fewer(),
            (folder / "a.tif").string() + ": ImageJ states 3 pictures in it, 2 are there");
}

TEST(TiffDescription, OfImageJTellsScaleIntervalAndOrder) {
  const auto told = parse_tiff_description(
      imagej(40, "channels=2\nslices=4\nframes=5\nhyperstack=true\nunit=micron\nfinterval=0.25\n"),
      4, 2);
  EXPECT_EQ(told.software, "ImageJ");
  EXPECT_EQ(told.channels, 2);
  EXPECT_EQ(told.slices, 4);
  EXPECT_EQ(told.times, 5);
  EXPECT_EQ(told.order, "CZT");
  EXPECT_EQ(told.um_per_px, 0.25);
  EXPECT_EQ(told.um_per_px_y, 0.5);
  EXPECT_EQ(told.interval, 0.25);
  const auto other = parse_tiff_description(
      imagej(6, "channels=2\nunit=nm\nfinterval=40\ntunit=ms\n"), 0.01F, 0.01F);
  EXPECT_EQ(other.times, 3);
  EXPECT_NEAR(other.um_per_px.value_or(0), 0.1, 1e-6);
  EXPECT_NEAR(other.interval.value_or(0), 0.04, 1e-12);
  for (const std::string unit : {"um", "\xC2\xB5m", "\\u00B5m"})
    EXPECT_EQ(parse_tiff_description(imagej(2, "unit=" + unit + "\n"), 2, 2).um_per_px, 0.5)
        << unit;
  // No scale of a microscope, and no interval.
  const auto screen = parse_tiff_description(imagej(2, "unit=inch\nfinterval=0\nfps=7\n"), 72, 72);
  EXPECT_FALSE(screen.um_per_px || screen.interval);
  EXPECT_EQ(parse_tiff_description("a note", 72, 72).software, "");
}

TEST(TiffDescription, OfOmeTellsScaleTimesAndOrder) {
  const auto told = parse_tiff_description(
      R"(<?xml version="1.0"?><OME><Image><Pixels DimensionOrder="XYZTC" SizeC="2" SizeZ="1" SizeT="3"
         PhysicalSizeX="650" PhysicalSizeXUnit="nm" PhysicalSizeY="0.65" TimeIncrement="100"
         TimeIncrementUnit="ms"><Channel SamplesPerPixel="1"/>
         <Plane TheC="1" TheZ="0" TheT="0" DeltaT="0.5"/><Plane TheC="1" TheZ="0" TheT="2" DeltaT="900"
         DeltaTUnit="ms"/></Pixels></Image></OME>)",
      0, 0);
  EXPECT_EQ(told.software, "OME");
  EXPECT_EQ(told.images, 6);
  EXPECT_EQ(told.channels, 2);
  EXPECT_EQ(told.times, 3);
  EXPECT_EQ(told.order, "ZTC");
  EXPECT_NEAR(told.um_per_px.value_or(0), 0.65, 1e-12);
  EXPECT_NEAR(told.um_per_px_y.value_or(0), 0.65, 1e-12);
  EXPECT_NEAR(told.interval.value_or(0), 0.1, 1e-12);
  ASSERT_EQ(told.page_times.size(), 6U);
  EXPECT_FALSE(told.page_times[0]);
  EXPECT_EQ(told.page_times[3], 0.5);
  EXPECT_NEAR(told.page_times[5].value_or(0), 0.9, 1e-12);
  // Three samples of one channel are colours, not channels.
  EXPECT_EQ(
      parse_tiff_description(
          R"(<OME><Image><Pixels SizeC="3" SizeZ="1" SizeT="2"><Channel SamplesPerPixel="3"/></Pixels></Image></OME>)",
          0, 0)
          .channels,
      1);
  for (const std::string bad : {"<OME", "<OME><Image></OME>", "<OME/>"})
    EXPECT_EQ(parse_tiff_description(bad, 0, 0).images, 1) << bad;
}

/// What a picture of these samples becomes, and the note.
template <class Sample>
ReadPicture read_samples(const std::vector<Sample>& samples, int format) {
  const test::Folder folder;
  test::write_tiff<Sample>(folder / "a.tif", static_cast<int>(samples.size()), {samples},
                           {.format = format});
  ReadPicture picture = read_picture(folder / "a.tif");
  for (std::string& note : picture.notes) note = note.substr(note.find(".tif: ") + 6);
  return picture;
}

using Greys = std::vector<std::uint8_t>;
using Notes = std::vector<std::string>;

TEST(TiffSamples, OfEveryTypeAreScaledAndToldSo) {
  const auto floats = read_samples<float>({-0.5F, 0.0F, 1.5F}, SAMPLEFORMAT_IEEEFP);
  EXPECT_EQ(floats.image.pixels, (Greys{0, 64, 255}));
  EXPECT_EQ(floats.notes,
            (Notes{"its 32-bit float samples are scaled: -0.5 is black, 1.5 is white"}));
  EXPECT_EQ(floats.black, -0.5);
  EXPECT_EQ(floats.white, 1.5);
  const auto doubles = read_samples<double>({0, 0.25, 1}, SAMPLEFORMAT_IEEEFP);
  EXPECT_EQ(doubles.image.pixels, (Greys{0, 64, 255}));
  const auto signs = read_samples<std::int16_t>({-100, 0, 300}, SAMPLEFORMAT_INT);
  EXPECT_EQ(signs.image.pixels, (Greys{0, 64, 255}));
  EXPECT_EQ(signs.notes,
            (Notes{"its signed 16-bit samples are scaled: -100 is black, 300 is white"}));
  EXPECT_EQ(read_samples<std::int8_t>({-100, 100}, SAMPLEFORMAT_INT).image.pixels, (Greys{0, 255}));
  const auto wide = read_samples<std::uint32_t>({0, 1'000'000, 2'000'000}, SAMPLEFORMAT_UINT);
  EXPECT_EQ(wide.image.pixels, (Greys{0, 128, 255}));
  EXPECT_EQ(read_samples<std::int32_t>({-2, 2}, SAMPLEFORMAT_INT).image.pixels, (Greys{0, 255}));
  const auto twelve = read_samples<std::uint16_t>({0, 2048, 4095}, SAMPLEFORMAT_UINT);
  EXPECT_EQ(twelve.image.pixels, (Greys{0, 128, 255}));
  EXPECT_EQ(twelve.notes,
            (Notes{"its 16-bit samples are read as numbers of 12 bits: 4095 is white"}));
  EXPECT_EQ(read_samples<std::uint16_t>({0, 40000}, SAMPLEFORMAT_UINT).notes, Notes{});
}

TEST(TiffSamples, WholeNumbersAreThoseOfAnIntegerPicture) {
  const std::vector<std::uint16_t> numbers{0, 7, 128, 255};
  const Greys as_integers = read_samples(numbers, SAMPLEFORMAT_UINT).image.pixels;
  EXPECT_EQ(as_integers, (Greys{0, 7, 128, 255}));
  EXPECT_EQ(read_samples<float>({0, 7, 128, 255}, SAMPLEFORMAT_IEEEFP).image.pixels, as_integers);
  EXPECT_EQ(read_samples<std::int16_t>({0, 7, 128, 255}, SAMPLEFORMAT_INT).image.pixels,
            as_integers);
  EXPECT_EQ(read_samples<std::uint32_t>({0, 7, 128, 255}, SAMPLEFORMAT_UINT).image.pixels,
            as_integers);
  EXPECT_EQ(read_samples<float>({0, 1}, SAMPLEFORMAT_IEEEFP).image.pixels, (Greys{0, 255}));
}

TEST(TiffSamples, ThatAreNoNumbersAreBlack) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  const float endless = std::numeric_limits<float>::infinity();
  EXPECT_EQ(
      read_samples<float>({none, 0.5F, 1.5F, endless, -endless}, SAMPLEFORMAT_IEEEFP).image.pixels,
      (Greys{0, 0, 255, 255, 0}));
  EXPECT_EQ(read_samples<float>({none, none}, SAMPLEFORMAT_IEEEFP).image.pixels, (Greys{0, 0}));
}

TEST(TiffSamples, OfOtherTypesAreRefusedWithAdvice) {
  const test::Folder folder;
  test::write_tiff<std::uint16_t>(folder / "half.tif", 2, {{1, 2}},
                                  {.format = SAMPLEFORMAT_IEEEFP});
  const std::string error = test::error_of([&] { read_image(folder / "half.tif"); });
  EXPECT_NE(error.find("half.tif: picture 0 has float samples of 16 bits, which are not read: save "
                       "it with 8 or 16 bits, or as 32-bit float"),
            std::string::npos)
      << error;
}

TEST(TiffStack, AsAPictureIsItsFirstPageAndSaysSo) {
  const test::Folder folder;
  test::write_tiff<std::uint8_t>(folder / "a.tif", 3, {page(0), page(1)},
                                 {.description = imagej(2, "unit=um\n"), .resolution = 2});
  const ReadPicture picture = read_picture(folder / "a.tif");
  EXPECT_EQ(picture.image.pixels, page(0));
  EXPECT_EQ(picture.um_per_px, 0.5);
  EXPECT_EQ(picture.notes,
            (Notes{(folder / "a.tif").string() + ": holds 2 pictures, the first is taken"}));
}

}  // namespace
}  // namespace microswarm::formats

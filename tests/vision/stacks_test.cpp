// SPDX-License-Identifier: Apache-2.0
// Order and times of pictures by descriptions in a TIFF.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "microswarm/core/text/file.hpp"
#include "microswarm/vision/camera/frames.hpp"
#include "microswarm/vision/camera/stack_pages.hpp"
#include "tests/files.hpp"
#include "tests/formats/tiff_writer.hpp"
#include "tests/vision/seen.hpp"

namespace microswarm::vision {
namespace {

/// A stack whose page k has the grey k, with a description of ImageJ.
fs::path stack(const test::Folder& folder, int pages, const std::string& more) {
  std::vector<std::vector<std::uint8_t>> all;
  for (int k = 0; k < pages; ++k) all.emplace_back(4, static_cast<std::uint8_t>(k));
  test::write_tiff<std::uint8_t>(
      folder / "s.tif", 2, all,
      {.description = "ImageJ=1.53t\nimages=" + std::to_string(pages) + "\n" + more,
       .resolution = 4});
  return folder / "s.tif";
}

TEST(Stacks, HaveTheScaleAndIntervalOfTheirDescription) {
  const test::Folder folder;
  const auto file = stack(folder, 3, "frames=3\nunit=micron\nfinterval=0.25\n");
  EXPECT_EQ(open_frames(file)->um_per_px(), 0.25);
  const Seen seen = see(file);
  EXPECT_EQ(seen.times, (std::vector<double>{0, 0.25, 0.5}));
  EXPECT_EQ(seen.notes, (std::vector<std::string>{file.string() +
                                                  ": pictures are 0.25 s apart, as ImageJ says"}));
  const Seen given = see(file, {.rate = 10});
  EXPECT_EQ(given.times[2], 0.2);
  EXPECT_EQ(given.notes, std::vector<std::string>{});
}

TEST(Stacks, OfSeveralChannelsGiveTheOneThatIsChosen) {
  const test::Folder folder;
  const auto file = stack(folder, 12, "channels=2\nslices=3\nframes=2\nfinterval=1\n");
  const auto error = [&](const FrameOptions& options) {
    return test::error_of([&] { see(file, options); });
  };
  EXPECT_EQ(error({}), file.string() +
                           ": holds 2 channels of 12 pictures in all: choose one with "
                           "stack_channel, 1 to 2");
  EXPECT_EQ(
      error({.stack_channel = 1}),
      file.string() + ": holds 3 slices of 12 pictures in all: choose one with slice, 1 to 3");
  EXPECT_EQ(error({.stack_channel = 3}),
            file.string() + ": stack_channel is 3, the stack has 2 channels");
  EXPECT_EQ(see(file, {.stack_channel = 1, .slice = 1}).greys, (std::vector<int>{0, 6}));
  EXPECT_EQ(see(file, {.stack_channel = 2, .slice = 3}).greys, (std::vector<int>{5, 11}));
}

TEST(Stacks, WithSlicesAloneAreSeries) {
  const test::Folder folder;
  const auto file = stack(folder, 4, "slices=4\n");
  const Seen seen = see(file);
  EXPECT_EQ(seen.greys, (std::vector<int>{0, 1, 2, 3}));
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("its 4 slices are taken as times"), std::string::npos);
  EXPECT_EQ(see(file, {.slice = 3}).greys, (std::vector<int>{2}));
  const auto two = stack(folder, 6, "channels=2\nslices=3\n");
  EXPECT_EQ(see(two, {.stack_channel = 2}).greys, (std::vector<int>{1, 3, 5}));
}

/// The order of ImageJ's pages is always the same; of others a description whose product is not its
/// own count, or not that of its planes, tells no order.
TEST(Stacks, OfContradictingCounts) {
  const test::Folder folder;
  const auto file = stack(folder, 5, "channels=2\nframes=3\n");
  EXPECT_NE(test::error_of([&] { see(file); }).find("stack_channel, 1 to 2"), std::string::npos);
  const Seen seen = see(file, {.stack_channel = 2});
  EXPECT_EQ(seen.greys, (std::vector<int>{1, 3}));
  ASSERT_EQ(seen.notes.size(), 1U);
  EXPECT_NE(seen.notes[0].find("2 channels, 1 slices and 3 times of 5 pictures"), std::string::npos)
      << seen.notes[0];
  EXPECT_EQ(see(stack(folder, 6, "channels=2\nframes=2\n"), {.stack_channel = 1}).greys,
            (std::vector<int>{0, 2, 4}));
  const formats::TiffDescription other{
      .software = "SCIFIO", .images = 5, .channels = 2, .times = 3};
  EXPECT_NE(test::error_of([&] {
              choose_pages(other, 5, {.stack_channel = 1}, "s.tif");
            }).find("does not fit"),
            std::string::npos);
  const formats::TiffDescription planes{
      .software = "OME", .images = 2, .times = 3, .plane_pages = {1, 0}};
  EXPECT_EQ(choose_pages(planes, 2, {}, "s.tif").pages, (std::vector<int>{0, 1}));
}

TEST(Stacks, OfOmeHaveTheTimesOfTheirPlanes) {
  const test::Folder folder;
  std::string planes;
  for (int k = 0; k < 6; ++k)
    planes += "<Plane TheC=\"" + std::to_string(k / 3) + "\" TheZ=\"0\" TheT=\"" +
              std::to_string(k % 3) + "\" DeltaT=\"" + std::to_string(2 + k * k) + "\"/>";
  std::vector<std::vector<std::uint8_t>> pages;
  for (int k = 0; k < 6; ++k) pages.emplace_back(4, static_cast<std::uint8_t>(k));
  test::write_tiff<std::uint8_t>(
      folder / "s.tif", 2, pages,
      {.description =
           "<OME><Image><Pixels DimensionOrder=\"XYZTC\" SizeC=\"2\" SizeZ=\"1\" SizeT=\"3\" "
           "PhysicalSizeX=\"0.5\"><Channel/>" +
           planes + "</Pixels></Image></OME>"});
  const Seen seen = see(folder / "s.tif", {.stack_channel = 2});
  EXPECT_EQ(seen.greys, (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(seen.times, (std::vector<double>{0, 7, 16}));
  EXPECT_EQ(open_frames(folder / "s.tif", FrameOptions{.stack_channel = 1})->um_per_px(), 0.5);
}

/// Times that do not ascend, or that a picture lacks, are no times: the interval is taken.
TEST(Stacks, OfOmeHaveAscendingTimesOrNone) {
  for (const std::vector<std::string>& told :
       {std::vector<std::string>{"5", "3", "4"}, {"5", "5", "6"}, {"1", "2", "2"}}) {
    std::string planes;
    for (std::size_t k = 0; k < told.size(); ++k)
      planes += "<Plane TheC=\"0\" TheZ=\"0\" TheT=\"" + std::to_string(k) + "\" DeltaT=\"" +
                told[k] + "\"/>";
    const test::Folder folder;
    std::vector<std::vector<std::uint8_t>> pages(3, std::vector<std::uint8_t>(4));
    test::write_tiff<std::uint8_t>(
        folder / "s.tif", 2, pages,
        {.description = "<OME><Image><Pixels DimensionOrder=\"XYZTC\" SizeC=\"1\" SizeZ=\"1\" "
                        "SizeT=\"3\" TimeIncrement=\"0.5\">" +
                        planes + "</Pixels></Image></OME>"});
    EXPECT_EQ(see(folder / "s.tif").times, (std::vector<double>{0, 0.5, 1})) << told[0] << told[1];
  }
}

/// A stack whose page k has the grey k, with any description.
fs::path described(const test::Folder& folder, const std::string& name, int pages,
                   const std::string& description) {
  std::vector<std::vector<std::uint8_t>> all;
  for (int k = 0; k < pages; ++k) all.emplace_back(4, static_cast<std::uint8_t>(k));
  test::write_tiff<std::uint8_t>(folder / name, 2, all, {.description = description});
  return folder / name;
}

/// OME of one image with these TiffData.
std::string ome(int channels, int times, const std::string& data, const std::string& prefix = "") {
  const std::string p = prefix.empty() ? "" : prefix + ":";
  return "<" + p + "OME xmlns" + (prefix.empty() ? "" : ":" + prefix) +
         "=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\"><" + p + "Image><" + p +
         "Pixels DimensionOrder=\"XYCZT\" SizeC=\"" + std::to_string(channels) +
         "\" SizeZ=\"1\" SizeT=\"" + std::to_string(times) + "\" TimeIncrement=\"0.5\">" + data +
         "</" + p + "Pixels></" + p + "Image></" + p + "OME>";
}

std::string tiff_data(int c, int t, int page, const std::string& file = "") {
  return "<TiffData FirstC=\"" + std::to_string(c) + "\" FirstT=\"" + std::to_string(t) +
         "\" IFD=\"" + std::to_string(page) + "\" PlaneCount=\"1\">" +
         (file.empty() ? "" : "<UUID FileName=\"" + file + "\">urn:uuid:" + file + "</UUID>") +
         "</TiffData>";
}

bool any_names(const std::vector<std::string>& notes, std::string_view what) {
  return std::ranges::any_of(notes, [&](const auto& n) { return n.find(what) != n.npos; });
}

TEST(Stacks, OfOmeAreInTheOrderOfTheirTiffData) {
  const test::Folder folder;
  std::string back, half;
  for (int t = 0; t < 5; ++t) back += tiff_data(0, t, 4 - t);
  const Seen seen = see(described(folder, "b.ome.tif", 5, ome(1, 5, back)));
  EXPECT_EQ(seen.greys, (std::vector<int>{4, 3, 2, 1, 0}));
  EXPECT_EQ(seen.times, (std::vector<double>{0, 0.5, 1, 1.5, 2}));
  // Some order that is neither up nor down, and a run.
  const std::string mixed = tiff_data(0, 0, 2) + tiff_data(0, 1, 0) + tiff_data(0, 2, 1) +
                            "<TiffData FirstT=\"3\" IFD=\"3\" PlaneCount=\"2\"/>";
  EXPECT_EQ(see(described(folder, "m.ome.tif", 5, ome(1, 5, mixed))).greys,
            (std::vector<int>{2, 0, 1, 3, 4}));
  EXPECT_EQ(see(described(folder, "a.ome.tif", 5, ome(1, 5, "<TiffData/>"))).greys,
            (std::vector<int>{0, 1, 2, 3, 4}));
  // What contradicts itself is not followed, and told.
  const Seen odd =
      see(described(folder, "o.ome.tif", 2, ome(1, 2, tiff_data(0, 0, 1) + tiff_data(0, 1, 1))));
  EXPECT_EQ(odd.greys, (std::vector<int>{0, 1}));
  EXPECT_TRUE(any_names(odd.notes, "two TiffData name the same picture"));
}

TEST(Stacks, OfOmeInSeveralFilesGiveThePicturesOfThisOne) {
  const test::Folder folder;
  std::string data, later;
  for (int t = 0; t < 4; ++t)
    for (int c = 0; c < 2; ++c) data += tiff_data(c, t, t, c == 0 ? "c0.ome.tif" : "c1.ome.tif");
  const auto file = described(folder, "c1.ome.tif", 4, ome(2, 4, data));
  for (const FrameOptions& options : {FrameOptions{}, FrameOptions{.stack_channel = 2}}) {
    const Seen seen = see(file, options);
    EXPECT_EQ(seen.greys, (std::vector<int>{0, 1, 2, 3}));
    EXPECT_EQ(seen.times, (std::vector<double>{0, 0.5, 1, 1.5}));
    EXPECT_EQ(seen.why_ended, "");
    EXPECT_TRUE(any_names(seen.notes, "c0.ome.tif"));
  }
  EXPECT_TRUE(any_names(see(file).notes, "of 2 channels only number 2"));
  EXPECT_NE(test::error_of([&] { see(file, {.stack_channel = 1}); }).find("c0.ome.tif"),
            std::string::npos);
  // Every second time is elsewhere.
  for (int t = 0; t < 4; ++t)
    later += tiff_data(0, t, t / 2, t % 2 == 0 ? "even.ome.tif" : "odd.ome.tif");
  const Seen even = see(described(folder, "even.ome.tif", 2, ome(1, 4, later)));
  EXPECT_EQ(even.times, (std::vector<double>{0, 1}));
  EXPECT_TRUE(any_names(even.notes, "gaps in time"));
  const Seen odd = see(described(folder, "odd.ome.tif", 2, ome(1, 4, later)));
  EXPECT_EQ(odd.times, (std::vector<double>{0, 1}));  // since the first that is here
}

TEST(Stacks, OfOmeInAFileWithOneSliceGiveThatSlice) {
  const test::Folder folder;
  std::string data = ome(2, 2, "");
  data.replace(data.find("SizeZ=\"1\""), 9, "SizeZ=\"2\"");
  data.replace(data.find("XYCZT"), 5, "XYZCT");
  std::string runs;
  for (int z = 0; z < 2; ++z)
    for (int c = 0; c < 2; ++c)
      for (int t = 0; t < 2; ++t) {
        std::string run = tiff_data(c, t, c + 2 * t, z == 0 ? "z0.ome.tif" : "z1.ome.tif");
        runs += run.insert(run.find(" IFD"), " FirstZ=\"" + std::to_string(z) + "\"");
      }
  data.insert(data.find("</Pixels>"), runs);
  const auto file = described(folder, "z1.ome.tif", 4, data);
  EXPECT_NE(test::error_of([&] { see(file); }).find("2 channels"), std::string::npos);
  const Seen seen = see(file, {.stack_channel = 2});
  EXPECT_EQ(seen.greys, (std::vector<int>{1, 3}));
  EXPECT_TRUE(any_names(seen.notes, "of 2 slices only number 2"));
}

TEST(Stacks, PicturesWithoutAPlaceInOmeAreLeftOutAndTold) {
  const test::Folder folder;
  const Seen seen =
      see(described(folder, "l.ome.tif", 4, ome(1, 2, tiff_data(0, 0, 0) + tiff_data(0, 1, 1))));
  EXPECT_EQ(seen.greys, (std::vector<int>{0, 1}));
  EXPECT_TRUE(any_names(seen.notes, "its last 2 pictures are not in what"));
}

TEST(Stacks, OfOmeMayHaveAPrefixOrAnotherFileForItsDescription) {
  const test::Folder folder;
  const Seen seen = see(described(folder, "p.ome.tif", 2, ome(1, 2, "", "ome")));
  EXPECT_EQ(seen.times, (std::vector<double>{0, 0.5}));
  const Seen binary = see(described(folder, "x.ome.tif", 2,
                                    "<OME><BinaryOnly MetadataFile=\"all.companion.ome\"/></OME>"));
  EXPECT_EQ(binary.greys, (std::vector<int>{0, 1}));
  EXPECT_TRUE(any_names(binary.notes, "all.companion.ome"));
  const std::string one = ome(1, 2, ""), more = one.substr(0, one.size() - 6);
  const std::string image =
      one.substr(one.find("<Image>"), one.rfind("</OME>") - one.find("<Image>"));
  const Seen series = see(described(folder, "s.ome.tif", 4, more + image + "</OME>"));
  EXPECT_EQ(series.greys, (std::vector<int>{0, 1}));
  EXPECT_TRUE(any_names(series.notes, "2 images"));
}

TEST(Stacks, OfTifffileAndScifioHaveChannelsToo) {
  const test::Folder folder;
  for (const std::string text :
       {R"({"shape": [3, 2, 2, 2], "axes": "TCYX"})",
        "SCIFIO=0.42\naxes=X,Y,Channel,Time\nlengths=2,2,2,3\nscales=1,1,1,0.5\n"
        "units=um,um,null,sec\n",
        "SCIFIO=0.42\nimages=6\nchannels=2\nframes=3\nfinterval=0.5\n"}) {
    const auto file = described(folder, "a.tif", 6, text);
    EXPECT_NE(test::error_of([&] { see(file); }).find("2 channels"), std::string::npos) << text;
    const Seen seen = see(file, {.stack_channel = 2});
    EXPECT_EQ(seen.greys, (std::vector<int>{1, 3, 5})) << text;
    EXPECT_EQ(seen.times[1], text[0] == '{' ? 1 : 0.5) << text;
  }
  const auto slow = described(folder, "b.tif", 6, R"({"shape": [2, 3, 2, 2], "axes": "CTYX"})");
  EXPECT_EQ(see(slow, {.stack_channel = 2}).greys, (std::vector<int>{3, 4, 5}));
  const auto depth = described(folder, "z.tif", 6, R"({"shape": [2, 3, 2, 2], "axes": "CZYX"})");
  EXPECT_EQ(see(depth, {.stack_channel = 2}).greys, (std::vector<int>{3, 4, 5}));
  const Seen plain = see(described(folder, "c.tif", 3, R"({"shape": [3, 2, 2]})"));
  EXPECT_EQ(plain.greys, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(plain.notes, std::vector<std::string>{});
  EXPECT_TRUE(any_names(see(described(folder, "d.tif", 6, R"({"shape": [3, 2, 2, 2]})")).notes,
                        "without their names"));
}

TEST(Stacks, ThatAreCutEndWithAReason) {
  const test::Folder folder;
  const std::string whole = read_file(stack(folder, 12, "frames=12\n"));
  const auto file = folder.with("cut.tif", whole.substr(0, whole.size() / 2));
  const Seen seen = see(file);
  EXPECT_GT(seen.times.size(), 3U);
  EXPECT_LT(seen.times.size(), 9U);
  EXPECT_NE(seen.why_ended.find("cut.tif: "), std::string::npos);
}

TEST(Stacks, KeepTheScaleOfTheirFirstPictureAndSayWhatIsCut) {
  const test::Folder folder;
  test::write_tiff<float>(folder / "s.tif", 2, {{0.5F, 1.5F}, {1, 2}},
                          {.format = SAMPLEFORMAT_IEEEFP});
  const auto frames = open_frames(folder / "s.tif");
  VideoFrame frame;
  ASSERT_TRUE(frames->next(frame));
  EXPECT_EQ(frame.picture.pixels, (std::vector<std::uint8_t>{0, 255}));
  ASSERT_TRUE(frames->next(frame));
  EXPECT_EQ(frame.picture.pixels, (std::vector<std::uint8_t>{128, 255}));
  const auto notes = frames->notes();
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("0.5 is black, 1.5 is white"), std::string::npos);
  EXPECT_NE(notes[1].find("1 of 2 pictures have samples beyond"), std::string::npos);
}

}  // namespace
}  // namespace microswarm::vision

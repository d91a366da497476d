// SPDX-License-Identifier: Apache-2.0
// Stacks and photographs in which ImageJ wrote scale, interval and channels.
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>

#include "inputs.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

class ImageJ : public CommandLine {};

/// Little-endian bytes of a number.
std::string bytes_of_number(std::uint32_t value, int size) {
  std::string bytes;
  for (int k = 0; k < size; ++k) bytes += static_cast<char>(value >> (8 * k));
  return bytes;
}

/// A TIFF in which ImageJ describes grey pages of 8 bits, 4 pixels a unit.
std::string imagej_tiff(int width, int height, int pages, std::string description,
                        const std::function<int(int, int, int)>& grey) {
  description.insert(0, "ImageJ=1.53t\nimages=" + std::to_string(pages) + "\n");
  std::string file = "II*" + std::string(1, '\0') + std::string(4, '\0');
  std::size_t link = 4;
  const auto place = [&] { return static_cast<std::uint32_t>(file.size()); };
  for (int k = 0; k < pages; ++k) {
    const std::uint32_t samples = place();
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) file += static_cast<char>(grey(k, x, y));
    const std::uint32_t text = place();
    file += description + std::string(2 - description.size() % 2, '\0');
    const std::uint32_t ratio = place();
    file += bytes_of_number(4, 4) + bytes_of_number(1, 4);
    file.replace(link, 4, bytes_of_number(place(), 4));
    struct Tag {
      std::uint32_t tag, type, count, value;
    };
    const std::vector<Tag> tags{{256, 4, 1, static_cast<std::uint32_t>(width)},
                                {257, 4, 1, static_cast<std::uint32_t>(height)},
                                {258, 3, 1, 8},
                                {259, 3, 1, 1},
                                {262, 3, 1, 1},
                                {270, 2, static_cast<std::uint32_t>(description.size() + 1), text},
                                {273, 4, 1, samples},
                                {277, 3, 1, 1},
                                {278, 4, 1, static_cast<std::uint32_t>(height)},
                                {279, 4, 1, static_cast<std::uint32_t>(width * height)},
                                {282, 5, 1, ratio},
                                {283, 5, 1, ratio}};
    file += bytes_of_number(static_cast<std::uint32_t>(tags.size()), 2);
    for (const Tag& t : tags)
      file += bytes_of_number(t.tag, 2) + bytes_of_number(t.type, 2) + bytes_of_number(t.count, 4) +
              bytes_of_number(t.value, 4);
    link = file.size();
    file += std::string(4, '\0');
  }
  return file;
}

TEST_F(ImageJ, WhatItWroteIntoAStackIsUsedAndTold) {
  const auto disc = [](int k, int x, int y) {
    const double dx = x - (30 + k), dy = y - 30;
    return dx * dx + dy * dy < 20 ? 90 : 200;
  };
  write("s.tif", imagej_tiff(80, 60, 12, "frames=12\nunit=micron\nfinterval=0.5\n", disc));
  const Outcome told = run({"track", "s.tif", "--out", "out", "--no-overlay", "--json"});
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_TRUE(names(told.err, "s.tif: a pixel is 0.25 µm, as the file says")) << told.err;
  EXPECT_TRUE(names(told.err, "s.tif: pictures are 0.5 s apart, as ImageJ says")) << told.err;
  EXPECT_NEAR(Json::parse(told.out).at("mean_speed_um_per_s"), 0.5, 0.005);
  const Outcome given = run({"track", "s.tif", "--um-per-px", "1", "--rate", "10", "--out", "out",
                             "--no-overlay", "--json"});
  EXPECT_EQ(given.err, "");
  EXPECT_NEAR(Json::parse(given.out).at("mean_speed_um_per_s"), 10, 0.1);
  write("c.tif", imagej_tiff(80, 60, 24, "channels=2\nframes=12\nunit=um\nfinterval=1\n",
                             [&](int k, int x, int y) { return disc(k % 2 ? k / 2 : 0, x, y); }));
  refused({"track", "c.tif", "--out", "out"}, naming("c.tif", {"2 channels", "stack_channel"}));
  const auto speed = [&](const std::string& channel) {
    const Outcome o = run({"track", "c.tif", "--out", "out", "--no-overlay", "--json", "--set",
                           "stack_channel=" + channel});
    EXPECT_EQ(o.code, 0) << o.err;
    return Json::parse(o.out).at("mean_speed_um_per_s").get<double>();
  };
  EXPECT_NEAR(speed("1"), 0, 0.005);
  EXPECT_NEAR(speed("2"), 0.25, 0.005);
}

TEST_F(ImageJ, APhotographHasItsScale) {
  write("p.tif", imagej_tiff(200, 120, 1, "unit=micron\n", [](int, int x, int y) {
          return (y > 40 && y < 80 ? 80 : 180) + (x * 7 + y * 13) % 5;
        }));
  const Outcome outcome = run({"map", "segment", "p.tif", "--out", "p.geojson", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "p.tif: a pixel is 0.25 µm, as the file says")) << outcome.err;
  EXPECT_NEAR(Json::parse(outcome.out).at("wide_width_um"), 10, 2);
}

}  // namespace
}  // namespace microswarm::test

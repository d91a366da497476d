// SPDX-License-Identifier: Apache-2.0
// The place of an issue is its file.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "microswarm/formats/choose_map_spec.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/formats/tracks.hpp"
#include "tests/files.hpp"

namespace microswarm::formats {
namespace {

/// Expects one issue "PLACE: TEXT"; the place is the file, or a line of it.
void expect_place(const std::filesystem::path& file, const std::function<void()>& read) {
  SCOPED_TRACE(file);
  const Issues issues = test::issues_of(read);
  ASSERT_EQ(issues.size(), 1u);
  const std::string place = issues[0].location;
  EXPECT_EQ(place.substr(0, place.rfind(':')), file.string());
  EXPECT_FALSE(issues[0].text.empty());
  EXPECT_EQ(issues[0].text.find(file.string()), std::string::npos) << issues[0].text;
  EXPECT_EQ(test::error_of(read), place + ": " + issues[0].text);
}

TEST(Places, AreTheFilesOfMaps) {
  const test::Folder folder;
  const auto load = [](const std::filesystem::path& file) {
    return [file] { load_map(guess_map_spec(file)); };
  };
  const auto expect = [&](std::string_view name, std::string_view bytes) {
    const std::filesystem::path file = folder.with(name, bytes);
    expect_place(file, load(file));
  };
  expect_place(folder / "none.png", load(folder / "none.png"));
  expect("a.csv", "1,2,3\n");
  expect("a.geojson", "{");
  expect("a.svg", "<svg");
  expect("a.png", "no picture");
  expect("a.xyz", "no map");
}

TEST(Places, AreTheFilesOfPicturesAndTracks) {
  const test::Folder folder;
  const auto picture = [&](std::string_view name, std::string_view bytes) {
    const std::filesystem::path file = folder.with(name, bytes);
    expect_place(file, [&] { read_photograph(file); });
  };
  picture("a.tif", "II*");
  picture("b.tif", std::string_view("II*\0\x08\0\0\0", 8));
  picture("a.jpg", "\xff\xd8\xff");
  picture("a.pgm", "P5 1 1");
  const std::filesystem::path table = folder.with("a.csv", "id,t_s,x_um,y_um\n");
  expect_place(table, [&] { read_tracks(table); });
}

}  // namespace
}  // namespace microswarm::formats

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/tracks.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::formats {
namespace {

using test::error_of;

Tracks parsed_tracks(std::string_view text) { return parse_tracks(text, "x.csv"); }

TEST(TracksCsv, SemicolonsTabsAndQuotesMeanTheSame) {
  const Tracks commas = parsed_tracks("id,t_s,x_um,y_um\na,0,1.5,2\na,0.5,3,4\n");
  const Tracks others[] = {
      parsed_tracks("\"id\";\"t_s\";\"x_um\";\"y_um\"\n\"a\";0;1,5;2\na;0,5;3;4\n"),
      parsed_tracks("id\tt_s\tx_um\ty_um\na\t0\t1.5\t2\na\t0,5\t3\t4\n")};
  for (const Tracks& other : others) {
    ASSERT_EQ(other.size(), 1U);
    EXPECT_EQ(other.at("a").times, commas.at("a").times);
    EXPECT_EQ(other.at("a").points, commas.at("a").points);
  }
}
std::string tracks_complaint(std::string_view text) {
  return error_of([&] { parsed_tracks(text); });
}

TEST(Tracks, AnyOrderOfColumnsAndRows) {
  const Tracks tracks = parsed_tracks(
      "# by hand\r\n x_um, id ,y_um,note,t_s\r\n1,a,2,-,0\r\n\r\n5,b,6,-,0\r\n3,a,4,-,0.5\r\n");
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks.at("a").times, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(tracks.at("a").points, (std::vector<Vec2>{{1, 2}, {3, 4}}));
  EXPECT_EQ(tracks.at("b").points, (std::vector<Vec2>{{5, 6}}));
}

TEST(Tracks, ParticleIsTakenForAMissingId) {
  const Tracks tracks = parsed_tracks("frame,particle,t_s,x_um,y_um\n0,7,0,1,2\n1,7,1,3,4\n");
  EXPECT_EQ(tracks.at("7").points, (std::vector<Vec2>{{1, 2}, {3, 4}}));
  const Tracks both = parsed_tracks("particle,t_s,x_um,y_um,id\n0,0,1,2,a\n");
  EXPECT_TRUE(both.contains("a"));
  EXPECT_TRUE(
      test::is_one_line_naming(tracks_complaint("particle,t_s,x_um,y_um,particle\n0,0,1,2,0\n"),
                               "x.csv:1", {"column", "particle", "twice"}));
}

TEST(TracksErrors, NameTheLine) {
  const std::string head = "id,t_s,x_um,y_um\n";
  EXPECT_EQ(tracks_complaint(""), "x.csv: no tracks: columns id,t_s,x_um,y_um and rows expected");
  EXPECT_TRUE(test::is_one_line_naming(tracks_complaint(head), "x.csv", {"t_s", "x_um", "y_um"}));
  EXPECT_TRUE(test::is_one_line_naming(tracks_complaint("id,t,x_um,y_um\n"), "x.csv:1",
                                       {"t_s", "x_um", "y_um"}));
  EXPECT_TRUE(test::is_one_line_naming(tracks_complaint("id,id,t_s,x_um,y_um\n"), "x.csv:1",
                                       {"column", "id", "twice"}));
  EXPECT_TRUE(test::is_one_line_naming(tracks_complaint(head + "a,0,1\n"), "x.csv:2",
                                       {"3", "fields", "header", "4"}));
  EXPECT_TRUE(
      test::is_one_line_naming(tracks_complaint(head + "a,0,1,x\n"), "x.csv:2", {"y_um", "x"}));
  EXPECT_TRUE(
      test::is_one_line_naming(tracks_complaint(head + "a,0,nan,1\n"), "x.csv:2", {"x_um", "nan"}));
  EXPECT_TRUE(
      test::is_one_line_naming(tracks_complaint(head + "a,0,inf,1\n"), "x.csv:2", {"x_um", "inf"}));
  EXPECT_TRUE(test::is_one_line_naming(tracks_complaint(head + "a,0,-2e9,1\n"), "x.csv:2",
                                       {"x_um", "-2e9", "1e9"}));
  EXPECT_TRUE(
      test::is_one_line_naming(tracks_complaint(head + ",0,1,1\n"), "x.csv:2", {"id", "empty"}));
  EXPECT_TRUE(test::is_one_line_naming(tracks_complaint(head + "a,1,1,1\nb,0,1,1\na,1,2,2\n"),
                                       "x.csv:4", {"time", "1 s", "a"}));
}

TEST(Tracks, Pedestrians) {
  const test::Folder folder;
  const auto file = folder.with("obsmat.txt",
                                " 1.0e+00  1.0e+00  -2.5e+00  0  1.9e+01  0 0 -1.3\n"
                                " 11 1 -2.5 0 18.5 0 0 -1.3\n 11 2 0 0 0 0 0 0\n");
  const Tracks tracks = read_ucy_obsmat(file, 20, 2);
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks.at("1").points, (std::vector<Vec2>{{-50, 380}, {-50, 370}}));
  EXPECT_DOUBLE_EQ(tracks.at("1").times[0], 0.08);
  EXPECT_DOUBLE_EQ(tracks.at("1").times[1] - tracks.at("1").times[0], 0.8);
  const auto wrong = folder.with("wrong.txt", "1 2 3\n");
  EXPECT_EQ(error_of([&] { read_ucy_obsmat(wrong, 1); }),
            wrong.string() + ":1: 8 columns expected, 3 there");
}

}  // namespace
}  // namespace microswarm::formats

// SPDX-License-Identifier: Apache-2.0
// Tables of trackpy and TrackMate.
#include "microswarm/vision/tracking/track_table.hpp"

#include <gtest/gtest.h>

#include <string>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::vision {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_track_table(text, "t.csv", 0.5);
  } catch (const InputError& e) {
    return e.what();
  }
  return "taken";
}

TEST(TrackTable, TrackpyHasPixels) {
  const auto rows = parse_track_table(
      ",\"y\",x,mass,frame,particle\n7,2,1.5,300,1,0\n8,2,2.5,290,0.0,0\n\n9,9,9,1,1,3\n", "t.csv",
      0.5);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].frame, 0);
  EXPECT_EQ(rows[0].at_px, (Vec2{2.5, 2}));
  EXPECT_EQ(rows[0].mass, 290);
  EXPECT_EQ(rows[2].id, 3);
}

TEST(TrackTable, TrackMateHasUnits) {
  const std::string head =
      "LABEL,TRACK_ID,POSITION_X,POSITION_Y,FRAME\nLabel,Track ID,X,Y,Frame\n,,X,Y,Frame\n";
  const std::string rows = "ID1,0,3.5,4,0\nID2,0,4.5,4,1\nID3,,4.5,9,1\n";
  for (const std::string unit : {",,(micron),(micron),\n", ",,(pixel),(pixel),\n"}) {
    const auto table = parse_track_table(head + unit + rows, "t.csv", 0.5);
    ASSERT_EQ(table.size(), 2U);  // the third is in no track
    EXPECT_EQ(table[0].at_px.x, unit.find("pixel") != std::string::npos ? 3.5 : 7);
  }
  EXPECT_EQ(
      parse_track_table("LABEL,TRACK_ID,POSITION_X,POSITION_Y,FRAME\n" + rows, "t.csv", 0.5).size(),
      2U);
}

TEST(TrackTable, SemicolonsQuotesAndDecimalCommasAreRead) {
  const auto read = parse_track_table("\"frame\";\"x\";\"y\"\n\"0\";1,5;\"2,25\"\n", "t.csv", 1);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].at_px, (Vec2{1.5, 2.25}));
  EXPECT_EQ(parse_track_table("frame\tx\ty\n3\t1\t2\n", "t.csv", 1)[0].frame, 3);
}

TEST(TrackTable, BadOnesAreRefusedWithTheirPlace) {
  EXPECT_TRUE(refusal("picture,x,y\n0,1,2\n").starts_with("t.csv:1: columns frame, x, y"));
  EXPECT_EQ(refusal("frame,x,y\n"), "t.csv: no positions");
  EXPECT_EQ(refusal("frame,x,y\n0,1\n"), "t.csv:2: 2 fields, the header has 3");
  EXPECT_TRUE(refusal("frame,x,y\n0,1,z\n").starts_with("t.csv:2: y "));
  EXPECT_TRUE(refusal("frame,x,y\n0.5,1,2\n").starts_with("t.csv:2: frame is 0.5"));
  EXPECT_TRUE(refusal("frame,x,y\n-1,1,2\n").starts_with("t.csv:2: frame is -1"));
  EXPECT_TRUE(refusal("frame,x,x,y\n").starts_with("t.csv:1: column 'x' stands twice"));
  EXPECT_EQ(refusal("frame,x,y,particle\n0,1,2,5\n0,3,4,5\n"),
            "t.csv: track 5 has two positions in frame 0");
}

TEST(TrackTable, TracksAreTakenAndFeaturesAreLinked) {
  const TrackSettings settings{.um_per_px = 0.5, .rate = 10};
  const auto table = parse_track_table(
      "frame,x,y,particle\n0,1,20,7\n0,50,9,2\n1,2,20,7\n1,51,9,2\n", "t.csv", 0.5);
  const TrackResult tracks = tracks_of_table(table, "t.csv", settings);
  ASSERT_EQ(tracks.rows.size(), 4U);
  EXPECT_EQ(tracks.frames, 2);
  EXPECT_EQ(tracks.rows[2].id, 7);
  EXPECT_NEAR(tracks.rows[2].velocity.x, 5, 1e-9);
  EXPECT_NEAR(tracks.rows[2].position.x, 1.25, 1e-9);
  EXPECT_NEAR(tracks.rows[0].position.y, 0.25, 1e-9);  // the lowest pixel
  EXPECT_NEAR(tracks.rows[1].position.y, 0.25 + 5.5, 1e-9);
  const TrackResult linked = tracks_of_table(
      parse_track_table("frame,x,y\n0,1,20\n0,50,9\n1,51,9\n1,2,20\n", "t.csv", 0.5), "t.csv",
      settings);
  ASSERT_EQ(linked.rows.size(), 4U);
  EXPECT_EQ(linked.rows[2].id, linked.rows[1].id);
  EXPECT_EQ(linked.rows[3].id, linked.rows[0].id);
}

}  // namespace
}  // namespace microswarm::vision

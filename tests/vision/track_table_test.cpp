// SPDX-License-Identifier: Apache-2.0
// Tables of trackpy and TrackMate.
#include "microswarm/vision/tracking/track_table.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::vision {
namespace {

std::vector<TableRow> rows_of(const std::string& text, const std::string& name,
                              std::optional<double> um_per_px) {
  return parse_track_table(text, name, um_per_px).rows;
}

std::string refusal(const std::string& text, std::optional<double> um_per_px = 0.5) {
  try {
    parse_track_table(text, "t.csv", um_per_px);
  } catch (const InputError& e) {
    return e.what();
  }
  return "taken";
}

TEST(TrackTable, TrackpyHasPixels) {
  const auto rows =
      rows_of(",\"y\",x,mass,frame,particle\n7,2,1.5,300,1,0\n8,2,2.5,290,0.0,0\n\n9,9,9,1,1,3\n",
              "t.csv", 0.5);
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
    const auto table = rows_of(head + unit + rows, "t.csv", 0.5);
    ASSERT_EQ(table.size(), 2U);  // the third is in no track
    EXPECT_EQ(table[0].at_px.x, unit.find("pixel") != std::string::npos ? 3.5 : 7);
  }
  EXPECT_EQ(rows_of("LABEL,TRACK_ID,POSITION_X,POSITION_Y,FRAME\n" + rows, "t.csv", 0.5).size(),
            2U);
}

TEST(TrackTable, SemicolonsQuotesAndDecimalCommasAreRead) {
  const auto read = rows_of("\"frame\";\"x\";\"y\"\n\"0\";1,5;\"2,25\"\n", "t.csv", 1);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].at_px, (Vec2{1.5, 2.25}));
  EXPECT_EQ(rows_of("frame\tx\ty\n3\t1\t2\n", "t.csv", 1)[0].frame, 3);
}

/// Two tracks, of which the filters keep one, a visible spot in no track and a hidden one.
std::string saved_xml(const std::string& unit, const std::string& image) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<TrackMate version=\"7.11.1\">\n"
         "<Model spatialunits=\"" +
         unit + R"(" timeunits="ms">
<AllSpots nspots="6">
<SpotsInFrame frame="1">
<Spot ID="11" POSITION_X="3.5" POSITION_Y="4" FRAME="1" VISIBILITY="1" />
<Spot ID="13" POSITION_X="9" POSITION_Y="9" FRAME="1" VISIBILITY="1" />
</SpotsInFrame>
<SpotsInFrame frame="0">
<Spot ID="10" POSITION_X="3" POSITION_Y="4" FRAME="0" VISIBILITY="1" />
<Spot ID="12" POSITION_X="9" POSITION_Y="8" FRAME="0" VISIBILITY="1" />
<Spot ID="14" POSITION_X="1" POSITION_Y="1" FRAME="0" VISIBILITY="1" />
<Spot ID="15" POSITION_X="2" POSITION_Y="1" FRAME="0" VISIBILITY="0" />
</SpotsInFrame>
</AllSpots>
<AllTracks>
<Track name="Track_0" TRACK_ID="7"><Edge SPOT_SOURCE_ID="10" SPOT_TARGET_ID="11" /></Track>
<Track name="Track_1" TRACK_ID="8"><Edge SPOT_SOURCE_ID="12" SPOT_TARGET_ID="13" /></Track>
</AllTracks>
<FilteredTracks><TrackID TRACK_ID="7" /></FilteredTracks>
</Model>
<Settings>)" +
         image + "</Settings>\n</TrackMate>\n";
}

TEST(TrackTable, UnitsOfLengthAreHonoured) {
  const std::string head = "FRAME,POSITION_X,POSITION_Y,TRACK_ID,POSITION_T\nFrame,X,Y,ID,T\n";
  const auto with = [&](const std::string& length, const std::string& time) {
    return head + ",(" + length + "),(" + length + "),,(" + time + ")\n0,2,4,0,0\n1,3,4,0,5\n";
  };
  EXPECT_EQ(rows_of(with("mm", "sec"), "t.csv", 500)[0].at_px, (Vec2{4, 8}));
  EXPECT_EQ(rows_of(with("nm", "sec"), "t.csv", 0.001)[0].at_px, (Vec2{2, 4}));
  EXPECT_EQ(rows_of(with("pixel", "min"), "t.csv", std::nullopt)[1].t, 300);
  EXPECT_EQ(rows_of(with("pixel", "frame"), "t.csv", 1)[1].t, std::nullopt);
  EXPECT_EQ(refusal(with("parsec", "sec")), "t.csv:3: unit 'parsec' is not known");
  EXPECT_EQ(refusal(with("um", "moon")), "t.csv:3: unit 'moon' is not known");
  EXPECT_EQ(refusal(with("um", "sec"), std::nullopt),
            "t.csv:4: positions are in units of length: \u00B5m per px is missing");
}

TEST(TrackTable, TimesAreThoseOfTheTable) {
  const std::string text =
      "frame,x,y,particle,t_s\n0,0,9,0,10\n1,2,9,0,10.5\n3,8,9,0,13.5\n4,9,9,0,14\n";
  const auto table = parse_track_table(text, "t.csv", 1);
  const TrackResult own = tracks_of_table(table, "t.csv", {.um_per_px = 1});
  EXPECT_EQ(own.times, (std::vector<double>{10, 10.5, 12, 13.5, 14}));
  EXPECT_NEAR(own.rows[0].velocity.x, 4, 1e-9);
  EXPECT_NEAR(own.rows[1].velocity.x, 8 / 3.5, 1e-9);  // between frames 0 and 3
  EXPECT_NEAR(own.frame_time, 1, 1e-9);
  EXPECT_EQ(tracks_of_table(table, "t.csv", {.um_per_px = 1, .rate = 2}).times.back(), 2);
  const auto refused = [&](const std::string& rows) {
    try {
      tracks_of_table(parse_track_table("frame,x,y,particle,t_s\n" + rows, "t.csv", 1), "t.csv",
                      {.um_per_px = 1});
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("taken");
  };
  EXPECT_EQ(refused("0,0,0,0,1\n1,0,0,0,1\n"),
            "t.csv:3: frame 1 is at 1 s, not after frame 0 at 1 s");
  EXPECT_EQ(refused("0,0,0,0,1\n0,9,0,1,2\n"), "t.csv:3: frame 0 has two times, 1 and 2 s");
  EXPECT_EQ(refused("0,0,0,0,1\n1,9,0,1,\n"), "t.csv:3: no time, which other positions have");
  EXPECT_EQ(refused("0,9,0,1,\n1,0,0,0,1\n"), "t.csv:2: no time, which other positions have");
  // Sorted by frames, rows keep their lines.
  EXPECT_EQ(refused("2,0,0,0,1\n\n0,0,0,0,3\n"),
            "t.csv:2: frame 2 is at 1 s, not after frame 0 at 3 s");
}

TEST(TrackTable, FilesOfTheseNamesAreTables) {
  for (const char* name : {"a.csv", "b.CSV", "c.tsv", "d.txt", "e.XML", "/dev/stdin"})
    EXPECT_TRUE(is_track_table(name)) << name;
  for (const char* name : {"a.mp4", "b.tif", "folder", "a.csv.avi"})
    EXPECT_FALSE(is_track_table(name)) << name;
}

TEST(TrackMateXml, WhatIsSavedHasScaleTimesAndHeight) {
  const std::string image =
      R"(<ImageData width="64" height="48" pixelwidth="0.5" pixelheight="0.5" timeinterval="50" />)";
  const TrackTable table = parse_track_table(saved_xml("micron", image), "t.xml", std::nullopt);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0].at_px, (Vec2{6, 8}));
  EXPECT_EQ(table.rows[1].at_px, (Vec2{7, 8}));
  EXPECT_EQ(table.rows[0].id, 7);
  EXPECT_EQ(table.untracked, 3U);
  EXPECT_EQ(table.um_per_px, 0.5);
  EXPECT_NEAR(table.interval.value(), 0.05, 1e-12);
  const TrackResult tracks =
      tracks_of_table(table, "t.xml", {.um_per_px = table.um_per_px, .rate = 1 / *table.interval});
  EXPECT_NEAR(tracks.rows[0].position.y, (48 - 8 - 0.5) * 0.5, 1e-9);
  EXPECT_NEAR(tracks.rows[1].velocity.x, 0.5 / 0.05, 1e-9);
}

TEST(TrackMateXml, PixelsStayPixels) {
  const std::string image =
      R"(<ImageData width="64" height="0" pixelwidth="1" pixelheight="1" timeinterval="1" />)";
  const TrackTable table = parse_track_table(saved_xml("pixel", image), "t.xml", std::nullopt);
  EXPECT_EQ(table.rows[1].at_px, (Vec2{3.5, 4}));
  EXPECT_FALSE(table.um_per_px);
  EXPECT_FALSE(table.height);
}

TEST(TrackMateXml, ExportedTracksAreRead) {
  const std::string text =
      "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<Tracks nTracks=\"2\" spaceUnits=\"\u00B5m\" "
      "frameInterval=\"2.0\" timeUnits=\"sec\">\n<particle nSpots=\"2\">"
      "<detection t=\"0\" x=\"3\" y=\"4\" z=\"0\" /><detection t=\"2\" x=\"5\" y=\"4\" z=\"0\" />"
      "</particle>\n<particle><detection t=\"2\" x=\"1\" y=\"1\" z=\"0\" /></particle></Tracks>";
  const TrackTable table = parse_track_table(text, "t.xml", 0.5);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[1].at_px, (Vec2{10, 8}));
  EXPECT_EQ(table.rows[1].frame, 2);
  EXPECT_EQ(table.rows[2].id, 1);
  EXPECT_EQ(table.interval, 2);
  EXPECT_EQ(refusal(text, std::nullopt),
            "t.csv:2: positions are in \u00B5m: \u00B5m per px is missing");
  EXPECT_EQ(refusal("<Tracks spaceUnits=\"parsec\"/>"), "t.csv:1: unit 'parsec' is not known");
}

TEST(TrackMateXml, BadOnesAreRefusedWithTheirPlace) {
  const std::string good = saved_xml("pixel", "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  EXPECT_TRUE(refusal("<TrackMate>\n<Model>").starts_with("t.csv:2: XML: "));
  EXPECT_EQ(refusal("\n<svg/>"), "t.csv:2: element 'svg', TrackMate or Tracks expected");
  EXPECT_EQ(refusal("<TrackMate/>"), "t.csv: no positions");
  EXPECT_EQ(with("POSITION_X=\"3.5\"", ""), "t.csv:6: POSITION_X is missing");
  EXPECT_EQ(with("POSITION_X=\"3.5\"", "POSITION_X=\"NaN\""),
            "t.csv:6: POSITION_X 'NaN' is no number");
  EXPECT_EQ(with("frame=\"1\"", "frame=\"-1\""), "t.csv:5: frame is -1, must be 0 to 1e7");
  EXPECT_EQ(with("SPOT_TARGET_ID=\"11\"", "SPOT_TARGET_ID=\"99\""),
            "t.csv:16: 1 spots of tracks are not in AllSpots");
  EXPECT_EQ(with("<FilteredTracks><TrackID TRACK_ID=\"7\" />", "<FilteredTracks>"),
            "t.csv: no positions in tracks");
}

TEST(TrackTable, BadOnesAreRefusedWithTheirPlace) {
  EXPECT_TRUE(refusal("picture,x,y\n0,1,2\n").starts_with("t.csv:1: columns frame, x, y"));
  EXPECT_EQ(refusal("frame,x,y\n"), "t.csv: no positions");
  EXPECT_EQ(refusal("frame,x,y\n0,1\n"), "t.csv:2: 2 fields, the header has 3");
  EXPECT_TRUE(refusal("frame,x,y\n0,1,z\n").starts_with("t.csv:2: y "));
  EXPECT_TRUE(refusal("frame,x,y\n0.5,1,2\n").starts_with("t.csv:2: frame is 0.5"));
  EXPECT_TRUE(refusal("frame,x,y\n-1,1,2\n").starts_with("t.csv:2: frame is -1"));
  EXPECT_TRUE(refusal("frame,x,x,y\n").starts_with("t.csv:1: column 'x' stands twice"));
  EXPECT_EQ(
      refusal("frame,x,y,particle\n0,1,2,5\n0,3,4,5\n"),
      "t.csv:3: track 5 has two positions in frame 0, tracks that divide or merge are not taken");
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

/// A tracks.csv of pictures of 200 px height, 0.35 µm per px, at (20, 40) and (25, 77).
const std::string own_tracks =
    "frame,id,t_s,x_um,y_um,vx_um_per_s,vy_um_per_s,radius_um,mass,signal,eccentricity,particle,x,"
    "y\n"
    "0,0,0,7.175,55.825,0,0,2.1,900,120,0.05,0,20,40\n"
    "1,0,0.1,8.925,42.875,0,0,2.2,910,121,0.06,0,25,77\n";

TEST(TrackTable, OurOwnTracksComeBackAsTheyWere) {
  const TrackTable table = parse_track_table(own_tracks, "t.csv", std::nullopt);
  ASSERT_TRUE(table.um_per_px && table.height);
  EXPECT_NEAR(*table.um_per_px, 0.35, 1e-9);
  EXPECT_EQ(*table.height, 200);
  const TrackResult back = tracks_of_table(table, "t.csv", {.um_per_px = table.um_per_px});
  ASSERT_EQ(back.rows.size(), 2U);
  EXPECT_NEAR(back.rows[0].position.y, 55.825, 1e-9);
  EXPECT_NEAR(back.rows[1].position.x, 8.925, 1e-9);
  EXPECT_NEAR(back.rows[1].position.y, 42.875, 1e-9);
  EXPECT_EQ(back.rows[0].radius, 2.1);
  EXPECT_EQ(back.rows[1].signal, 121);
  EXPECT_EQ(back.rows[1].eccentricity, 0.06);
  EXPECT_EQ(back.notes, std::vector<std::string>{});
}

TEST(TrackTable, AScaleThatContradictsTheTableIsTold) {
  const TrackTable table = parse_track_table(own_tracks, "t.csv", 0.7);
  const TrackResult back = tracks_of_table(table, "t.csv", {.um_per_px = 0.7});
  ASSERT_EQ(back.notes.size(), 1U);
  EXPECT_EQ(back.notes[0], "t.csv: states 0.35 µm per px, 0.7 is taken, as asked");
  EXPECT_NEAR(back.rows[0].position.y, 0.7 * 159.5, 1e-9);
}

TEST(TrackTable, PlacesThatDoNotGoTogetherAndAnUnknownHeightAreTold) {
  const TrackTable other = parse_track_table(
      "frame,particle,x,y,x_um,y_um\n0,0,20,40,7.175,55.825\n1,0,25,77,9.925,42.875\n", "t.csv", 1);
  EXPECT_FALSE(other.um_per_px);
  const TrackResult back = tracks_of_table(other, "t.csv", {.um_per_px = 1});
  ASSERT_EQ(back.notes.size(), 2U);
  EXPECT_NE(back.notes[0].find("x_um and y_um do not go with x and y"), std::string::npos);
  EXPECT_NE(back.notes[1].find("the lowest position, y = 77 px"), std::string::npos);
}

TEST(TrackTable, ShapesOfTrackpyAreTaken) {
  const auto rows = rows_of(
      "y,x,mass,size,ecc,signal,frame\n2,1,300,2.5,0.1,40,0\n3,1,300,2.5,,41,1\n", "t.csv", 1);
  EXPECT_EQ(rows[0].eccentricity, 0.1);
  EXPECT_EQ(rows[1].eccentricity, 0);
  EXPECT_EQ(rows[1].signal, 41);
}

TEST(TrackTable, Utf16AndWhatIsNoTextAreNamed) {
  std::string wide = "\xFF\xFE";
  for (const char c : std::string("frame,x,y\n0,1,2\n")) wide += {c, '\0'};
  EXPECT_EQ(refusal(wide), "t.csv: is UTF-16: save it as UTF-8");
  EXPECT_EQ(refusal(wide.substr(2)), "t.csv: is UTF-16: save it as UTF-8");
  EXPECT_TRUE(refusal(std::string("\0\0\0\x20"
                                  "ftypisom",
                                  12))
                  .starts_with("t.csv: is no text"));
  std::string xml = "\xFF\xFE";
  for (const char c :
       std::string("<Tracks spaceUnits=\"pixel\"><particle><detection t=\"0\" x=\"1\" "
                   "y=\"2\"/></particle></Tracks>"))
    xml += {c, '\0'};
  EXPECT_EQ(rows_of(xml, "t.xml", 1).size(), 1U);
}

}  // namespace
}  // namespace microswarm::vision

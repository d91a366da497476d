// SPDX-License-Identifier: Apache-2.0
// Frames from files, and the tracking of whole videos, also of real ones.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <sstream>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/media/media.hpp"
#include "microswarm/vision/camera/video_file_writer.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"
#include "tests/files.hpp"
#include "tests/vision/spots.hpp"

namespace microswarm::vision {
namespace {

namespace fs = std::filesystem;

class Videos : public testing::Test {
 protected:
  Videos() : folder(fs::path(testing::TempDir()) / ("videos_" + std::to_string(::getpid()))) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Videos() override { fs::remove_all(folder); }
  static formats::Image flat(int width, int height, int channels, std::uint8_t grey) {
    return {width, height, channels,
            std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height * channels, grey)};
  }
  std::string refusal(const fs::path& source) const {
    try {
      const auto frames = open_frames(source);
      VideoFrame frame;
      while (frames->next(frame)) {
      }
    } catch (const InputError& e) {
      return e.what();
    }
    return "taken";
  }
  fs::path folder;
};

TEST_F(Videos, PicturesComeInTheOrderOfTheirNumbers) {
  for (const int i : {1, 2, 10, 9, 100})
    formats::write_png(folder / ("a" + std::to_string(i) + ".png"),
                       flat(8, 6, 1, static_cast<std::uint8_t>(i)));
  write_file_atomically(folder / "notes.txt", "none of the pictures");
  const auto frames = open_frames(folder, 4);
  EXPECT_EQ(frames->count(), 5);
  VideoFrame frame;
  for (const int i : {1, 2, 9, 10, 100}) {
    ASSERT_TRUE(frames->next(frame));
    EXPECT_EQ(frame.picture.pixels[0], i);
    EXPECT_EQ(frame.t, 0.25 * (i - 1));  // pictures are missing between
  }
  EXPECT_EQ(frame.index, 4);
  EXPECT_FALSE(frames->next(frame));
}

TEST_F(Videos, AFolderMayHoldEveryKindOfPicture) {
  for (const std::string_view extension : formats::image_extensions) {
    if (extension.starts_with(".tif")) continue;  // read page by page
    const fs::path file = folder / ("1" + std::string(extension));
    write_file_atomically(file, "P5 2 1 255\n\x05\x06");
    const auto frames = open_frames(folder);
    VideoFrame frame;
    EXPECT_TRUE(frames->next(frame)) << extension;
    EXPECT_EQ(frame.picture.width, 2) << extension;
    fs::remove(file);
  }
}

TEST_F(Videos, BadSourcesAreRefused) {
  const std::string at = folder.string();
  EXPECT_EQ(refusal(folder),
            at + ": no pictures in this folder (PNG, JPEG, BMP, TIFF, PGM or PPM)");
  EXPECT_EQ(refusal(folder / "none.mp4"), at + "/none.mp4: cannot read: No such file or directory");
  write_file_atomically(folder / "bad.mp4", std::string(5000, 'x'));
  EXPECT_EQ(refusal(folder / "bad.mp4"), at + "/bad.mp4: is no video that can be read");
  write_file_atomically(folder / "bad.tif", std::string(5000, 'x'));
  EXPECT_EQ(refusal(folder / "bad.tif"), at + "/bad.tif: is no TIFF that can be read");
  write_file_atomically(folder / "empty.avi", "");
  EXPECT_EQ(refusal(folder / "empty.avi"), at + "/empty.avi: is empty");
  EXPECT_EQ(refusal(folder), at + "/bad.tif: is no TIFF that can be read");
}

TEST_F(Videos, AnUnreadablePictureEndsAFolder) {
  for (const char* bad : {"3.png", "3.tif"}) {
    formats::write_png(folder / "1.png", flat(8, 6, 1, 0));
    formats::write_png(folder / "2.png", flat(8, 6, 1, 0));
    write_file_atomically(folder / bad, read_file(folder / "2.png").substr(0, 40));
    formats::write_png(folder / "4.png", flat(8, 6, 1, 0));
    const auto frames = open_frames(folder);
    VideoFrame frame;
    EXPECT_TRUE(frames->next(frame));
    EXPECT_TRUE(frames->next(frame));
    EXPECT_EQ(frames->why_ended(), "");
    EXPECT_FALSE(frames->next(frame));
    EXPECT_TRUE(frames->why_ended().starts_with((folder / bad).string() + ": "));
    EXPECT_FALSE(frames->next(frame));
    fs::remove(folder / bad);
  }
  formats::write_png(folder / "3.png", flat(8, 7, 1, 0));
  const auto frames = open_frames(folder);
  VideoFrame frame;
  while (frames->next(frame)) {
  }
  EXPECT_EQ(frame.index, 1);
  EXPECT_EQ(frames->why_ended(),
            (folder / "3.png").string() + ": 8x7 pixels, the first picture has 8x6");
}

TEST_F(Videos, AFolderHasOnePictureAFile) {
  std::vector<cv::Mat> pages(3, cv::Mat(6, 8, CV_8U, cv::Scalar(9)));
  cv::imwritemulti((folder / "1.tif").string(), pages);
  EXPECT_EQ(refusal(folder),
            (folder / "1.tif").string() + ": holds 3 pictures: name the file, not its folder");
  pages.resize(1);
  cv::imwritemulti((folder / "1.tif").string(), pages);
  VideoFrame frame;
  EXPECT_TRUE(open_frames(folder)->next(frame));
  EXPECT_EQ(frame.picture.pixels[0], 9);
}

TEST_F(Videos, WhatIsWrittenAsVideoIsReadAgain) {
  const fs::path file = folder / "v.mp4";
  VideoFileWriter writer(file, 12.5);
  for (int i = 0; i < 7; ++i) writer.add(flat(64, 48, 3, static_cast<std::uint8_t>(30 * i)));
  EXPECT_FALSE(fs::exists(file));
  ASSERT_EQ(writer.commit(), file);
  const auto frames = open_frames(file);
  EXPECT_NEAR(frames->rate().value_or(0), 12.5, 1e-6);
  VideoFrame frame;
  int count = 0;
  for (; frames->next(frame); ++count) {
    EXPECT_EQ(frame.picture.width, 64);
    EXPECT_EQ(frame.picture.channels, 3);
    EXPECT_NEAR(frame.picture.pixels[1000], 30 * count, 4);
    EXPECT_NEAR(frame.t, count / 12.5, 1e-9);
  }
  EXPECT_EQ(count, 7);
}

TEST_F(Videos, SixteenBitsAreScaledAlikeThroughTheVideo) {
  const auto write = [&](const char* name, std::uint16_t first) {
    const cv::Mat picture(4, 5, CV_16U, cv::Scalar(1000));
    cv::Mat other = picture.clone();
    other.at<std::uint16_t>(0, 0) = first;
    cv::imwrite((folder / name).string(), other);
  };
  write("1.png", 4000);  // twelve bits
  write("2.png", 2000);
  write("3.png", 9000);  // white
  const auto greys = [&](std::optional<int> depth) {
    const auto frames = open_frames(folder, 1, depth);
    std::vector<int> firsts;
    VideoFrame frame;
    while (frames->next(frame)) {
      firsts.push_back(frame.picture.pixels[0]);
      EXPECT_EQ(frame.picture.pixels[1],
                std::lround(255.0 * 1000 / ((1 << depth.value_or(12)) - 1)));
    }
    return firsts;
  };
  EXPECT_EQ(greys(std::nullopt), (std::vector<int>{249, 125, 255}));
  EXPECT_EQ(greys(14), (std::vector<int>{62, 31, 140}));
  const std::vector<cv::Mat> pages{cv::Mat(4, 5, CV_16U, cv::Scalar(1023)),
                                   cv::Mat(4, 5, CV_16U, cv::Scalar(512))};
  cv::imwritemulti((folder / "stack.tif").string(), pages);
  const auto stack = open_frames(folder / "stack.tif");
  VideoFrame frame;
  ASSERT_TRUE(stack->next(frame));
  EXPECT_EQ(frame.picture.pixels[0], 255);
  ASSERT_TRUE(stack->next(frame));
  EXPECT_EQ(frame.picture.pixels[0], 128);
}

TEST_F(Videos, AWriterGivenUpLeavesNothing) {
  {
    VideoFileWriter writer(folder / "v.mp4", 10);
    writer.add(flat(64, 48, 3, 9));
  }
  EXPECT_TRUE(fs::is_empty(folder));
}

// Before memory is taken for its pictures.
TEST_F(Videos, AClaimedSizeBeyondTheLimitIsALine) {
  const char gif[] =
      "GIF89a\xff\xff\xff\xff\x80\0\0\0\0\0\xff\xff\xff,\0\0\0\0\1\0\1\0\0\2\2D\1\0;";
  write_file_atomically(folder / "x.gif", {gif, sizeof gif - 1});
  const std::string why = refusal(folder / "x.gif");
  EXPECT_NE(why.find(" pixels, allowed up to 16384 a side"), std::string::npos) << why;
}

TEST(HeldPictures, FitIntoTheirMemory) {
  constexpr std::int64_t bytes_per_px = 6;
  for (const int side : {64, 640, 1280, 2048, 4096, 8000, 16384})
    for (const unsigned cores : {0U, 1U, 2U, 8U, 64U}) {
      const auto held = formats::held_pictures(side, side, cores);
      const int pictures = 2 * held.threads + held.references + held.reordered + held.ahead;
      EXPECT_GE(held.threads, 1);
      EXPECT_GE(held.references, 1);
      EXPECT_TRUE(pictures == 3 || bytes_per_px * side * side * pictures <= formats::max_held_bytes)
          << side << ": " << pictures;
    }
  EXPECT_EQ(formats::held_pictures(8000, 8000, 8).ahead, 0);
}

TEST(Channels, AreTakenOneByOne) {
  const formats::Image colours{2, 1, 3, {10, 20, 30, 40, 50, 60}};
  formats::Image grey;
  take_channel(colours, VideoChannel::red, grey);
  EXPECT_EQ(grey.pixels, (std::vector<std::uint8_t>{10, 40}));
  take_channel(colours, VideoChannel::green, grey);
  EXPECT_EQ(grey.pixels, (std::vector<std::uint8_t>{20, 50}));
  take_channel(colours, VideoChannel::blue, grey);
  EXPECT_EQ(grey.pixels, (std::vector<std::uint8_t>{30, 60}));
}

TEST(ScaleBar, IsARoundFifthOfTheWidth) {
  EXPECT_DOUBLE_EQ(scale_bar_length(1000), 200);
  EXPECT_DOUBLE_EQ(scale_bar_length(240), 20);
  EXPECT_NEAR(scale_bar_length(0.3), 0.05, 1e-12);
}

/// Robots that drift by `drift` px a frame, drawn and tracked.
std::vector<TrackRow> drifting(Vec2 drift, int frames, std::vector<TrackEvent>* events = nullptr) {
  Rng rng(6, Purpose::test);
  std::vector<Vec2> at = test::scattered(400, 300, 40, rng);
  VideoTracker tracker(
      {.um_per_px = 0.5, .find = {.diameter = 13, .tone = ParticleTone::bright, .min_mass = 300}},
      0.1);
  std::vector<TrackRow> rows;
  for (int k = 0; k < frames; ++k) {
    const VideoFrame frame{k, 0.1 * k, test::draw_spots(400, 300, at, 2.2, 90, 1.5, rng)};
    const auto& seen = tracker.step(frame);
    rows.insert(rows.end(), seen.begin(), seen.end());
    for (Vec2& p : at) p += drift;
  }
  tracker.finish();
  if (events) *events = tracker.events();
  return rows;
}

TEST(VideoTracker, DriftIsToldInTheWorldsAxes) {
  const TrackSummary s = summarise(drifting({0.6, 0.25}, 21), 21);
  EXPECT_EQ(s.long_tracks, s.tracks);
  EXPECT_EQ(s.features, 21 * s.tracks);
  ASSERT_TRUE(s.drift && s.mean_speed);
  EXPECT_NEAR(s.drift->x, 20 * 0.6 * 0.5, 0.02);
  EXPECT_NEAR(s.drift->y, -20 * 0.25 * 0.5, 0.02);  // y goes up
  EXPECT_NEAR(*s.mean_speed, 0.65 * 0.5 / 0.1, 0.05);
}

TEST(VideoTracker, TheSameVideoGivesTheSameTracks) {
  const auto a = drifting({0.6, 0.25}, 12);
  const auto b = drifting({0.6, 0.25}, 12);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_EQ(a[i].position, b[i].position);
    EXPECT_EQ(a[i].velocity, b[i].velocity);
  }
}

TEST(VideoTracker, PictureAndWorldAreEachOthersInverse) {
  const Vec2 p{12.25, 40.5};
  EXPECT_NEAR(distance(place_in_picture(place_in_world(p, 100, 0.35), 100, 0.35), p), 0, 1e-12);
  EXPECT_EQ(place_in_world({0, 99}, 100, 2), (Vec2{1, 1}));  // the lowest pixel on the left
}

// Real videos.

fs::path videos() { return test::data_folder() / "video"; }

struct Reference {
  int particle;
  Vec2 at_px;
};

/// Features of each frame in a table whose first columns are frame, particle, x and y.
std::map<int, std::vector<Reference>> read_reference(const fs::path& file) {
  std::map<int, std::vector<Reference>> frames;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream row(line);
    double frame = 0;
    double particle = 0;
    Vec2 at;
    row >> frame >> particle >> at.x >> at.y;
    frames[static_cast<int>(frame)].push_back({static_cast<int>(particle), at});
  }
  return frames;
}

struct Comparison {
  int reference = 0;
  int ours = 0;
  int within_1_px = 0;
  int within_quarter_px = 0;
  double squares = 0;
  int reference_links = 0;
  int our_links = 0;
  int common_links = 0;
  TrackSummary summary;
  int merges = 0;
  int splits = 0;

  double rms() const { return std::sqrt(squares / within_1_px); }
  static double share(int a, int b) { return static_cast<double>(a) / b; }
};

/// Tracks the folder and compares it with the reference; pairs within 1 px, the nearest first.
Comparison compare(const fs::path& folder, const fs::path& reference,
                   const TrackSettings& settings) {
  const auto known = read_reference(reference);
  const auto source = open_frames(folder, settings.rate);
  VideoTracker tracker(settings, 1 / *settings.rate);
  Comparison result;
  VideoFrame frame;
  std::vector<TrackRow> all;
  std::map<int, int> before;  // our robot in the frame before: the reference's, or -1
  std::set<int> known_before;
  while (static_cast<std::size_t>(result.summary.frames) < known.size() && source->next(frame)) {
    ++result.summary.frames;
    const auto& rows = tracker.step(frame);
    all.insert(all.end(), rows.begin(), rows.end());
    const auto& features = known.at(frame.index);
    result.reference += static_cast<int>(features.size());
    result.ours += static_cast<int>(rows.size());
    std::vector<std::pair<double, std::pair<std::size_t, std::size_t>>> near;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Vec2 p = place_in_picture(rows[i].position, frame.picture.height, *settings.um_per_px);
      for (std::size_t k = 0; k < features.size(); ++k)
        if (const double d = distance(p, features[k].at_px); d <= 1) near.push_back({d, {i, k}});
    }
    std::sort(near.begin(), near.end());
    std::vector<bool> used(features.size());
    std::map<int, int> now;
    for (const TrackRow& row : rows) now[row.id] = -1;
    for (const auto& [d, pair] : near) {
      int& particle = now[rows[pair.first].id];
      if (used[pair.second] || particle >= 0) continue;
      used[pair.second] = true;
      particle = features[pair.second].particle;
      ++result.within_1_px;
      result.within_quarter_px += d <= 0.25;
      result.squares += d * d;
    }
    std::set<int> known_now;
    for (const Reference& f : features) known_now.insert(f.particle);
    for (const int particle : known_now) result.reference_links += known_before.contains(particle);
    for (const auto& [id, particle] : now) {
      if (!before.count(id)) continue;
      ++result.our_links;
      result.common_links += particle >= 0 && particle == before[id];
    }
    before = now;
    known_before = known_now;
  }
  result.summary = summarise(all, result.summary.frames);
  std::printf("%d features wider than the diameter, %d crowded\n", tracker.wider(),
              tracker.crowded());
  EXPECT_EQ(tracker.doubts({}), std::vector<std::string>{});
  for (const TrackEvent& e : tracker.events()) {
    result.merges += e.change == TrackChange::merge;
    result.splits += e.change == TrackChange::split;
  }
  return result;
}

TEST(VideoSample, EveryRobotIsFoundAndFollowed) {
  const Comparison c =
      compare(test::sample_folder() / "video", test::sample_folder() / "video_positions.csv",
              {.um_per_px = 0.5,
               .rate = 10,
               .find = {.diameter = 11, .tone = ParticleTone::bright, .min_mass = 200}});
  EXPECT_EQ(c.reference, 6 * 8);
  EXPECT_EQ(c.ours, c.reference);
  EXPECT_EQ(c.within_quarter_px, c.reference);
  EXPECT_LT(c.rms(), 0.1);
  EXPECT_EQ(c.common_links, c.reference_links);
  EXPECT_EQ(c.our_links, c.reference_links);
  EXPECT_EQ(c.summary.tracks, 6);
}

TEST(RealVideos, BulkWaterAgreesWithTrackpy) {
  const fs::path data = videos();
  if (!fs::exists(data)) GTEST_SKIP() << data << " is absent";
  const double um_per_px = 100.0 / 285;
  const Comparison c =
      compare(data / "bulk_water", data / "bulk_water_ref_trackpy.csv",
              {.um_per_px = um_per_px, .rate = 24, .channel = VideoChannel::green});
  const auto share = Comparison::share;
  std::printf(
      "bulk_water: %d features (reference %d); within 1 px recall %.4f, precision %.4f; within "
      "0.25 px recall %.4f, precision %.4f; RMS %.4f px\nlinks: %d (reference %d), recall %.4f, "
      "precision %.4f; %d tracks, %d of 10 frames or more; drift (%.3f, %.3f) px; "
      "%d merges, %d splits\n",
      c.ours, c.reference, share(c.within_1_px, c.reference), share(c.within_1_px, c.ours),
      share(c.within_quarter_px, c.reference), share(c.within_quarter_px, c.ours), c.rms(),
      c.our_links, c.reference_links, share(c.common_links, c.reference_links),
      share(c.common_links, c.our_links), c.summary.tracks, c.summary.long_tracks,
      c.summary.drift->x / um_per_px, -c.summary.drift->y / um_per_px, c.merges, c.splits);
  EXPECT_EQ(c.reference, 17404);
  EXPECT_GT(share(c.within_1_px, c.reference), 0.99);
  EXPECT_GT(share(c.within_1_px, c.ours), 0.99);
  EXPECT_GT(share(c.within_quarter_px, c.reference), 0.98);
  EXPECT_LT(c.rms(), 0.06);
  EXPECT_GT(share(c.common_links, c.reference_links), 0.99);
  EXPECT_GT(share(c.common_links, c.our_links), 0.99);
  EXPECT_NEAR(c.summary.long_tracks, 585, 10);
  EXPECT_NEAR(c.summary.drift->x / um_per_px, 1.620, 0.15);
  EXPECT_NEAR(-c.summary.drift->y / um_per_px, 0.425, 0.2);
}

TEST(RealVideos, BrightFieldHasFiveRings) {
  const fs::path data = videos();
  if (!fs::exists(data)) GTEST_SKIP() << data << " is absent";
  const Comparison c = compare(data / "brightfield", data / "brightfield_ref_trackpy.csv",
                               {.um_per_px = 0.1519,
                                .rate = 10,
                                .find = {.diameter = 17,
                                         .tone = ParticleTone::bright,
                                         .shape = ParticleShape::ring,
                                         .min_mass = 500}});
  std::printf(
      "brightfield: %d particles (reference %d), %d within 1 px, RMS of these %.3f px, %d tracks\n",
      c.ours, c.reference, c.within_1_px, c.rms(), c.summary.tracks);
  EXPECT_EQ(c.ours, 100);
  EXPECT_EQ(c.summary.tracks, 5);
  EXPECT_EQ(c.summary.long_tracks, 5);
  EXPECT_GE(c.within_1_px, 95);
  EXPECT_LT(c.rms(), 0.4);
}

}  // namespace
}  // namespace microswarm::vision

// SPDX-License-Identifier: Apache-2.0
// True merges and splits among robots that flicker.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "microswarm/vision/tracking/video_tracker.hpp"
#include "tests/cases.hpp"
#include "tests/vision/spots.hpp"

namespace microswarm::vision {
namespace {

/// A drawn video: pairs, one robot brighter than the other, that come together, stay one for 12
/// frames and part again; and faint robots that flicker, each beside a bright one, seen in a frame
/// with a chance of 70 %.
struct PairsVideo {
  static constexpr int width = 920;
  static constexpr int height = 460;
  static constexpr int frames = 60;
  static constexpr int pairs = 24;
  static constexpr int flickering = 40;

  std::vector<formats::Image> pictures;

  static Vec2 middle_of(int pair) { return {60.0 + 90 * (pair % 6), 60.0 + 90 * (pair / 6)}; }
  /// Half of the distance in a pair [px]; the finder sees one where it is below 7.
  static double half_of(int frame) {
    return frame < 24 ? 0.8 * (24 - frame) : frame < 36 ? 0.0 : 0.8 * (frame - 36);
  }
  static constexpr int merge_frame = 15;
  static constexpr int split_frame = 45;

  PairsVideo() {
    constexpr double beside = 14;  // [px]
    Rng rng(23, Purpose::test);
    const formats::Image ground = test::draw_spots(width, height, {}, 2.2, 0, 0, rng);
    pictures.reserve(frames);
    for (int k = 0; k < frames; ++k) {
      std::vector<Vec2> bright;
      std::vector<Vec2> dim;
      std::vector<Vec2> faint;
      for (int i = 0; i < pairs; ++i) {
        const Vec2 way = half_of(k) * unit_vector(0.7 * i);
        bright.push_back(middle_of(i) - way);
        dim.push_back(middle_of(i) + way);
      }
      for (int i = 0; i < flickering; ++i) {
        const Vec2 p{600.0 + 60 * (i % 5), 40.0 + 50 * (i / 5)};
        bright.push_back(p);
        if (rng.uniform() < 0.7) faint.push_back(p + beside * unit_vector(i));
      }
      formats::Image picture = test::draw_spots(width, height, bright, 2.2, 90, 1.5, rng);
      for (const formats::Image& more : {test::draw_spots(width, height, dim, 2.2, 60, 0, rng),
                                         test::draw_spots(width, height, faint, 2.2, 30, 0, rng)})
        for (std::size_t p = 0; p < picture.pixels.size(); ++p)
          picture.pixels[p] = static_cast<std::uint8_t>(
              std::min(255, picture.pixels[p] + more.pixels[p] - ground.pixels[p]));
      pictures.push_back(std::move(picture));
    }
  }
};

/// How many merges and splits are noted, and how many of the true ones: at a pair's place within
/// six frames.
struct Changes {
  int noted = 0;
  int right = 0;
};
Changes changes_in(const PairsVideo& video, int min_lifetime) {
  VideoTracker tracker({.um_per_px = 1,
                        .find = {.diameter = 13, .tone = ParticleTone::bright, .min_mass = 300},
                        .track = {.min_lifetime = min_lifetime}},
                       0.1);
  std::map<std::pair<int, int>, Vec2> position;  // of frame and robot
  for (int k = 0; k < PairsVideo::frames; ++k)
    for (const TrackRow& row : tracker.step({k, 0.1 * k, video.pictures[k]}))
      position[{k, row.id}] = place_in_picture(row.position, PairsVideo::height, 1);
  tracker.finish();
  Changes changes;
  std::set<std::pair<TrackChange, int>> told;
  for (const TrackEvent& e : tracker.events()) {
    if (e.change != TrackChange::merge && e.change != TrackChange::split) continue;
    ++changes.noted;
    const Vec2 at = position.at({e.frame, *e.other});
    const int due =
        e.change == TrackChange::merge ? PairsVideo::merge_frame : PairsVideo::split_frame;
    for (int i = 0; i < PairsVideo::pairs; ++i)
      if (distance(at, PairsVideo::middle_of(i)) < 20 && std::abs(e.frame - due) <= 6 &&
          told.insert({e.change, i}).second)
        ++changes.right;
  }
  return changes;
}

TEST(VideoTracker, TrueMergesAndSplitsAreToldFromFlicker) {
  const PairsVideo video;
  constexpr int truth = 2 * PairsVideo::pairs;
  for (const int min_lifetime : {TrackerParams{}.min_lifetime, 1}) {
    if (test::sanitized && min_lifetime == 1) break;  // twenty times the events, the same code
    const Changes c = changes_in(video, min_lifetime);
    std::printf("merges and splits that last %d frames: %d noted, recall %.3f, precision %.3f\n",
                min_lifetime, c.noted, 1.0 * c.right / truth, 1.0 * c.right / c.noted);
    EXPECT_GE(c.right, 0.9 * truth);
    if (min_lifetime > 1) {
      EXPECT_GE(c.right, 0.65 * c.noted);
    }
  }
}

}  // namespace
}  // namespace microswarm::vision

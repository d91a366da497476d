// SPDX-License-Identifier: Apache-2.0
#include "bench/vision.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/maths/rng.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/scene/scene_finder.hpp"
#include "microswarm/vision/scene/scene_windows.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"

namespace microswarm::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int width = 640;
constexpr int height = 424;
constexpr int robots = 600;
constexpr double spread = 2.2;  // [px] of a spot
constexpr double depth = 40;    // [grey]
constexpr double grain = 2;     // [grey] of noise
constexpr int diameter = 11;    // [px]
constexpr int swarm_width = 640;
constexpr int swarm_height = 480;

double ms_since(Clock::time_point began) {
  return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

/// Initial positions of robots that do not touch.
std::vector<Vec2> first_places(Rng& rng) {
  std::vector<Vec2> positions;
  for (int draw = 0; draw < 1'000'000 && std::ssize(positions) < robots; ++draw) {
    const double x = rng.uniform(8, width - 8);
    const Vec2 p{x, rng.uniform(8, height - 8)};
    if (std::none_of(positions.begin(), positions.end(),
                     [&](Vec2 q) { return distance(p, q) < 13; }))
      positions.push_back(p);
  }
  return positions;
}

formats::Image draw(const std::vector<Vec2>& at_px, Rng& rng) {
  std::vector<double> grey(static_cast<std::size_t>(width) * height);
  for (double& g : grey) g = 130 + grain * rng.normal();
  for (const Vec2 p : at_px)
    for (int y = std::max(0, static_cast<int>(p.y) - 9);
         y < std::min(height, static_cast<int>(p.y) + 10); ++y)
      for (int x = std::max(0, static_cast<int>(p.x) - 9);
           x < std::min(width, static_cast<int>(p.x) + 10); ++x)
        grey[static_cast<std::size_t>(y) * width + x] -=
            depth * maths::exp(-0.5 * squared_norm(Vec2{1.0 * x, 1.0 * y} - p) / (spread * spread));
  formats::Image image{width, height, 1, {}};
  for (const double g : grey)
    image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(g), 0L, 255L)));
  return image;
}

/// Synthetic video of robots on random walks with a common drift.
std::vector<vision::VideoFrame> video(int frames) {
  Rng rng(1, Purpose::scene);
  std::vector<Vec2> at = first_places(rng);
  std::vector<vision::VideoFrame> all;
  for (int k = 0; k < frames; ++k) {
    all.push_back({k, k / 24.0, draw(at, rng)});
    for (Vec2& p : at) {
      const double dx = 0.4 * rng.normal() + 0.1;
      p = {std::clamp(p.x + dx, 8.0, width - 8.0),
           std::clamp(p.y + 0.4 * rng.normal(), 8.0, height - 8.0)};
    }
  }
  return all;
}

/// Plain OpenCV detection: smooth, subtract the background, threshold, centroids of connected
/// components.
std::size_t find_with_opencv(const formats::Image& image) {
  cv::Mat smooth;
  cv::Mat ground;
  cv::Mat rise;
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centres;
  cv::GaussianBlur(vision::as_mat(image), smooth, {9, 9}, 1);
  cv::blur(vision::as_mat(image), ground, {diameter, diameter});
  cv::subtract(ground, smooth, rise);
  cv::threshold(rise, rise, 6, 255, cv::THRESH_BINARY);
  return static_cast<std::size_t>(cv::connectedComponentsWithStats(rise, labels, stats, centres)) -
         1;
}

struct Times {
  std::vector<double> found;   ///< [ms]
  std::vector<double> all;     ///< [ms]
  std::vector<double> opencv;  ///< [ms]
};

Times measure(const std::vector<vision::VideoFrame>& frames, const Stop& stop) {
  const vision::TrackSettings settings{.um_per_px = 0.35,
                                       .find = {.diameter = diameter, .min_mass = 100}};
  vision::ParticleFinder finder(settings.find);
  vision::VideoTracker tracker(settings, 1 / 24.0);
  Times times;
  for (const vision::VideoFrame& frame : frames) {
    if (stop()) break;
    auto began = Clock::now();
    finder.find(frame.picture);
    times.found.push_back(ms_since(began));
    began = Clock::now();
    tracker.step(frame);
    times.all.push_back(ms_since(began));
    began = Clock::now();
    find_with_opencv(frame.picture);
    times.opencv.push_back(ms_since(began));
  }
  return times;
}

/// Synthetic pictures of a moving swarm of clumps under uneven light with noise.
std::vector<formats::Image> swarm_pictures(int frames) {
  constexpr int clumps = 600;
  constexpr double radius = 50;  // [px]
  constexpr double noise = 5;    // [grey]
  Rng rng(2, Purpose::scene);
  std::vector<formats::Image> all;
  all.reserve(static_cast<std::size_t>(frames));
  for (int k = 0; k < frames; ++k) {
    std::vector<double> light(static_cast<std::size_t>(swarm_width) * swarm_height);
    for (int y = 0; y < swarm_height; ++y)
      for (int x = 0; x < swarm_width; ++x)
        light[static_cast<std::size_t>(y) * swarm_width + x] = 100 + 0.12 * x;
    const Vec2 centre{80 + 480.0 * k / frames, 240};
    for (int i = 0; i < clumps; ++i) {
      const double r = radius * std::sqrt(rng.uniform());
      const Vec2 p = centre + r * unit_vector(rng.uniform(-3.2, 3.2));
      for (int y = static_cast<int>(p.y) - 2; y <= static_cast<int>(p.y) + 2; ++y)
        for (int x = static_cast<int>(p.x) - 2; x <= static_cast<int>(p.x) + 2; ++x)
          if (distance({1.0 * x, 1.0 * y}, p) < 2.5)
            light[static_cast<std::size_t>(y) * swarm_width + x] *= 0.5;
    }
    formats::Image image{swarm_width, swarm_height, 1, {}};
    image.pixels.reserve(light.size());
    for (const double g : light)
      image.pixels.push_back(
          static_cast<std::uint8_t>(std::clamp(std::lround(g + noise * rng.normal()), 0L, 255L)));
    all.push_back(std::move(image));
  }
  return all;
}

/// Plain OpenCV detection of one swarm: smooth, adaptive threshold, closing, moments of the largest
/// contour.
double swarm_with_opencv(const formats::Image& image) {
  cv::Mat smooth;
  cv::Mat set;
  cv::GaussianBlur(vision::as_mat(image), smooth, {13, 13}, 3);
  cv::adaptiveThreshold(smooth, set, 255, cv::ADAPTIVE_THRESH_MEAN_C, cv::THRESH_BINARY_INV, 201,
                        15);
  cv::morphologyEx(set, set, cv::MORPH_CLOSE, cv::Mat::ones(7, 7, CV_8U));
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(set, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  double largest = 0;
  for (const auto& contour : contours) largest = std::max(largest, cv::moments(contour).m00);
  return largest;
}

/// Rows for one swarm in pictures of 640 × 480 pixels.
void add_swarm(std::vector<report::BenchRow>& rows, bool quick, const Stop& stop) {
  std::vector<double> ours;
  std::vector<double> peer;
  std::vector<double> scene;
  std::vector<double> quick_scene;
  vision::SceneWindows windows{formats::Mask{}};
  for (const formats::Image& picture : swarm_pictures(quick ? 100 : 500)) {
    if (stop()) break;
    auto began = Clock::now();
    vision::find_swarm(picture);
    ours.push_back(ms_since(began));
    began = Clock::now();
    swarm_with_opencv(picture);
    peer.push_back(ms_since(began));
    began = Clock::now();
    vision::find_scene(picture);
    scene.push_back(ms_since(began));
    began = Clock::now();
    windows.find(picture, {}, {}, {});
    quick_scene.push_back(ms_since(began));
  }
  for (const double q : {0.5, 0.99})
    rows.push_back({.name = "a swarm and obstacles found in windows",
                    .quantity = q == 0.5 ? "time a frame, median" : "time a frame, 99 of 100",
                    .unit = "ms",
                    .ours = quantile(quick_scene, q),
                    .peer = quantile(scene, q),
                    .peer_name = "ours, in the whole picture"});
  rows.push_back({.name = "a swarm and obstacles found",
                  .quantity = "time a frame, median",
                  .unit = "ms",
                  .ours = quantile(scene, 0.5),
                  .peer = quantile(peer, 0.5),
                  .peer_name = "OpenCV: blur, adaptive threshold, close, contours"});
  for (const double q : {0.5, 0.99})
    rows.push_back({.name = "one swarm found",
                    .quantity = q == 0.5 ? "time a frame, median" : "time a frame, 99 of 100",
                    .unit = "ms",
                    .ours = quantile(ours, q),
                    .peer = quantile(peer, q),
                    .peer_name = "OpenCV: blur, adaptive threshold, close, contours",
                    .aim = q == 0.5 ? 1 : 2});
}

}  // namespace

std::vector<report::BenchRow> vision(bool quick, const Stop& stop) {
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const Times times = measure(video(quick ? 100 : 500), stop);
  std::vector<report::BenchRow> rows;
  const auto add = [&](const char* name, const std::vector<double>& ours, double q,
                       std::optional<double> aim) {
    rows.push_back({.name = name,
                    .quantity = q == 0.5 ? "time a frame, median" : "time a frame, 99 of 100",
                    .unit = "ms",
                    .ours = quantile(ours, q),
                    .peer = quantile(times.opencv, q),
                    .peer_name = "OpenCV: blur, box, threshold, components",
                    .aim = aim});
  };
  add("600 robots found", times.found, 0.5, std::nullopt);
  add("600 robots found", times.found, 0.99, std::nullopt);
  add("600 robots found and followed", times.all, 0.5, 2);
  add("600 robots found and followed", times.all, 0.99, std::nullopt);
  add_swarm(rows, quick, stop);
  cv::setNumThreads(threads);
  return rows;
}

}  // namespace microswarm::bench

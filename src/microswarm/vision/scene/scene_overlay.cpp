// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/scene_overlay.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/image/overlay.hpp"
#include "microswarm/vision/image/strokes.hpp"

namespace microswarm::vision {
namespace {

// From Okabe & Ito's palette, which is safe for colour-blind readers.
const cv::Scalar swarm_green(0, 158, 115);
const cv::Scalar yellow(240, 228, 66);
const cv::Scalar orange(230, 159, 0);
constexpr std::array<std::uint8_t, 3> blue{86, 180, 233};

void draw_ring(cv::Mat& picture, const std::vector<Vec2>& ring, const cv::Scalar& colour,
               int thickness) {
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    cv::line(picture, fine(ring[j]), fine(ring[i]), colour, thickness, cv::LINE_AA, fraction_bits);
}

std::vector<Vec2> blob_ellipse(const Blob& blob) {
  constexpr int corners = 90;
  std::vector<Vec2> ring;
  ring.reserve(corners);
  for (int k = 0; k < corners; ++k) {
    const Vec2 u = unit_vector(2 * std::numbers::pi * k / corners);
    ring.push_back(blob.centre_px +
                   rotated({blob.semi_major_px * u.x, blob.semi_minor_px * u.y}, blob.angle));
  }
  return ring;
}

void draw_blob(cv::Mat& picture, const Blob& blob, const cv::Scalar& colour) {
  draw_ring(picture, blob.outline_px, colour, 2);
  draw_ring(picture, blob_ellipse(blob), white, 1);
  for (const Vec2 axis : {Vec2{blob.semi_major_px, 0}, Vec2{0, blob.semi_minor_px}}) {
    const Vec2 half = rotated(axis, blob.angle);
    cv::line(picture, fine(blob.centre_px - half), fine(blob.centre_px + half), white, 1,
             cv::LINE_AA, fraction_bits);
  }
}

}  // namespace

formats::Image draw_scene(const formats::Image& picture, const SeenScene& scene,
                          const formats::Mask* walls) {
  formats::Image shown =
      overlay(picture, walls ? *walls : formats::Mask(picture.width, picture.height), blue);
  cv::Mat canvas = as_mat(shown);
  for (const SeenObstacle& o : scene.obstacles) {
    if (o.disc)
      cv::circle(canvas, fine(o.disc->centre_px),
                 static_cast<int>(std::lround(o.disc->radius_px * (1 << fraction_bits))), orange, 2,
                 cv::LINE_AA, fraction_bits);
    else
      draw_ring(canvas, o.hull_px, orange, 2);
  }
  if (scene.swarm.swarm)
    draw_blob(canvas, *scene.swarm.swarm, swarm_green);
  else
    for (const Blob& blob : scene.swarm.candidates) draw_blob(canvas, blob, yellow);
  return shown;
}

void draw_reasons(formats::Image& shown, const std::vector<NotSwarm>& blobs) {
  constexpr double size = 0.4;
  cv::Mat canvas = as_mat(shown);
  for (const NotSwarm& no : blobs) {
    draw_ring(canvas, no.blob.outline_px, white, 1);
    const std::string words = short_reason(no);
    int below = 0;
    const cv::Size text = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, size, 1, &below);
    const auto position = [](double at, int length, int picture) {
      return std::clamp(static_cast<int>(std::lround(at)) - length / 2, 2,
                        std::max(2, picture - length - 2));
    };
    draw_text(canvas, words,
              {position(no.blob.centre_px.x, text.width, shown.width),
               position(no.blob.centre_px.y, 0, shown.height) + text.height / 2},
              size);
  }
}

}  // namespace microswarm::vision

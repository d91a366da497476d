// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/robot_width.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm::vision {
namespace {

constexpr int ray_count = 24;
constexpr int ray_steps = 8;             // to a pixel beyond the mask
constexpr int around_rings = 3;          // in which the background is looked for
constexpr std::size_t lightest_of = 10;  // the tenth lightest value around is the background
constexpr double edge_share = 0.6;       // of the contrast, which a ray must exceed
constexpr double wide_share = 0.4;       // of the rays
constexpr int blur_px = 3;               // [px], against noise

/// Directions of the rays, all alike around.
const std::array<Vec2, ray_count>& directions() {
  static const std::array<Vec2, ray_count> all = [] {
    std::array<Vec2, ray_count> made;
    for (int k = 0; k < ray_count; ++k) {
      const auto [sine, cosine] = maths::sincos(2 * std::numbers::pi * k / ray_count);
      made[static_cast<std::size_t>(k)] = {cosine, sine};
    }
    return made;
  }();
  return all;
}

/// Smoothed greys, with particles above the background for any tone.
class Greys {
 public:
  Greys(const formats::Image& grey, ParticleTone tone)
      : sign_(tone == ParticleTone::dark ? -1 : 1) {
    cv::blur(as_mat(grey), smooth_, {blur_px, blur_px});
  }
  /// Nothing outside of the picture.
  std::optional<double> at(Vec2 place) const {
    const auto x = static_cast<int>(std::lround(place.x)),
               y = static_cast<int>(std::lround(place.y));
    if (x < 0 || y < 0 || x >= smooth_.cols || y >= smooth_.rows) return std::nullopt;
    return sign_ * smooth_.ptr<std::uint8_t>(y)[x];
  }

 private:
  double sign_;
  cv::Mat smooth_;
};

bool is_wider(const Greys& greys, Vec2 centre, int radius) {
  const double reach = radius + 1;
  std::array<double, ray_count> least{};  // along each ray
  std::array<bool, ray_count> is_seen{};
  std::vector<double> around;
  double inside = 0;
  int inside_count = 0;
  for (std::size_t k = 0; k < ray_count; ++k) {
    const Vec2 along = directions()[k];
    is_seen[k] = true;
    least[k] = 1e9;
    for (int step = 0; step <= ray_steps; ++step) {
      const auto value = greys.at(centre + reach * step / ray_steps * along);
      is_seen[k] = is_seen[k] && value;
      if (!value) continue;
      least[k] = std::min(least[k], *value);
      if (2 * step > ray_steps) continue;
      inside += *value;
      ++inside_count;
    }
    for (int ring = 1; ring <= around_rings; ++ring)
      if (const auto value = greys.at(centre + (1 + 0.5 * ring) * reach * along))
        around.push_back(*value);
  }
  if (inside_count == 0 || around.size() < lightest_of) return false;
  inside /= inside_count;
  const auto low = around.begin() + static_cast<std::ptrdiff_t>(around.size() / lightest_of);
  std::nth_element(around.begin(), low, around.end());
  const double limit = *low + edge_share * (inside - *low);
  int wide_rays = 0, seen = 0;
  for (std::size_t k = 0; k < ray_count; ++k) {
    if (!is_seen[k]) continue;
    ++seen;
    wide_rays += least[k] > limit ? 1 : 0;
  }
  return 2 * seen >= ray_count && wide_rays >= wide_share * seen;
}

}  // namespace

std::vector<bool> wider_than_mask(const formats::Image& grey, std::span<const Particle> particles,
                                  int radius_px, ParticleTone tone) {
  std::vector<bool> wider(particles.size());
  if (particles.empty()) return wider;
  const Greys greys(grey, tone);
  for (std::size_t i = 0; i < particles.size(); ++i)
    wider[i] = is_wider(greys, particles[i].at_px, radius_px);
  return wider;
}

}  // namespace microswarm::vision

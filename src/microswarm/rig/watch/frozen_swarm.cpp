// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/frozen_swarm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace microswarm::rig {
namespace {

constexpr int spacing = 8;            // [px] of the pixels that show noise and light
constexpr double noises = 2.5;        // that a change must exceed
constexpr double least_change = 1.5;  // grey value
constexpr double enough_way = 3;      // [px] commanded
constexpr int enough_pictures = 3;
constexpr double sd_of_median = 1.4826;

}  // namespace

bool FrozenSwarm::has_changed(const formats::Image& now,
                              std::span<const vision::Ring> swarm) const {
  if (before_.pixels.size() != now.pixels.size() || before_.width != now.width) return true;
  double sum_before = 0, sum_now = 0;
  const auto each_sample = [&](const auto& use) {
    for (int y = spacing / 2; y < now.height; y += spacing)
      for (int x = spacing / 2; x < now.width; x += spacing) {
        const std::size_t i = now.index(x, y);
        use(before_.pixels[i], now.pixels[i]);
      }
  };
  each_sample([&](double a, double b) { sum_before += a, sum_now += b; });
  if (sum_before <= 0) return true;
  const double gain = sum_now / sum_before;
  std::array<int, 256> counts{};
  int total = 0;
  each_sample([&](double a, double b) {
    ++counts[static_cast<std::size_t>(std::min(255.0, std::abs(b - gain * a)))];
    ++total;
  });
  int median = 0;
  for (int below = 0;
       median < 255 && 2 * (below += counts[static_cast<std::size_t>(median)]) < total; ++median) {
  }
  const double limit = noises * sd_of_median * (median + 0.5) + least_change;
  return std::any_of(swarm.begin(), swarm.end(), [&](const vision::Ring& ring) {
    double squares = 0;
    int count = 0;
    const auto low = [](double at, double radius) {
      return std::max(0, static_cast<int>(std::floor(at - radius)));
    };
    const int right = std::min(now.width - 1, static_cast<int>(ring.centre_px.x + ring.radius_px));
    const int bottom =
        std::min(now.height - 1, static_cast<int>(ring.centre_px.y + ring.radius_px));
    for (int y = low(ring.centre_px.y, ring.radius_px); y <= bottom; ++y)
      for (int x = low(ring.centre_px.x, ring.radius_px); x <= right; ++x) {
        const std::size_t i = now.index(x, y);
        const double off = now.pixels[i] - gain * before_.pixels[i];
        squares += off * off;
        ++count;
      }
    return count > 0 && squares > limit * limit * count;
  });
}

void FrozenSwarm::take(const formats::Image& picture, std::span<const vision::Ring> swarm,
                       Vec2 commanded_px, double t) {
  if (longest_ <= 0 || swarm.empty() || !fault_.empty()) return;
  const double last = std::exchange(last_, t);
  if (has_changed(picture, swarm)) {
    before_ = picture;
    commanded_ = {};
    pictures_ = 0;
    return;
  }
  const bool is_commanded = norm(commanded_px) > 0;
  if (pictures_ == 0 && !is_commanded) return;  // a swarm that rests looks like this
  if (pictures_++ == 0) begun_ = last;
  commanded_ = commanded_ + commanded_px;
  // Less far to and fro than along a way: what returns to its place looks as if it had not left.
  if (t - begun_ < longest_ + delay_ || norm(commanded_) < enough_way ||
      pictures_ < enough_pictures)
    return;
  fault_ = fmt::format(
      "the swarm's picture has shown nothing but noise for {:.2f} s while {:.3g} px were "
      "commanded, allowed {:.6g} s: the picture is frozen, or the field does not move the swarm",
      t - begun_, norm(commanded_), longest_ + delay_);
}

}  // namespace microswarm::rig

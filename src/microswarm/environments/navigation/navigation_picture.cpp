// SPDX-License-Identifier: Apache-2.0
#include "microswarm/environments/navigation/navigation_picture.hpp"

#include <algorithm>
#include <cmath>

namespace microswarm::environments {
namespace {

using Colour = NavigationPicture::Colour;
constexpr Colour wall_colour{15, 30, 65};
constexpr Colour free_colour{90, 150, 190};
constexpr Colour goal_colour{150, 190, 160};
constexpr Colour goal_mark{220, 60, 50};
constexpr Colour obstacle_colour{235, 140, 60};
constexpr Colour swarm_colour{250, 250, 100};

std::size_t pixels(double length, double um_per_px) {
  return static_cast<std::size_t>(std::max(1.0, std::round(length / um_per_px)));
}

}  // namespace

NavigationPicture::NavigationPicture(const NavigationTask& task, std::size_t side)
    : bounds_(task.world().map->bounds()),
      um_per_px_(std::max(bounds_.width(), bounds_.height()) / static_cast<double>(side)),
      goal_tolerance_(task.scenario().goal_tolerance),
      width_(pixels(bounds_.width(), um_per_px_)),
      height_(pixels(bounds_.height(), um_per_px_)) {
  walls_.reserve(3 * width_ * height_);
  for (std::size_t row = 0; row < height_; ++row)
    for (std::size_t column = 0; column < width_; ++column) {
      const bool free = task.world().map->is_free(middle(column, row), 0);
      const Colour& colour = free ? free_colour : wall_colour;
      walls_.insert(walls_.end(), colour.begin(), colour.end());
    }
}

Vec2 NavigationPicture::middle(std::size_t column, std::size_t row) const {
  return {bounds_.lo.x + um_per_px_ * (static_cast<double>(column) + 0.5),
          bounds_.hi.y - um_per_px_ * (static_cast<double>(row) + 0.5)};
}

/// Colours the pixels near the disc `within` whose middle satisfies `holds`.
template <class Holds>
void NavigationPicture::paint(std::span<std::uint8_t> out, const Disc& within, const Colour& colour,
                              Holds&& holds) const {
  const auto index = [&](double at, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(at / um_per_px_, 0.0, static_cast<double>(count)));
  };
  const double reach = within.radius + um_per_px_;
  const Vec2 from{within.centre.x - bounds_.lo.x, bounds_.hi.y - within.centre.y};
  const std::size_t right = index(from.x + reach, width_);
  const std::size_t bottom = index(from.y + reach, height_);
  for (std::size_t row = index(from.y - reach, height_); row < bottom; ++row)
    for (std::size_t column = index(from.x - reach, width_); column < right; ++column)
      if (holds(middle(column, row)))
        std::ranges::copy(colour, out.data() + 3 * (row * width_ + column));
}

void NavigationPicture::draw(const NavigationEpisode& episode, std::span<std::uint8_t> out) const {
  std::ranges::copy(walls_, out.begin());
  const auto paint_disc = [&](const Disc& disc, const Colour& colour) {
    paint(out, disc, colour, [&](Vec2 p) { return distance(p, disc.centre) <= disc.radius; });
  };
  const double least = 2 * um_per_px_;
  paint_disc({episode.goal(), std::max(goal_tolerance_, least)}, goal_colour);
  const Snapshot world = episode.world();
  for (const Body& body : world.moving().bodies())
    paint(out, enclosing_disc(body), obstacle_colour,
          [&](Vec2 p) { return distance(p, body) == 0; });
  paint_disc({episode.goal(), least}, goal_mark);
  const Pose2& pose = episode.pose();
  const double radius = std::max(episode.radius(), least);
  paint_disc({pose.position, radius}, swarm_colour);
  paint_disc({pose.position + 0.6 * radius * unit_vector(pose.heading), 0.3 * radius}, wall_colour);
}

}  // namespace microswarm::environments

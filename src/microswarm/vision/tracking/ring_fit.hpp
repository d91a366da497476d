// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::vision {

/// A circle in a picture [px]; (0, 0) is the centre of the first pixel, y points down.
struct Ring {
  Vec2 centre_px{};
  double radius_px = 0;
};

/// Circle through points by least squares of |p − c|² − r² (Kåsa 1976); empty for collinear points.
std::optional<Ring> circle_through(const std::vector<Vec2>& points);

/// The smallest circle around points; empty if there is none.
std::optional<Ring> enclosing_circle(const std::vector<Vec2>& points);

/// Fits the dark circle (bright unless `dark`) around `start` with a radius between 0.5 and 1.5
/// times `radius`. Takes the extreme grey on each of many rays, fits a circle by least squares
/// (Kåsa 1976) without outliers, and repeats from the new centre until it converges. Empty if fewer
/// than a third of the rays agree. `grey` has one channel.
std::optional<Ring> fit_ring(const formats::Image& grey, Vec2 start, double radius, bool dark);

}  // namespace microswarm::vision

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm::vision {

/// Particles of a one-channel picture that are wider than the round mask of `radius_px` in which
/// they were measured: from the centre of the mask they reach to a pixel beyond it in two of five
/// directions, above 60 % of their contrast with what is around. The mask lies anywhere on such a
/// particle, and so does its centroid. A neighbour that touches is in fewer directions.
std::vector<bool> wider_than_mask(const formats::Image& grey, std::span<const Particle> particles,
                                  int radius_px, ParticleTone tone);

}  // namespace microswarm::vision

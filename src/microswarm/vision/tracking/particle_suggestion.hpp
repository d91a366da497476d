// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/tracking/mass_gap.hpp"
#include "microswarm/vision/tracking/particles.hpp"

namespace microswarm::vision {

/// Settings of ParticleFinder that suit pictures, and what they were chosen by.
struct ParticleSuggestion {
  ParticleParams params{};      ///< as given where nothing better is known
  bool knows_diameter = false;  ///< the robots' edge was seen; else it is the given one
  MassKinds kinds{};            ///< with these parameters
  int pictures = 0;
  std::vector<double> masses{};        ///< of all features, also of noise
  std::vector<double> other_masses{};  ///< of those of the other tone

  /// Features heavier than `mass`, on average over the pictures.
  double heavier_than(double mass) const;
};

/// Suggests `min_mass` from the gap in the masses of features, `diameter` from the mean picture of
/// a robot, and `tone` if only the other tone has robots. The pictures have one channel and one
/// size. Throws InputError as ParticleFinder does.
ParticleSuggestion suggest_particles(std::span<const formats::Image> pictures,
                                     const ParticleParams& params);

}  // namespace microswarm::vision

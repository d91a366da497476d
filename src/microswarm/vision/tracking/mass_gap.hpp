// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace microswarm::vision {

/// A gap in the distribution of the masses of features, between noise and robots.
struct MassGap {
  double noise_to = 0;      ///< upper end of the noise
  double robots_from = 0;   ///< lower end of the robots
  double min_mass() const;  ///< between them, as far from both by ratio
};

/// Classification of the features' masses into noise and robots.
struct MassKinds {
  std::optional<MassGap> gap{};
  bool has_noise = false;  ///< features of both tones are as frequent: some or all are noise
};

/// Looks for the gap between noise and robots. The logarithms of the masses are smoothed by a
/// Gaussian; gaps are where their density is below a quarter of that on both sides, over a factor
/// of 1.4 at least. Noise has no tone, so what lies below the gap must also be there in the
/// features of the other tone, `other`. Both are of `pictures` pictures.
MassKinds mass_kinds(std::span<const double> masses, std::span<const double> other, int pictures);

/// Density of the logarithms to base 10 of masses, per bin from `first` on.
struct MassDensity {
  double first = 0;  ///< logarithm of the first bin's centre
  std::vector<double> density{};
  static constexpr double step = 0.01;
};
MassDensity mass_density(std::span<const double> masses);

}  // namespace microswarm::vision

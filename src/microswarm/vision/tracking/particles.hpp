// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/fields.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/vision/tracking/band_pass.hpp"

namespace microswarm {

/// How particles differ from the ground.
enum class ParticleTone { dark, bright };
constexpr auto enum_names(ParticleTone) {
  return std::array<std::pair<ParticleTone, std::string_view>, 2>{
      {{ParticleTone::dark, "dark"}, {ParticleTone::bright, "bright"}}};
}

/// What of a particle is measured.
enum class ParticleShape {
  spot,  ///< the centroid of its greys
  ring,  ///< the circle of the opposite tone around it, as in bright field
};
constexpr auto enum_names(ParticleShape) {
  return std::array<std::pair<ParticleShape, std::string_view>, 2>{
      {{ParticleShape::spot, "spot"}, {ParticleShape::ring, "ring"}}};
}

/// Settings of ParticleFinder. `diameter` is what one measures in a picture, a little too large
/// rather than too small; the others have values that follow from it or seldom change.
struct ParticleParams {
  int diameter = 11;
  ParticleTone tone = ParticleTone::dark;
  ParticleShape shape = ParticleShape::spot;
  double min_mass = 20;
  int separation = 0;
  double noise = 1;
  double least_rise = 1;
  double percentile = 64;
  int max_moves = 10;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.diameter, {"diameter",
                          Unit::px,
                          {3, 1001},
                          "Diameter of a particle; an even one counts as one more."});
    visit(self.tone, {"tone", Unit::none, {}, "Particles are dark or bright against the ground."});
    visit(self.shape, {"shape",
                       Unit::none,
                       {},
                       "Its centroid is measured, or the circle of the opposite tone around it."});
    visit(self.min_mass,
          {"min_mass", Unit::none, {0, 1e9}, "Least sum of greys above the ground in a particle."});
    visit(self.separation, {"separation",
                            Unit::px,
                            {0, 2000},
                            "Of two particles nearer than this the fainter is dropped; 0: diameter "
                            "plus one."});
    visit(self.noise,
          {"noise", Unit::px, {0, 100}, "Spread of the Gaussian that takes the noise away."});
    visit(self.least_rise,
          {"least_rise", Unit::none, {0, 255}, "Greys above the ground that are still ground."});
    visit(self.percentile, {"percentile",
                            Unit::none,
                            {0, 100},
                            "Percentage of the pixels above ground that a peak must outshine."});
    visit(self.max_moves,
          {"max_moves", Unit::none, {1, 1000}, "Most steps of a mask towards its centroid."});
  }
};

/// A particle in a picture.
struct Particle {
  Vec2 at_px;               ///< centre: x right, y down, (0, 0) is the middle of the first pixel
  double mass = 0;          ///< sum of the greys above the ground
  double signal = 0;        ///< the highest of them
  double radius_px = 0;     ///< of a ring, or of the even disc with the same gyration
  double gyration_px = 0;   ///< radius of gyration of the greys
  double eccentricity = 0;  ///< 0 for a round one, towards 1 for a line
};

/// Finds particles with sub-pixel centres as Crocker and Grier do [crocker], in the conventions of
/// trackpy: the picture is band-passed, peaks are the brightest of their surroundings and above a
/// percentile, a round mask moves from each to its centroid, and of two that come too near each
/// other the fainter is dropped.
class ParticleFinder {
 public:
  /// Throws InputError when the Gaussian of `noise` is as wide as a particle.
  explicit ParticleFinder(const ParticleParams& params);

  /// The particles of a picture of one channel, in the order of their peaks, row by row. Those
  /// nearer to the border than their radius are left out. Valid until the next call.
  const std::vector<Particle>& find(const Image& grey);

  /// Largest distance between the greys of a particle and its centre: half the diameter [px].
  int radius_px() const { return radius_; }

 private:
  struct Peak {
    int column = 0;
    int row = 0;
    friend bool operator==(const Peak&, const Peak&) = default;
  };
  struct MaskPixel {
    int dx = 0;
    int dy = 0;
    double cosine = 0;  ///< of twice the angle
    double sine = 0;
    std::ptrdiff_t offset(int width) const { return static_cast<std::ptrdiff_t>(dy) * width + dx; }
  };

  void scale_to_bytes(const std::vector<float>& rise);
  void find_peaks();
  int peak_threshold() const;
  Particle refine(Peak peak) const;
  void describe(Particle& particle, Peak at) const;
  void fit_rings(const Image& grey);
  void drop_close();

  ParticleParams params_;
  int radius_;
  int separation_;
  BandPass band_pass_;
  std::vector<MaskPixel> mask_;
  int width_ = 0;
  int height_ = 0;
  double greys_per_byte_ = 0;
  std::vector<std::uint8_t> bytes_;  ///< the filtered picture, its highest at 255
  std::vector<Peak> peaks_;
  std::vector<Particle> particles_;
};

}  // namespace microswarm

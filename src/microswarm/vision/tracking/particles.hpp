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
  double min_foreground = 1;
  double percentile = 64;
  int max_moves = 10;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.diameter, {"diameter",
                          Unit::px,
                          {3, 1001},
                          "Diameter of a particle; even values count as one more."});
    visit(self.tone,
          {"tone", Unit::none, {}, "Particles are dark or bright against the background."});
    visit(self.shape, {"shape", Unit::none, {}, "Measure the centroid, or the ring around it."});
    visit(self.min_mass,
          {"min_mass", Unit::none, {0, 1e9}, "Minimum sum of grey values above the background."});
    visit(self.separation,
          {"separation", Unit::px, {0, 2000}, "Minimum distance of particles; 0: diameter + 1."});
    visit(self.noise,
          {"noise", Unit::px, {0, 100}, "Standard deviation of the smoothing Gaussian."});
    visit(self.min_foreground, {"min_foreground",
                                Unit::none,
                                {0, 255},
                                "Grey values above the background that are ignored.",
                                false,
                                "least_rise"});
    visit(self.percentile, {"percentile",
                            Unit::none,
                            {0, 100},
                            "Percentile of the foreground that a peak must exceed."});
    visit(self.max_moves,
          {"max_moves", Unit::none, {1, 1000}, "Maximum number of centroid refinements."});
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/vision/tracking/band_pass.hpp"
#include "microswarm/vision/tracking/peaks.hpp"
#include "microswarm/vision/tracking/round_window.hpp"

namespace microswarm::vision {

/// Tone of particles relative to the background.
enum class ParticleTone { dark, bright };
constexpr auto enum_names(ParticleTone) {
  return std::array<std::pair<ParticleTone, std::string_view>, 2>{
      {{ParticleTone::dark, "dark"}, {ParticleTone::bright, "bright"}}};
}

/// Method of measuring a particle.
enum class ParticleShape {
  spot,  ///< centroid of its greys
  ring,  ///< circle of the opposite tone around it, as in bright field
};
constexpr auto enum_names(ParticleShape) {
  return std::array<std::pair<ParticleShape, std::string_view>, 2>{
      {{ParticleShape::spot, "spot"}, {ParticleShape::ring, "ring"}}};
}

/// Settings of ParticleFinder. `diameter` is measured in a picture; rather too large than too
/// small. The other settings have defaults that depend on it or rarely need a change.
struct ParticleParams {
  int diameter = 11;
  ParticleTone tone = ParticleTone::dark;
  ParticleShape shape = ParticleShape::spot;
  double min_mass = 20;
  int separation = 0;
  double noise = 1;
  double min_foreground = 1;
  double percentile = 64;
  int max_moves = 0;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.diameter,
          px("diameter", 3, 1001, "Diameter of a particle; even values count as one more."));
    visit(self.tone, plain("tone", "Particles are dark or bright against the background."));
    visit(self.shape, plain("shape", "Measure the centroid, or the ring around it."));
    visit(self.min_mass,
          plain("min_mass", 0, 1e9, "Minimum sum of grey values above the background."));
    visit(self.separation,
          px("separation", 0, 2000, "Minimum distance of particles; 0: diameter + 1."));
    visit(self.noise, px("noise", 0, 100, "Standard deviation of the smoothing Gaussian."));
    visit(self.min_foreground,
          plain("min_foreground", 0, 255, "Grey values above the background that are ignored.")
              .formerly("least_rise"));
    visit(self.percentile,
          plain("percentile", 0, 100, "Percentile of the foreground that a peak must exceed."));
    visit(self.max_moves,
          plain("max_moves", 0, 10000, "Maximum centroid refinements; 0: diameter + 20, enough."));
  }
};

/// A particle in a picture.
struct Particle {
  Vec2 at_px{};             ///< centre: x right, y down, (0, 0) is the centre of the first pixel
  double mass = 0;          ///< sum of the greys above the background
  double signal = 0;        ///< maximum grey above the background
  double radius_px = 0;     ///< of a ring, or of the uniform disc with equal gyration
  double gyration_px = 0;   ///< radius of gyration of the greys
  double eccentricity = 0;  ///< 0 for a circle, towards 1 for a line
};

/// Finds particles with subpixel centres by the method of Crocker and Grier [crocker], with the
/// conventions of trackpy. The picture is band-passed. Peaks are local maxima above a percentile. A
/// round mask moves from each peak until its centre is at the centroid: by a pixel at first, as in
/// trackpy, then at once, which ends after a few moves also for discs of hundreds of pixels. Of two
/// particles that are too close, the fainter is dropped.
///
/// A mask that cuts a particle, which it shows by the greys at its rim, is moved between pixels
/// until its centre is at the centroid: positions do not cling to pixels.
///
/// From a diameter of `large_diameter` on, particles are rarely points and often flat discs. The
/// highest pixel of a disc may be anywhere in it, so peaks are also taken near the border. Greys
/// below a quarter of the particle's own level do not count for the centre and those above three
/// quarters count alike, since the noise in its area would otherwise move the centre.
class ParticleFinder {
 public:
  /// Throws InputError if the Gaussian of `noise` is as wide as a particle.
  explicit ParticleFinder(const ParticleParams& params);

  static constexpr int large_diameter = 15;  ///< [px]

  /// The particles of a one-channel picture, in the order of their peaks, row by row. Particles
  /// closer to the border than their radius are omitted. Valid until the next call.
  const std::vector<Particle>& find(const formats::Image& grey);

  /// Number of particles of the last picture whose centroid still moved when the limit of moves
  /// ended the refinement: their centres are wrong.
  int unsettled() const { return unsettled_; }
  /// Number of particles of the last picture that were dropped for one which is closer than the
  /// separation, though they are as far apart as two masks' centres and weigh half as much or more:
  /// likely neighbours.
  int crowded() const { return crowded_; }

  /// Maximum distance of a particle's pixels from its centre: half the diameter [px].
  int radius_px() const { return radius_; }

 private:
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
  /// End of the moves of a mask: at its centroid, where another mask was, or by the limit.
  enum class Walk { stands, known, moves };

  /// Moves each peak to its centroid. Peaks that meet on the way are one particle.
  void refine_peaks();
  Walk refine(Peak& at, Particle& particle, int limit);
  /// Measures the mask around a pixel; returns the distance of the centroid.
  Vec2 measure(Peak at, Particle& particle) const;
  /// Pixel to which the mask moves from `at` for a centroid that is `off` from it.
  Peak moved(Peak at, Vec2 off, int move) const;
  /// Measures the rest of this particle and of some that follow.
  void describe(std::size_t first);
  /// Corrects the centre of a large particle and of one that the mask cuts.
  void centre(Particle& particle, Peak at) const;
  /// Centroid of the weights of greys in a round mask with a soft edge, between pixels.
  Vec2 soft_centroid(Vec2 centre, const std::array<double, 256>& weights) const;
  std::size_t pixel_index(Peak at) const {
    return static_cast<std::size_t>(at.row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(at.column);
  }
  bool is_large() const { return odd_diameter() >= large_diameter; }
  int odd_diameter() const { return 2 * radius_ + 1; }
  /// Whether a point is as far from the border as a particle must be.
  bool is_inside(Vec2 at_px) const;
  void fit_rings(const formats::Image& grey);
  void keep_apart();

  ParticleParams params_;
  int radius_;
  int separation_;
  BandPass band_pass_;
  RoundWindow window_;
  std::vector<MaskPixel> mask_;
  int width_ = 0;
  int height_ = 0;
  int unsettled_ = 0;
  int crowded_ = 0;
  double greys_per_byte_ = 0;
  std::vector<std::uint8_t> bytes_;  ///< the filtered picture, its highest at 255; then zeros
  std::vector<Peak> peaks_;
  std::vector<std::uint8_t> visited_;  ///< marks of pixels where a mask was
  std::vector<std::size_t> path_;      ///< these pixels
  std::vector<bool> settled_;          ///< of each particle
  std::vector<Particle> particles_;
};

}  // namespace microswarm::vision

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "microswarm/core/execution/stop.hpp"
#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm::vision {

/// Method of separating vessels from tissue.
enum class VesselMethod {
  automatic,  ///< regions if two greys under uneven light explain the picture, else lines
  lines,      ///< lines of a few widths on uneven background: a fundus photograph
  regions,    ///< two greys under uneven light: channels of a chip, a stained network
};
constexpr auto enum_names(VesselMethod) {
  return std::array<std::pair<VesselMethod, std::string_view>, 3>{
      {{VesselMethod::automatic, "automatic"},
       {VesselMethod::lines, "lines"},
       {VesselMethod::regions, "regions"}}};
}

/// Tone of vessels relative to their surroundings.
enum class Polarity {
  automatic,  ///< the tone whose lines stand out; of two greys, the connected and narrow one
  dark,
  bright,
};
constexpr auto enum_names(Polarity) {
  return std::array<std::pair<Polarity, std::string_view>, 3>{
      {{Polarity::automatic, "automatic"}, {Polarity::dark, "dark"}, {Polarity::bright, "bright"}}};
}

/// Pieces of the network to keep.
enum class KeepPieces { largest, all };
constexpr auto enum_names(KeepPieces) {
  return std::array<std::pair<KeepPieces, std::string_view>, 2>{
      {{KeepPieces::largest, "largest"}, {KeepPieces::all, "all"}}};
}

/// Settings of `segment_vessels`. Thresholds are in interquartile ranges of the line score above
/// its median.
struct VesselParams {
  VesselMethod method = VesselMethod::automatic;
  Polarity polarity = Polarity::automatic;
  double wide_width = 0;
  double threshold = 2.2;
  double seed_threshold = 2.8;
  double wall_level = 0.5;
  double gap = 3;
  double min_piece = 8;
  double min_width = 0;
  KeepPieces keep = KeepPieces::largest;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.method, plain("method", "Lines on an uneven background, or regions of two greys."));
    visit(self.polarity, plain("polarity", "Vessels are dark or bright, or automatic."));
    visit(self.wide_width, px("wide_width", 0, 1000, "Width of the widest vessels; 0: measured."));
    visit(self.threshold,
          plain("threshold", 0, 100, "Line score, in standard deviations, of a vessel pixel."));
    visit(self.seed_threshold,
          plain("seed_threshold", 0, 100, "Line score that a vessel must reach somewhere."));
    visit(self.wall_level,
          plain("wall_level", 0, 1, "Wall position between background (0) and vessel (1)."));
    visit(self.gap, plain("gap", 0, 20, "Maximum gap bridged, in wide widths."));
    visit(self.min_piece,
          plain("min_piece", 0, 1e4, "Minimum area of a piece, in squares of the wide width.")
              .formerly("least_piece"));
    visit(self.min_width,
          px("min_width", 0, 1000, "Width below which vessels are dropped; 0: none."));
    visit(self.keep, plain("keep", "Keep the largest connected network, or all pieces."));
  }
};

/// Result of `segment_vessels`.
struct VesselSegmentation {
  formats::Mask vessels{};                    ///< 1 = vessel
  formats::Mask field_of_view{};              ///< 1 = inside the optical field of view
  VesselMethod method = VesselMethod::lines;  ///< that was taken
  Polarity polarity = Polarity::dark;         ///< that was taken
  /// Share of the picture's variance that two greys explain; without it if the method was set.
  std::optional<double> two_level_share{};
  /// Evidence for the polarity over that for the other one, at least 1; without it if it was set.
  std::optional<double> polarity_odds{};
  bool is_faint = false;     ///< noise hides vessels; not known if the method was set to lines
  double wide_width_px = 0;  ///< measured, or as set
  double scale = 1;          ///< working pixels per picture pixel
  int bridges = 0;           ///< number of closed gaps
  int pieces = 0;            ///< connected networks before `keep` is applied
  double kept_share = 0;  ///< fraction of the vessel area kept by `keep`; 0 if there are no vessels
  double view_share = 0;  ///< vessel area as a fraction of the field of view
};

/// The parts of the vessels that discs of this diameter [px] cover: those that are so wide.
formats::Mask wide_vessels(const VesselSegmentation& found, double diameter);

/// Method and polarity in a line: "lines, dark". A choice that was close is noted, with the setting
/// of the alternative after `option`: "compare method=regions".
std::string describe_choice(const VesselSegmentation& found, std::string_view option = {});

/// Note about vessels that are fainter than the noise allows, with advice; empty if they are not.
std::string note_on_noise(const VesselSegmentation& found);

/// Segments vessels in a fundus or microscope picture (green channel of colour pictures). The
/// methods are deterministic and untrained. Regions: two levels under uneven light are fitted,
/// noise is removed by total variation, walls are where the picture crosses `wall_level` between
/// the levels. Lines: absorbance, line detectors over widths, hysteresis threshold, walls fitted to
/// the local contrast, gaps bridged; at the resolution at which wide vessels have the detectors'
/// design width, so the same settings apply to pictures of any size. `stop` ends it without
/// vessels. Throws InputError if the picture has no pixels or neither 1 nor 3 channels.
VesselSegmentation segment_vessels(const formats::Image& image, const VesselParams& params = {},
                                   const Stop& stop = {});

}  // namespace microswarm::vision

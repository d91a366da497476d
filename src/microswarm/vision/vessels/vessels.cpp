// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/vessels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/vision/image/mask_ops.hpp"
#include "microswarm/vision/image/mat.hpp"
#include "microswarm/vision/vessels/field_of_view.hpp"
#include "microswarm/vision/vessels/line_vessels.hpp"
#include "microswarm/vision/vessels/region_vessels.hpp"
#include "microswarm/vision/vessels/two_levels.hpp"

namespace microswarm::vision {
namespace {

constexpr double clearly_two = 0.9;     // share explained above which a picture is of two levels
constexpr double close_share = 0.05;    // on either side of it, the choice is close
constexpr double doubtful_noise = 0.6;  // in contrasts, of levels that do not explain the picture
constexpr double hiding_noise = 1.55;   // the same if they do: measured on drawn channels of 6 px
constexpr double close_odds = 1.25;     // of polarities

void require_picture(const formats::Image& image) {
  if (image.width < 1 || image.height < 1) throw InputError("picture to segment: no pixels");
  if (image.channels != 1 && image.channels != 3)
    throw InputError("picture to segment: " + std::to_string(image.channels) +
                     " channels, expected 1 or 3");
}

/// The channel with the highest contrast of blood.
cv::Mat green_channel(const formats::Image& image) {
  cv::Mat picture = as_mat(image);
  if (image.channels == 1) return picture;
  cv::Mat green;
  cv::extractChannel(picture, green, 1);
  return green;
}

/// Whether vessels are bright: as set, or by the odds, which are noted.
bool is_bright(const VesselParams& params, VesselSegmentation& result, double odds_of_bright) {
  const bool bright = params.polarity == Polarity::automatic ? odds_of_bright > 1
                                                             : params.polarity == Polarity::bright;
  if (params.polarity == Polarity::automatic)
    result.polarity_odds = std::max(odds_of_bright, 1 / odds_of_bright);
  result.polarity = bright ? Polarity::bright : Polarity::dark;
  return bright;
}

/// Whether noise hides what there is: two levels explain nothing beyond noise, or only such that
/// are no clearer than it, or their difference is too small for narrow channels.
bool is_hidden(const TwoLevels& levels) {
  if (levels.explained <= 0) return levels.contrast > 0;
  const double noise = levels.noise / levels.contrast;
  return noise > (levels.explained < clearly_two ? doubtful_noise : hiding_noise);
}

/// Finds vessels; notes method and polarity in `result`.
FoundVessels found_in(const cv::Mat& grey, const cv::Mat& view, const VesselParams& params,
                      VesselSegmentation& result, const Stop& stop) {
  TwoLevels levels;
  if (params.method != VesselMethod::lines) levels = fit_two_levels(grey, view, stop);
  if (params.method != VesselMethod::lines) result.is_faint = is_hidden(levels);
  result.method = params.method;
  if (params.method == VesselMethod::automatic) {
    result.two_level_share = levels.explained;
    result.method = levels.explained > clearly_two ? VesselMethod::regions : VesselMethod::lines;
  }
  const bool known = params.polarity != Polarity::automatic;
  if (result.method == VesselMethod::lines) {
    const bool bright = is_bright(params, result, known ? 1 : odds_of_bright_lines(grey, view));
    return line_vessels(grey, view, bright, params, stop);
  }
  const cv::Mat picture = level_picture(grey, levels, stop);
  const cv::Mat brighter = (picture > 0.5) & view;
  const bool bright = is_bright(params, result, known ? 1 : odds_of_bright_network(brighter, view));
  if (levels.contrast <= 0) return {.vessels = cv::Mat::zeros(view.size(), CV_8U)};
  return region_vessels(picture, view, bright, params);
}

}  // namespace

formats::Mask wide_vessels(const VesselSegmentation& found, double diameter) {
  return to_mask(opened(to_mat(found.vessels), diameter));
}

std::string describe_choice(const VesselSegmentation& found, std::string_view option) {
  const bool lines = found.method == VesselMethod::lines;
  const bool dark = found.polarity == Polarity::dark;
  std::string text = std::string(lines ? "lines" : "regions") + ", " + (dark ? "dark" : "bright");
  const auto doubt = [&](const std::string& why, const char* other) {
    text += fmt::format("; {}: compare {}{}", why, option, other);
  };
  if (found.two_level_share && std::abs(*found.two_level_share - clearly_two) < close_share)
    doubt("two greys explain " + number_text(std::round(100 * *found.two_level_share)) +
              " % of the picture (regions above " + number_text(100 * clearly_two) + " %)",
          lines ? "method=regions" : "method=lines");
  if (found.polarity_odds && *found.polarity_odds < close_odds)
    doubt("the polarity is close (" + number_text(std::round(100 * *found.polarity_odds) / 100) +
              " to 1)",
          dark ? "polarity=bright" : "polarity=dark");
  return text;
}

std::string note_on_noise(const VesselSegmentation& found) {
  if (!found.is_faint) return {};
  return "the vessels are fainter than the noise allows: check the overlay, average several frames "
         "or take a larger magnification";
}

VesselSegmentation segment_vessels(const formats::Image& image, const VesselParams& params,
                                   const Stop& stop) {
  require_picture(image);
  VesselSegmentation result;
  result.field_of_view = field_of_view(image);
  const cv::Mat view = to_mat(result.field_of_view);
  FoundVessels found = found_in(green_channel(image), view, params, result, stop);
  result.wide_width_px = found.wide_width_px;
  result.scale = found.scale;
  result.bridges = found.bridges;

  cv::Mat vessels = stop() ? cv::Mat::zeros(view.size(), CV_8U) : found.vessels;
  if (params.min_width > 0) vessels = opened(vessels, params.min_width);
  widen_corners(vessels);
  vessels &= view;
  result.pieces = count_pieces(vessels);
  const double all = cv::countNonZero(vessels);
  if (params.keep == KeepPieces::largest) vessels = largest_piece(vessels);
  const double kept = cv::countNonZero(vessels);
  if (all > 0) result.kept_share = kept / all;
  result.view_share = kept / std::max(1, cv::countNonZero(view));
  result.vessels = to_mask(vessels);
  return result;
}

}  // namespace microswarm::vision

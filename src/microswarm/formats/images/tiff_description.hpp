// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::formats {

/// Description of a stack by ImageJ or OME, on the first page of a TIFF.
struct TiffDescription {
  std::string_view software{};  ///< "ImageJ" or "OME"; empty without such a description
  int images = 1;               ///< pages of all channels, slices and times
  int channels = 1;
  int slices = 1;
  int times = 1;
  std::string order = "CZT";          ///< which of them changes from page to page first: C, Z and T
  std::optional<double> um_per_px{};  ///< width of a pixel [µm]
  std::optional<double> um_per_px_y{};  ///< its height [µm]
  std::optional<double> interval{};     ///< time between pictures [s]
  /// Times of the pages [s] in the order of the file, if each has one; OME only.
  std::vector<std::optional<double>> page_times{};
};

/// Reads a page's description; `x_resolution` and `y_resolution` are the page's pixels per unit, 0
/// without. What it does not understand stays at its default.
TiffDescription parse_tiff_description(std::string_view text, double x_resolution,
                                       double y_resolution);

}  // namespace microswarm::formats

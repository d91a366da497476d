// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::formats {

/// Most pictures that a description may report.
inline constexpr int max_tiff_images = 1'000'000;

/// Description of a stack by ImageJ, SCIFIO, tifffile or OME, on the first page of a TIFF. A plane
/// is a picture of one channel, slice and time; planes are numbered by `order`.
struct TiffDescription {
  std::string_view software{};  ///< "ImageJ", "OME", ...; empty without such a description
  int images = 1;               ///< pages that the file should hold, as far as is given
  int channels = 1;
  int slices = 1;
  int times = 1;
  std::string order = "CZT";  ///< which of them changes from plane to plane first: C, Z and T
  std::optional<double> um_per_px{};    ///< width of a pixel [µm]
  std::optional<double> um_per_px_y{};  ///< its height [µm]
  std::optional<double> interval{};     ///< time between pictures [s]
  /// Times of the planes [s], if each has one; OME only.
  std::vector<std::optional<double>> page_times{};
  /// Page of each plane, from 0, or -1 for one that is not in this file; empty: plane k is page k.
  std::vector<int> plane_pages{};
  std::vector<std::string> other_files{};  ///< that hold the other planes
  int pixel_channels = 1;                  ///< among the samples of a pixel
  bool one_directory = false;              ///< pages may follow the first one without directories
  std::vector<std::string> notes{};        ///< what cannot be used, a line each

  /// Channels, slices or times for 'C', 'Z' or 'T'.
  int size_of(char axis) const { return axis == 'C' ? channels : axis == 'Z' ? slices : times; }
};

/// Reads a page's description in the file named `file_name`; `x_resolution` and `y_resolution` are
/// the page's pixels per unit, 0 without, and `samples` those of a pixel. What it does not
/// understand stays at its default.
TiffDescription parse_tiff_description(std::string_view text, double x_resolution,
                                       double y_resolution, std::string_view file_name = {},
                                       int samples = 1);

/// A count of 1 to max_tiff_images; 1 for anything else.
int count_in_text(std::string_view text);

}  // namespace microswarm::formats

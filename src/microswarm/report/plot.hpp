// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace microswarm {

/// How a series is drawn: joined, as steps, as points, as bars from 0, or as one box with whiskers
/// over all its y (x of the first point says where).
enum class PlotStyle { line, points, bars, box };

/// Values of one thing, x and y of equal length.
struct Series {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;
  PlotStyle style = PlotStyle::line;
};

/// A horizontal line with its label: a mean, a limit, a paper's value.
struct Level {
  std::string label;
  double y = 0;
};

/// One diagram. Labels carry their units.
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Series> series;
  std::vector<Level> levels;
  bool log_y = false;
  std::optional<double> y_min;
  std::optional<double> y_max;
};

/// Draws the plots side by side with gnuplot into .png, .svg or .pdf by the file's extension.
/// Throws InputError when gnuplot is not installed or the file cannot be written.
void write_plots(const std::vector<Plot>& plots, const std::filesystem::path& path);

}  // namespace microswarm

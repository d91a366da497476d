// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace microswarm {

/// How a series is drawn: joined, joined with a marker at each point, as points, as rings, as bars
/// from 0, as one box with whiskers over all its y (x of the first point says where), as filled
/// outlines (violins), or as the hollow diamonds of values that a paper gives.
enum class PlotStyle { line, marked, points, rings, bars, box, filled, published };

/// Values of one thing, x and y of equal length. With `low` and `high`, as long as those, a marked
/// series or points have an interval at each value.
struct Series {
  std::string label;
  std::vector<double> x;
  std::vector<double> y;
  PlotStyle style = PlotStyle::line;
  std::optional<std::size_t> colour = {};  ///< as that of the series of this number; else its own
  std::vector<double> low = {};
  std::vector<double> high = {};
};

/// One colour a method in all figures of a paper, measured and published alike: `Series::colour`.
namespace method_colours {
inline constexpr std::size_t drrt_star = 0, rrt_star = 1, a_star = 2, uniform_rrt_star = 3,
                             radar = 4, predictive = 5, other = 6;  // [drrt], [radar]
inline constexpr std::size_t straight_stop = 1, potential_field = 2, velocity_obstacle = 3,
                             follow_path = 6, radar_as_published = 7;  // beside the navigators
inline constexpr std::size_t divide_and_conquer = 0, heuristic = 1, heuristic_plain_tree = 2,
                             rollout = 3;                        // [gather]
inline constexpr std::size_t global_rrt = 0, global_search = 2;  // [global]
}  // namespace method_colours

/// A horizontal line with its label: a mean, a limit, a paper's value.
struct Level {
  std::string label;
  double y = 0;
};

/// A vertical line with its label.
struct Mark {
  std::string label;
  double x = 0;
};

/// A stretch of the x axis with a grey ground.
struct Band {
  double from = 0;
  double to = 0;
};

/// A label of an axis.
struct AxisTick {
  std::string label;
  double at = 0;
};

/// One diagram. Labels carry their units. Series of the style `box` label the x axis where no ticks
/// are given.
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Series> series;
  std::vector<Level> levels;
  std::vector<Mark> marks;
  std::vector<Band> bands;
  std::string band_label;
  std::vector<AxisTick> x_ticks;
  std::vector<AxisTick> y_ticks;
  bool log_x = false;
  bool log_y = false;
  bool key_below = false;  ///< the legend stands below, not in the diagram
  std::optional<double> x_min;
  std::optional<double> x_max;
  std::optional<double> y_min;
  std::optional<double> y_max;
};

/// Draws the plots side by side with gnuplot into .png, .svg or .pdf by the file's extension.
/// Throws InputError when gnuplot is not installed or the file cannot be written.
void write_plots(const std::vector<Plot>& plots, const std::filesystem::path& path);
/// As stem.png, stem.svg and stem.pdf.
void write_plots_everywhere(const std::vector<Plot>& plots, const std::filesystem::path& stem);

}  // namespace microswarm

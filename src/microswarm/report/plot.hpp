// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace microswarm::report {

/// Style of a series: joined; joined with a marker at each point; points; rings; bars from 0; one
/// box with whiskers over all y, at the x of the first point; filled outlines (violins); or hollow
/// diamonds for values published in a paper.
enum class PlotStyle { line, marked, points, rings, bars, box, filled, published };

/// Values of one quantity; x and y have equal length. `low` and `high`, if given, have the same
/// length and add an interval to each value of a marked series or points.
struct Series {
  std::string label{};
  std::vector<double> x{};
  std::vector<double> y{};
  PlotStyle style = PlotStyle::line;
  std::optional<std::size_t> colour = {};  ///< that of this series; default: its own
  std::vector<double> low = {};
  std::vector<double> high = {};
};

/// Values of `Series::colour`: one colour per method in all figures of a paper, for measured and
/// published values alike.
namespace method_colours {
inline constexpr std::size_t drrt_star = 0, rrt_star = 1, a_star = 2, uniform_rrt_star = 3,
                             radar = 4, safe_interval = 5, other = 6;  // [drrt], [radar]
inline constexpr std::size_t straight_stop = 1, potential_field = 2, velocity_obstacle = 3,
                             follow_path = 6, radar_as_published = 7;  // besides the navigators
inline constexpr std::size_t divide_and_conquer = 0, heuristic = 1, heuristic_plain_tree = 2,
                             rollout = 3;                        // [gather]
inline constexpr std::size_t global_rrt = 0, global_search = 2;  // [global]
}  // namespace method_colours

/// A labelled horizontal line: a mean, a limit, a value from a paper.
struct Level {
  std::string label{};
  double y = 0;
};

/// A labelled vertical line.
struct Mark {
  std::string label{};
  double x = 0;
};

/// A range of the x axis with grey background.
struct Band {
  double from = 0;
  double to = 0;
};

/// A tick label of an axis.
struct AxisTick {
  std::string label{};
  double at = 0;
};

/// One diagram. Labels include their units. Series of style `box` label the x axis unless ticks are
/// given.
struct Plot {
  std::string title{};
  std::string x_label{};
  std::string y_label{};
  std::vector<Series> series{};
  std::vector<Level> levels{};
  std::vector<Mark> marks{};
  std::vector<Band> bands{};
  std::string band_label{};
  std::vector<AxisTick> x_ticks{};
  std::vector<AxisTick> y_ticks{};
  bool log_x = false;
  bool log_y = false;
  bool key_below = false;    ///< puts the legend below the diagram
  bool equal_scale = false;  ///< a unit is as long on both axes, as for a path
  std::optional<double> x_min{};
  std::optional<double> x_max{};
  std::optional<double> y_min{};
  std::optional<double> y_max{};
};

/// Draws the plots side by side with gnuplot as .png, .svg or .pdf, according to the file's
/// extension. Throws InputError if gnuplot is not installed or the file cannot be written.
void write_plots(const std::vector<Plot>& plots, const std::filesystem::path& path);
/// Writes stem.png, stem.svg and stem.pdf.
void write_plots_everywhere(const std::vector<Plot>& plots, const std::filesystem::path& stem);

}  // namespace microswarm::report

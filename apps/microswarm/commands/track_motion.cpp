// SPDX-License-Identifier: Apache-2.0
#include "commands/track_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/vision/tracking/motion.hpp"
#include "microswarm/vision/tracking/trajectories.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

constexpr double min_msd = 1e-12;  // [µm²] less is rounding
constexpr int few = 5;             // robots whose mean motion is their own rather than a drift

/// Speeds from picture to picture [µm/s].
std::vector<double> speeds_of(const std::vector<vision::TrackRow>& rows) {
  std::map<int, const vision::TrackRow*> last;
  std::vector<double> speeds;
  for (const vision::TrackRow& row : rows) {
    const vision::TrackRow*& before = last[row.id];
    if (before && before->frame + 1 == row.frame && row.t > before->t)
      speeds.push_back(distance(row.position, before->position) / (row.t - before->t));
    before = &row;
  }
  return speeds;
}

/// Share of the values in each of `bins` equal bins from 0 to `end`, as a line of steps.
report::Series share_in_bins(const std::string& label, const std::vector<double>& values,
                             double end, int bins) {
  std::vector<double> counts(static_cast<std::size_t>(bins));
  for (const double value : values)
    if (value < end) counts[static_cast<std::size_t>(value / end * bins)] += 1;
  report::Series series{.label = label};
  for (int k = 0; k < bins; ++k)
    for (const int edge : {k, k + 1}) {
      series.x.push_back(end * edge / bins);
      series.y.push_back(100 * counts[static_cast<std::size_t>(k)] /
                         std::max<double>(1, static_cast<double>(values.size())));
    }
  return series;
}

report::Plot msd_plot(const std::vector<vision::MsdRow>& msd,
                      const std::optional<vision::PowerLaw>& law) {
  report::Plot plot{.title = "mean squared displacement",
                    .x_label = "lag (s)",
                    .y_label = "MSD (µm²)",
                    .log_x = true,
                    .log_y = true,
                    .key_below = true};
  report::Series points{.label = "measured, ± standard error", .style = report::PlotStyle::points};
  for (const vision::MsdRow& row : msd) {
    if (row.msd < min_msd) continue;
    const double error = row.standard_error.value_or(0);
    points.x.push_back(row.t);
    points.y.push_back(row.msd);
    points.low.push_back(std::max(0.01 * row.msd, row.msd - error));
    points.high.push_back(row.msd + error);
  }
  if (law && !points.x.empty()) {
    report::Series line{.label = fmt::format("∝ lag to the power of {:.2f}", law->exponent)};
    for (const double t : {points.x.front(), points.x.back()}) {
      line.x.push_back(t);
      line.y.push_back(4 * law->diffusion * maths::pow(t, law->exponent));
    }
    plot.series.push_back(line);
  }
  plot.series.insert(plot.series.begin(), points);
  return plot;
}

report::Plot speed_plot(const std::vector<double>& speeds) {
  constexpr int bins = 30;
  report::Plot plot{.title = "speeds",
                    .x_label = "speed from picture to picture (µm/s)",
                    .y_label = "share (%)",
                    .key_below = true,
                    .y_min = 0};
  const double end = speeds.empty() ? 1 : 1.05 * *std::max_element(speeds.begin(), speeds.end());
  plot.series.push_back(share_in_bins("speeds", speeds, std::max(end, 1e-6), bins));
  if (!speeds.empty()) {
    const double middle = median(speeds);
    plot.marks.push_back({fmt::format("median {:.3g}", middle), middle});
  }
  plot.x_min = 0;
  return plot;
}

report::Plot pixel_plot(const vision::PixelBias& bias) {
  constexpr int bins = 10;
  report::Plot plot{.title = "positions within a pixel",
                    .x_label = "fractional part of the position (px)",
                    .y_label = "share (%)",
                    .key_below = true,
                    .x_min = 0,
                    .x_max = 1,
                    .y_min = 0};
  plot.series.push_back(share_in_bins("x", bias.fractions_x, 1, bins));
  plot.series.push_back(share_in_bins("y", bias.fractions_y, 1, bins));
  plot.levels.push_back({"even", 100.0 / bins});
  return plot;
}

void note_bias(const vision::PixelBias& bias) {
  if (!bias.is_significant) return;
  note(
      "note: positions {} (mean cosine {:.2f} over {} of them, 0 if even): a larger "
      "find.diameter_px helps\n",
      bias.cling > 0 ? "cling to the pixels' centres" : "avoid the pixels' centres", bias.cling,
      bias.fractions_x.size());
}

}  // namespace

nlohmann::ordered_json write_motion(const vision::TrackResult& result,
                                    const formats::Image& picture, bool remove_drift,
                                    const std::filesystem::path& folder) {
  std::vector<vision::TrackRow> rows = result.rows;
  const std::vector<vision::DriftRow> drift = vision::drift_of(rows);
  const vision::PixelBias bias = vision::pixel_bias(rows);
  const double scale = result.settings.um_per_px.value_or(1);
  int most = 0;
  for (const vision::DriftRow& row : drift) most = std::max(most, row.robots);
  if (remove_drift) vision::subtract_drift(rows, drift, scale);
  if (remove_drift && most < few)
    note("note: the drift is the mean motion of {} robot{} at most: their own motion is removed\n",
         most, most == 1 ? "" : "s");
  note_bias(bias);
  const auto msd = vision::mean_squared_displacements(rows);
  const auto law = vision::fit_power_law(msd);
  const auto speeds = speeds_of(rows);
  write_file_atomically(folder / "drift.csv", io::csv_table(drift));
  write_file_atomically(folder / "msd.csv", io::csv_table(msd));
  write_file_atomically(folder / "robots.csv", io::csv_table(vision::motion_of_each(rows)));
  if (!picture.pixels.empty())
    formats::write_png(folder / "trajectories.png",
                       vision::draw_trajectories(picture, rows, scale));
  std::vector<report::Plot> plots{speed_plot(speeds), pixel_plot(bias)};
  if (report::Plot plot = msd_plot(msd, law); !plot.series.front().x.empty())
    plots.insert(plots.begin(), std::move(plot));
  report::write_plots_everywhere(plots, folder / "motion");
  using Json = nlohmann::ordered_json;
  return {{"drift_is_removed", remove_drift},
          {"msd_exponent", law ? Json(law->exponent) : Json(nullptr)},
          {"diffusion_um2_per_s", law ? Json(law->diffusion) : Json(nullptr)},
          {"msd_lags_used", law ? law->lags : 0},
          {"median_speed_um_per_s", speeds.empty() ? Json(nullptr) : Json(median(speeds))},
          {"pixel_cling", bias.cling},
          {"pixel_cling_is_significant", bias.is_significant}};
}

std::string motion_summary(const nlohmann::ordered_json& motion) {
  std::string text;
  if (motion["msd_exponent"].is_null())
    text = "  MSD       –: no track is long enough\n";
  else
    text = fmt::format("  MSD       4 · {:.3g} µm² · (lag / s)^{:.2f}, from {} lags{}\n",
                       motion["diffusion_um2_per_s"].get<double>(),
                       motion["msd_exponent"].get<double>(), motion["msd_lags_used"].get<int>(),
                       motion["drift_is_removed"].get<bool>() ? ", without the drift" : "");
  return text;
}

}  // namespace microswarm::cli

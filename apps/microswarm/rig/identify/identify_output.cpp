// SPDX-License-Identifier: Apache-2.0
#include "rig/identify/identify_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/rig/identify/driven_path.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const rig::Estimate& estimate) {
  return {{"value", estimate.value}, {"standard_error", estimate.error}};
}

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::string before_text(const rig::MeasuredValue& value) {
  return value.before ? fmt::format("{:.5g} {}", *value.before, value.unit) : std::string("–");
}

/// Commanded and seen path.
report::Plot path_plot(const Identification& of) {
  report::Plot plot{.title = "Path",
                    .x_label = "x (µm)",
                    .y_label = "y (µm)",
                    .key_below = true,
                    .equal_scale = true};
  report::Series commanded{.label = "commanded"}, fitted{.label = "fitted"},
      seen{.label = "seen", .style = report::PlotStyle::points};
  const rig::DrivenPath path(of.response.data.field, of.response.data.commands, 0);
  const Vec2 start = of.fit.path.front().position - path.at(of.fit.path.front().t);
  for (const rig::Sighting& s : of.fit.path) {
    const Vec2 at = start + path.at(s.t);
    commanded.x.push_back(at.x), commanded.y.push_back(at.y);
    fitted.x.push_back(s.position.x), fitted.y.push_back(s.position.y);
  }
  for (const rig::Sighting& s : of.response.data.seen)
    if (s.t >= of.fit.from && s.t <= of.fit.until)
      seen.x.push_back(s.position.x), seen.y.push_back(s.position.y);
  plot.series = {commanded, seen, fitted};
  return plot;
}

report::Plot sweep_plot(const Identification& of) {
  report::Plot plot{.title = "Speed over frequency",
                    .x_label = "frequency (Hz)",
                    .y_label = "share of the commanded speed",
                    .key_below = true};
  report::Series levels{.label = "measured", .style = report::PlotStyle::marked};
  for (const rig::FrequencyLevel& level : of.sweep.levels) {
    levels.x.push_back(level.frequency);
    levels.y.push_back(level.share.value);
    levels.low.push_back(level.share.value - level.share.error);
    levels.high.push_back(level.share.value + level.share.error);
  }
  plot.series = {levels};
  if (of.sweep.followed) plot.marks.push_back({"followed", *of.sweep.followed});
  if (of.sweep.lost) plot.marks.push_back({"not followed", *of.sweep.lost});
  plot.y_min = 0;
  if (!levels.x.empty()) plot.x_max = 1.05 * std::ranges::max(levels.x);  // room for a mark
  return plot;
}

}  // namespace

void print_identification(const Identification& of) {
  const rig::ResponseFit& fit = of.fit;
  print(
      "{} sightings over {:.0f} s, {:.0f} µm commanded; RMS residual {:.2g} µm, drift {:.2g} "
      "µm/s\n",
      fit.sightings, fit.until - fit.from, fit.driven, fit.residual, norm(fit.drift));
  print("{:<9} {:<34} {:>12} {:>22} {:>12}\n", "", "key", "before", "measured", "after");
  for (const rig::MeasuredValue& value : of.values)
    print("{:<9} {:<34} {:>12} {:>22} {:>12}\n", enum_name(value.what), value.key,
          before_text(value), value.measured, fmt::format("{:.5g} {}", value.after, value.unit));
  const std::string step_out = rig::step_out_text(of.sweep);
  if (step_out.empty())
    print("step-out frequency: no sweep was driven\n");
  else if (!of.sweep.lost)
    print("step-out frequency: {}, the sweep did not meet it\n", step_out);
  else if (!of.sweep.followed)
    print("step-out frequency: {}\n", step_out);
}

nlohmann::ordered_json to_json(const Identification& of) {
  const rig::ResponseFit& fit = of.fit;
  Json values = Json::array(), levels = Json::array();
  for (const rig::MeasuredValue& value : of.values)
    values.push_back({{"what", enum_name(value.what)},
                      {"key", value.key},
                      {"before", number_or_null(value.before)},
                      {"after", value.after},
                      {"standard_error", value.error}});
  for (const rig::FrequencyLevel& level : of.sweep.levels)
    levels.push_back({{"frequency_hz", level.frequency}, {"share", to_json(level.share)}});
  return {{"gain", to_json(fit.gain)},
          {"angle_deg", to_json(rig::Estimate{degrees(fit.angle.value), degrees(fit.angle.error)})},
          {"delay_s", to_json(fit.delay)},
          {"drift_um_per_s", {fit.drift.x, fit.drift.y}},
          {"rms_um", fit.residual},
          {"explained", fit.explained},
          {"sightings", fit.sightings},
          {"commanded_um", fit.driven},
          {"step_out_followed_hz", number_or_null(of.sweep.followed)},
          {"step_out_lost_hz", number_or_null(of.sweep.lost)},
          {"levels", levels},
          {"values", values},
          {"doubts", of.doubts}};
}

void draw_identification(const Identification& of, const std::filesystem::path& folder) {
  std::vector<report::Plot> plots{path_plot(of)};
  if (!of.sweep.levels.empty()) plots.push_back(sweep_plot(of));
  report::write_plots_everywhere(plots, folder / "identify");
}

}  // namespace microswarm::cli

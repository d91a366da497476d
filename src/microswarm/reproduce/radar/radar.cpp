// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/radar/radar.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/reproduce/figures.hpp"
#include "microswarm/reproduce/radar/safety.hpp"

namespace microswarm::reproduce {

namespace fs = std::filesystem;

report::ReproduceRow version_row(const RadarVersion& version, double share,
                                 const std::string& figure, const std::string& quantity,
                                 const std::string& unit, std::optional<double> paper,
                                 std::optional<double> ours) {
  const std::string named = fmt::format("{}, {}", quantity, version.name);
  if (!paper || version.as_published) return row_within(share, figure, named, unit, paper, ours);
  return row_without_aim("not the paper's navigator", figure, named, unit, paper, ours);
}

std::string spread_text(const std::vector<double>& values) {
  if (values.size() < 4) return "";
  return fmt::format("quartiles {:.4g} – {:.4g}", quantile(values, 0.25), quantile(values, 0.75));
}

RadarSetting load_radar(const ReproduceOptions& options, const char* name,
                        const RadarVersion& version) {
  const fs::path file = options.scenarios / "papers" / "radar" / name;
  experiment::Scenario scenario = experiment::read_scenario(file);
  std::get<navigation::RadarParams>(scenario.navigator).as_published = version.as_published;
  experiment::Experiment opened =
      experiment::open_experiment(std::move(scenario), file.parent_path(), file.string());
  return {std::move(opened.scene), std::move(opened.world)};
}

std::vector<report::ReproduceRow> radar_figures(const std::string& figure,
                                                const ReproduceOptions& options, const Stop& stop) {
  constexpr std::array<Figure, 11> figures{{{"fig1", radar_cost},
                                            {"fig5-6", radar_single},
                                            {"fig7", radar_series},
                                            {"fig8", radar_twelve},
                                            {"fig10", radar_experiment},
                                            {"fig11-12", radar_twelve_experiment},
                                            {"fig13", radar_micromaze},
                                            {"safety", radar_safety},
                                            {"safety-noisy", radar_safety_noisy},
                                            {"fast", radar_fast},
                                            {"hardships", radar_hardships}}};
  return reproduce_figures("radar", figures, figure, options, stop);
}

}  // namespace microswarm::reproduce

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/reproduce/radar/radar_run.hpp"
#include "microswarm/reproduce/reproduce.hpp"

namespace microswarm::reproduce {

/// A swarm of 200 px is taken as 750 µm. The paper gives no scale, but equates a gap of 75.31 µm
/// with 0.10 body lengths.
inline constexpr double radar_um_per_px = 3.75;

/// Relative tolerances around the paper's values.
inline constexpr double near_cost = 0.15;
inline constexpr double near_time = 0.10;

/// A version of the navigator: the paper's, or ours.
struct RadarVersion {
  const char* name;
  const char* stem;  ///< of file names
  bool as_published;
};
inline constexpr std::array<RadarVersion, 2> radar_versions{
    {{"as published", "published", true}, {"ours", "ours", false}}};

/// A row of one version. The paper's value is the aim of the published version; ours has no aim.
report::ReproduceRow version_row(const RadarVersion& version, double share,
                                 const std::string& figure, const std::string& quantity,
                                 const std::string& unit, std::optional<double> paper,
                                 std::optional<double> ours);

/// Text such as "quartiles 0.12 – 0.31"; empty for fewer than four values.
std::string spread_text(const std::vector<double>& values);

/// A scenario of [radar], ready to run.
struct RadarSetting {
  experiment::Scene scene{};
  World world{};

  navigation::RadarParams& params() {
    return std::get<navigation::RadarParams>(scene.scenario.navigator);
  }
};
/// Throws InputError like read_scenario.
RadarSetting load_radar(const ReproduceOptions& options, const char* name,
                        const RadarVersion& version);

/// Figures of [radar] by subject: one obstacle (5, 6, 7, 10), twelve obstacles (8, 11, 12), the
/// micromaze (13). If interrupted, they return the completed rows, or none.
std::vector<report::ReproduceRow> radar_cost(const ReproduceOptions& options, const Stop& stop);
std::vector<report::ReproduceRow> radar_single(const ReproduceOptions& options, const Stop& stop);
std::vector<report::ReproduceRow> radar_series(const ReproduceOptions& options, const Stop& stop);
std::vector<report::ReproduceRow> radar_twelve(const ReproduceOptions& options, const Stop& stop);
std::vector<report::ReproduceRow> radar_experiment(const ReproduceOptions& options,
                                                   const Stop& stop);
std::vector<report::ReproduceRow> radar_twelve_experiment(const ReproduceOptions& options,
                                                          const Stop& stop);
std::vector<report::ReproduceRow> radar_micromaze(const ReproduceOptions& options,
                                                  const Stop& stop);

}  // namespace microswarm::reproduce

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

/// A swarm of 200 px is taken for one of 750 µm: the paper gives no scale, but a gap of 75.31 µm as
/// 0.10 body lengths.
inline constexpr double radar_um_per_px = 3.75;

/// How near to the paper's figures ours are to be, as a share of them.
inline constexpr double near_cost = 0.15;
inline constexpr double near_time = 0.10;

/// What a figure is measured with: the paper's navigator, and ours.
struct RadarVersion {
  const char* name;
  const char* stem;  ///< of file names
  bool as_published;
};
inline constexpr std::array<RadarVersion, 2> radar_versions{
    {{"as published", "published", true}, {"ours", "ours", false}}};

/// A row of one version. The paper's figure is the aim of what is published; ours has none.
ReproduceRow version_row(const RadarVersion& version, double share, const std::string& figure,
                         const std::string& quantity, const std::string& unit,
                         std::optional<double> paper, std::optional<double> ours);

/// "quartiles 0.12 – 0.31" of some values; nothing for fewer than four.
std::string spread_of(const std::vector<double>& values);

/// A scenario of [radar], ready to run.
struct RadarSetting {
  Scene scene;
  World world;

  RadarParams& params() { return std::get<RadarParams>(scene.scenario.navigator); }
};
/// Throws InputError as reading a scenario does.
RadarSetting load_radar(const ReproduceOptions& options, const char* name,
                        const RadarVersion& version);

/// Figures of [radar], by subject: one obstacle (5, 6, 7, 10), twelve obstacles (8, 11, 12), the
/// micromaze (13). What is interrupted gives the rows that were done, or none.
std::vector<ReproduceRow> radar_cost(const ReproduceOptions& options, const Stop& stop);
std::vector<ReproduceRow> radar_single(const ReproduceOptions& options, const Stop& stop);
std::vector<ReproduceRow> radar_series(const ReproduceOptions& options, const Stop& stop);
std::vector<ReproduceRow> radar_twelve(const ReproduceOptions& options, const Stop& stop);
std::vector<ReproduceRow> radar_experiment(const ReproduceOptions& options, const Stop& stop);
std::vector<ReproduceRow> radar_twelve_experiment(const ReproduceOptions& options,
                                                  const Stop& stop);
std::vector<ReproduceRow> radar_micromaze(const ReproduceOptions& options, const Stop& stop);

}  // namespace microswarm::reproduce

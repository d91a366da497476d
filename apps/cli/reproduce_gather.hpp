// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "microswarm/navigation/aggregation.hpp"
#include "microswarm/report/plot.hpp"
#include "reproduce.hpp"
#include "tests/scenes/vascular.hpp"

namespace microswarm::cli {

/// The figures of [gather], each in a file of its own.
void gather_fig7(const ReproduceOptions& options, const Stop& stop,
                 std::vector<ReproduceRow>& rows);
void gather_fig9(const ReproduceOptions& options, const Stop& stop,
                 std::vector<ReproduceRow>& rows);
void gather_fig10(const ReproduceOptions& options, const Stop& stop,
                  std::vector<ReproduceRow>& rows);

/// Fig 10 seen by a camera and driven by coils: a picture and a command for every step, or for
/// every frame at 45 a second.
void gather_fig10_rig(const ReproduceOptions& options, const Stop& stop,
                      std::vector<ReproduceRow>& rows);
void gather_fig10_frames(const ReproduceOptions& options, const Stop& stop,
                         std::vector<ReproduceRow>& rows);

/// A map with its tree and its published number of nodes.
AggregationParams gather_params(const scenes::Vascular& scene, Aggregation method);
AggregationMap gather_map(const scenes::Vascular& scene);
/// Robots anywhere in free space; the same ones for every method.
Robots gather_robots(const scenes::Vascular& scene, const Map& map, const RobotStepper& stepper,
                     int count, std::uint32_t trial);
/// Plots beside the page, as .svg, .pdf and .png.
void write_everywhere(const std::vector<Plot>& plots, const std::filesystem::path& stem);

constexpr int gather_most_steps = 200'000;

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "microswarm/navigation/gathering/gather.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/reproduce.hpp"
#include "microswarm/scenes/vascular.hpp"

namespace microswarm::reproduce {

/// Figures of [gather], one per file.
void gather_fig7(const ReproduceOptions& options, const Stop& stop,
                 std::vector<report::ReproduceRow>& rows);
void gather_fig9(const ReproduceOptions& options, const Stop& stop,
                 std::vector<report::ReproduceRow>& rows);
void gather_fig10(const ReproduceOptions& options, const Stop& stop,
                  std::vector<report::ReproduceRow>& rows);

/// Fig 10 with camera and coils: one picture and command per step, or per frame at 45 frames per
/// second.
void gather_fig10_rig(const ReproduceOptions& options, const Stop& stop,
                      std::vector<report::ReproduceRow>& rows);
void gather_fig10_frames(const ReproduceOptions& options, const Stop& stop,
                         std::vector<report::ReproduceRow>& rows);

/// Fig 3 to 6: pictures of the tree, its regions and DCA.
void gather_maps(const ReproduceOptions& options, const Stop& stop,
                 std::vector<report::ReproduceRow>& rows);

/// Generated maps that were not used for tuning, on which DCA should also be better than HRA.
void gather_generated(const ReproduceOptions& options, const Stop& stop,
                      std::vector<report::ReproduceRow>& rows);

/// The map of a scene with its tree, with the published number of nodes.
navigation::AggregationParams gather_params(const scenes::Vascular& scene,
                                            navigation::Aggregation method);
navigation::AggregationMap gather_map(const scenes::Vascular& scene, bool obstacle_weighted);
/// Random robots in free space where the path cost is at least `min_cost`; the same for every
/// method.
Robots gather_robots(const scenes::Vascular& scene, const navigation::AggregationMap& map,
                     const RobotStepper& stepper, int count, std::uint32_t trial, double min_cost);

/// Writes plots as .svg, .pdf and .png.
void write_everywhere(const std::vector<report::Plot>& plots, const std::filesystem::path& stem);

constexpr int gather_most_steps = 200'000;

}  // namespace microswarm::reproduce

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "microswarm/navigation/gathering/gather.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/reproduce.hpp"
#include "microswarm/scenes/vascular.hpp"

namespace microswarm::reproduce {

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

/// Fig 3 to 6: pictures of the tree, its regions and DCA.
void gather_maps(const ReproduceOptions& options, const Stop& stop,
                 std::vector<ReproduceRow>& rows);

/// Maps that nothing was tuned on: generated ones, where DCA should be better than HRA too.
void gather_generated(const ReproduceOptions& options, const Stop& stop,
                      std::vector<ReproduceRow>& rows);

/// A map with its tree and its published number of nodes.
AggregationParams gather_params(const scenes::Vascular& scene, Aggregation method);
AggregationMap gather_map(const scenes::Vascular& scene, bool obstacle_weighted);
/// Robots anywhere in free space from where the way costs at least so much; the same ones for every
/// method.
Robots gather_robots(const scenes::Vascular& scene, const AggregationMap& map,
                     const RobotStepper& stepper, int count, std::uint32_t trial, double min_cost);

/// Plots beside the page, as .svg, .pdf and .png.
void write_everywhere(const std::vector<Plot>& plots, const std::filesystem::path& stem);
/// Of a sample; 0 for fewer than two values.
double standard_deviation(const std::vector<double>& values);

constexpr int gather_most_steps = 200'000;

}  // namespace microswarm::reproduce

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/gather/gather.hpp"

#include <array>
#include <cmath>
#include <span>

#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/geometry/uniform_in.hpp"
#include "microswarm/reproduce/figures.hpp"

namespace microswarm::reproduce {

navigation::AggregationParams gather_params(const scenes::Vascular& scene,
                                            navigation::Aggregation method) {
  navigation::AggregationParams params;
  params.tree.nodes = scene.nodes;
  params.method = method;
  return params;
}

navigation::AggregationMap gather_map(const scenes::Vascular& scene, bool obstacle_weighted) {
  Rng rng(1, Purpose::planner);
  navigation::AggregationParams params =
      gather_params(scene, navigation::Aggregation::divide_and_conquer);
  params.obstacle_weighted = obstacle_weighted;
  return {scene.map(), scene.goal, params, rng};
}

Robots gather_robots(const scenes::Vascular& scene, const navigation::AggregationMap& map,
                     const RobotStepper& stepper, int count, std::uint32_t trial, double min_cost) {
  Rng rng(1, Purpose::scene, trial);
  std::vector<Vec2> positions;
  const Box& box = scene.bounds;
  while (std::ssize(positions) < count) {
    const Vec2 p = uniform_in(box, rng);
    if (map.map.is_free(p, 4 * stepper.guard()) && map.tree.cost(map.tree.weighted, p) >= min_cost)
      positions.push_back(p);
  }
  return stepper.place(positions);
}

void write_everywhere(const std::vector<report::Plot>& plots, const std::filesystem::path& stem) {
  report::write_plots_everywhere(plots, stem);
}

namespace {

template <auto add>
std::vector<report::ReproduceRow> measure_rows(const ReproduceOptions& options, const Stop& stop) {
  std::vector<report::ReproduceRow> rows;
  add(options, stop, rows);
  return rows;
}

}  // namespace

std::vector<report::ReproduceRow> gather_figures(const std::string& figure,
                                                 const ReproduceOptions& options,
                                                 const Stop& stop) {
  constexpr std::array<Figure, 7> figures{{{"fig3-6", measure_rows<gather_maps>},
                                           {"fig7", measure_rows<gather_fig7>},
                                           {"fig9", measure_rows<gather_fig9>},
                                           {"generated", measure_rows<gather_generated>},
                                           {"fig10", measure_rows<gather_fig10>},
                                           {"fig10-rig", measure_rows<gather_fig10_rig>},
                                           {"fig10-frames", measure_rows<gather_fig10_frames>}}};
  // The runs through the rig take minutes or longer: only on request.
  const std::size_t with_all = options.quick ? 5 : 6;
  const std::span<const Figure> all(figures);
  return reproduce_figures("gather", figure.empty() ? all.first(with_all) : all, figure, options,
                           stop);
}

}  // namespace microswarm::reproduce

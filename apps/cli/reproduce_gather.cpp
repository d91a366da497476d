// SPDX-License-Identifier: Apache-2.0
#include "reproduce_gather.hpp"

#include <array>

#include "reproduce_figures.hpp"

namespace microswarm::cli {

AggregationParams gather_params(const scenes::Vascular& scene, Aggregation method) {
  AggregationParams params;
  params.tree.nodes = scene.nodes;
  params.method = method;
  return params;
}

AggregationMap gather_map(const scenes::Vascular& scene) {
  Rng rng(1, Purpose::planner);
  return {scene.map(), scene.goal, gather_params(scene, Aggregation::divide_and_conquer), rng};
}

Robots gather_robots(const scenes::Vascular& scene, const Map& map, const RobotStepper& stepper,
                     int count, std::uint32_t trial) {
  Rng rng(1, Purpose::scene, trial);
  std::vector<Vec2> places;
  const Box& box = scene.bounds;
  while (std::ssize(places) < count) {
    const double x = rng.uniform(box.lo.x, box.hi.x);
    const Vec2 p{x, rng.uniform(box.lo.y, box.hi.y)};
    if (map.is_free(p, 4 * stepper.guard())) places.push_back(p);
  }
  return stepper.place(places);
}

void write_everywhere(const std::vector<Plot>& plots, const std::filesystem::path& stem) {
  for (const char* kind : {".png", ".svg", ".pdf"}) write_plots(plots, stem.string() + kind);
}

namespace {

template <auto add>
std::vector<ReproduceRow> rows_of(const ReproduceOptions& options, const Stop& stop) {
  std::vector<ReproduceRow> rows;
  add(options, stop, rows);
  return rows;
}

}  // namespace

std::vector<ReproduceRow> reproduce_gather(const std::string& figure,
                                           const ReproduceOptions& options, const Stop& stop) {
  constexpr std::array<Figure, 5> figures{{{"fig7", rows_of<gather_fig7>},
                                           {"fig9", rows_of<gather_fig9>},
                                           {"fig10", rows_of<gather_fig10>},
                                           {"fig10-rig", rows_of<gather_fig10_rig>},
                                           {"fig10-frames", rows_of<gather_fig10_frames>}}};
  return reproduce_figures("gather", figures, figure, options, stop);
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "reproduce_gather.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"

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

std::vector<ReproduceRow> reproduce_gather(const std::string& figure,
                                           const ReproduceOptions& options, const Stop& stop) {
  using Figure = void (*)(const ReproduceOptions&, const Stop&, std::vector<ReproduceRow>&);
  constexpr std::array<std::pair<std::string_view, Figure>, 3> figures{
      {{"fig7", gather_fig7}, {"fig9", gather_fig9}, {"fig10", gather_fig10}}};
  const bool known = std::any_of(figures.begin(), figures.end(),
                                 [&](const auto& entry) { return entry.first == figure; });
  if (!figure.empty() && !known)
    throw InputError(
        fmt::format("reproduce gather: unknown figure '{}', there are: fig7, fig9, fig10", figure));
  std::vector<ReproduceRow> rows;
  for (const auto& [name, reproduce] : figures)
    if (figure.empty() || figure == name) reproduce(options, stop, rows);
  if (!options.out.empty() && !stop())
    write_file_atomically(std::filesystem::path(options.out) / "gather.csv", rows_csv(rows));
  return rows;
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "reproduce_global.hpp"

#include <array>
#include <filesystem>
#include <limits>

#include "microswarm/formats/map_file.hpp"
#include "reproduce_figures.hpp"
#include "robot_picture.hpp"

namespace microswarm::cli {

void draw_plan(const ReproduceOptions& options, const std::string& name, const std::string& title,
               const Map& map, const GlobalPlan& plan, std::span<const Vec2> goals,
               double tolerance) {
  if (options.out.empty()) return;
  for (const char* kind : {".png", ".svg", ".pdf"})
    draw_robots(map, plan, goals, tolerance, title,
                std::filesystem::path(options.out) / (name + kind));
}

double least_distance(const GlobalPlan& plan) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& places : plan.configurations)
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) least = std::min(least, distance(places[i], places[j]));
  return least;
}

std::optional<scenes::GlobalTask> leaf_task(const ReproduceOptions& options) {
  const auto file = data_file(options, "paper_authors/global_leaf.csv", "fig1, veins of a leaf");
  if (!file) return std::nullopt;
  // Starts and goals of the published program.
  return scenes::GlobalTask{"veins of a leaf",
                            *load_map(guess_map_spec(*file)).map,
                            {{222, 74}, {227, 104}, {230, 89.2}},
                            {{113.6, 225}, {236.3, 271}, {186.5, 269.8}},
                            5,
                            20};
}

std::vector<ReproduceRow> reproduce_global(const std::string& figure,
                                           const ReproduceOptions& options, const Stop& stop) {
  constexpr std::array<Figure, 9> figures{{{"fig1", global_vascular},
                                           {"fig3-5", global_step_lengths},
                                           {"fig6", global_cell_sizes},
                                           {"fig7", global_initial_distances},
                                           {"fig8", global_digestive},
                                           {"fig9-10", global_reuse},
                                           {"fig12", global_magnets},
                                           {"beyond", global_beyond},
                                           {"beyond-6", global_six}}};
  return reproduce_figures("global", figures, figure, options, stop);
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/global/global.hpp"

#include <array>
#include <filesystem>
#include <limits>

#include "microswarm/report/robot_picture.hpp"
#include "microswarm/reproduce/figures.hpp"

namespace microswarm::reproduce {

void draw_plan(const ReproduceOptions& options, const std::string& name, const std::string& title,
               const Map& map, const planning::GlobalPlan& plan, std::span<const Vec2> goals,
               double tolerance) {
  if (options.out.empty()) return;
  for (const char* kind : {".png", ".svg", ".pdf"})
    report::draw_robots(map, plan, goals, tolerance, title,
                        std::filesystem::path(options.out) / (name + kind));
}

double min_distance(const planning::GlobalPlan& plan) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& positions : plan.configurations)
    for (std::size_t i = 0; i < positions.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        least = std::min(least, distance(positions[i], positions[j]));
  return least;
}

std::vector<report::ReproduceRow> global_figures(const std::string& figure,
                                                 const ReproduceOptions& options,
                                                 const Stop& stop) {
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

}  // namespace microswarm::reproduce

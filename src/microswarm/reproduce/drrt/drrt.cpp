// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/drrt/drrt.hpp"

#include <filesystem>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/reproduce/figures.hpp"
#ifdef MICROSWARM_HAS_LEARNING
#include "microswarm/reproduce/drrt/follower_rows.hpp"
#endif

namespace microswarm::reproduce {

DrrtSetting load_drrt(const ReproduceOptions& options, const char* name) {
  const std::filesystem::path file = options.scenarios / "papers" / "drrt" / name;
  experiment::Scene scene =
      experiment::load_scene(experiment::read_scenario(file), file.parent_path());
  World world = experiment::build_world(scene);
  return {std::move(scene), std::move(world)};
}

double shortest_path_length(const DrrtSetting& setting) {
  const experiment::Scenario& scenario = setting.scene.scenario;
  const planning::ShortestPath path =
      planning::ShortestPaths(*setting.world.map, 0).find(scenario.start->position, *scenario.goal);
  return path.length - scenario.goal_tolerance;
}

std::optional<double> over_the_shortest(const std::vector<double>& lengths, double shortest) {
  if (lengths.empty()) return std::nullopt;
  return 100 * (quantile(lengths, 0.5) / shortest - 1);
}

void vary_phases(experiment::Scenario& scenario, std::uint32_t trial) {
  Rng rng(scenario.seed, Purpose::scene, trial);
  for (Obstacle& o : scenario.obstacles) {
    const double phase = rng.uniform();
    std::visit(Overloaded{[&](OneOf<HarmonicLine, HarmonicArc> auto& m) { m.phase = phase; },
                          [](OneOf<Still, Straight, Waypoints, Track> auto&) {}},
               o.motion);
  }
}

namespace {

#ifdef MICROSWARM_HAS_LEARNING
// The learned controller, for which the paper gives no values.
std::vector<report::ReproduceRow> follower(const ReproduceOptions& options, const Stop& stop) {
  const learning::ComparisonOptions comparison{.tasks = options.quick ? 60 : 200};
  const auto outcomes = compare_with_progress(comparison, options.progress, stop);
  if (stop()) return {};
  if (!options.out.empty()) write_follower_figures(outcomes, comparison, options.out);
  return follower_rows(outcomes);
}
#endif

}  // namespace

std::vector<report::ReproduceRow> drrt_figures(const std::string& figure,
                                               const ReproduceOptions& options, const Stop& stop) {
  static constexpr Figure figures[] = {
      {"fig3", drrt_fig3},    {"fig5a", drrt_fig5a},
      {"fig5b", drrt_fig5b},  {"comparison", drrt_comparison},
#ifdef MICROSWARM_HAS_LEARNING
      {"follower", follower},
#endif
  };
  return reproduce_figures("drrt", figures, figure, options, stop);
}

}  // namespace microswarm::reproduce

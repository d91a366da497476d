// SPDX-License-Identifier: Apache-2.0
#include "microswarm/planning/trees/fmt_star.hpp"

#include <chrono>
#include <stdexcept>

#include "bench/ompl_peer.hpp"
#include "bench/planning.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/planning/exact/exact.hpp"

namespace microswarm::bench {

std::vector<report::BenchRow> fmt_star(const std::filesystem::path& scenarios, bool quick,
                                       const Stop& stop) {
  const auto file = scenarios / "papers" / "drrt" / "s_channel.yaml";
  const experiment::Scene scene =
      experiment::load_scene(experiment::read_scenario(file), file.parent_path());
  const Snapshot world = experiment::build_world(scene).at(0);
  const experiment::Scenario& s = scene.scenario;
  const planning::FmtStarParams ours;
  std::vector<double> ms, lengths, their_ms, their_lengths;
  double free_share = 0;
  for (int seed = 0; seed < (quick ? 100 : 1000) && !stop(); ++seed) {
    Rng rng(1, Purpose::planner, static_cast<std::uint32_t>(seed));
    const auto began = std::chrono::steady_clock::now();
    const Plan made = planning::plan(world, *s.start, *s.goal, ours, rng);
    ms.push_back(1e3 *
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
    if (made.status != Status::solved) throw std::runtime_error("bench: a query was not solved");
    lengths.push_back(path_length(made.path));
    free_share = static_cast<double>(ours.samples) / static_cast<double>(made.counts.samples);
  }
  const Box sampled = world.bounds().grown(-ours.clearance);
  for (int run = 0; run < (quick ? 20 : 100) && !stop(); ++run) {
    const OmplResult made = run_ompl(
        OmplPlanner::fmt_star, {.world = world,
                                .start = s.start->position,
                                .goal = *s.goal,
                                .clearance = ours.clearance,
                                .goal_tolerance = ours.goal_tolerance,
                                .samples = static_cast<unsigned>(ours.samples),
                                .radius_factor = ours.radius_factor,
                                .free_area = free_share * sampled.width() * sampled.height()});
    their_ms.push_back(1e3 * made.seconds);
    if (made.solved) their_lengths.push_back(made.length);
  }
  std::vector<report::BenchRow> rows;
  const auto row = [&](const char* quantity, const char* unit, double mine, double theirs,
                       std::optional<double> aim) {
    rows.push_back({.name = "FMT*, S-channel, first path",
                    .quantity = quantity,
                    .unit = unit,
                    .ours = mine,
                    .peer = theirs,
                    .peer_name = std::string(to_text(OmplPlanner::fmt_star)),
                    .aim = aim});
  };
  row("time, median", "ms", median(ms), median(their_ms), 2.0);
  row("time, p99", "ms", quantile(ms, 0.99), quantile(their_ms, 0.99), std::nullopt);
  row("length, median", "µm", median(lengths), median(their_lengths), std::nullopt);
  Rng rng(1, Purpose::planner);
  const planning::ExactParams exact{.clearance = ours.clearance,
                                    .goal_tolerance = ours.goal_tolerance};
  const double shortest = path_length(planning::plan(world, *s.start, *s.goal, exact, rng));
  rows.push_back({.name = "FMT*, S-channel, first path",
                  .quantity = "length beside the shortest to the goal, median",
                  .unit = "",
                  .ours = median(lengths) / shortest});
  return rows;
}

}  // namespace microswarm::bench

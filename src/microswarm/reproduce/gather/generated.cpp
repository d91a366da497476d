// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/reproduce/gather/gather.hpp"

namespace microswarm::reproduce {
namespace {

// The paper's claim on maps not used for tuning: DCA is better than HRA.

constexpr std::uint64_t first_seed = 101;
constexpr int robots_on_generated = 64;
constexpr std::size_t enough_regions = 5;  // see too_few_regions

struct GeneratedSize {
  const char* name;
  scenes::VascularShape shape;
  std::size_t maps;
};

std::array<GeneratedSize, 2> generated_sizes(bool quick) {
  scenes::VascularShape small{.width = 100, .height = 100, .spacing = 24};
  small.min_half = 4.5;
  small.missing = 0.1;
  scenes::VascularShape medium{.width = 220, .height = 180, .spacing = 34};
  medium.min_half = 4.5;
  medium.max_half = 6;
  medium.missing = 0.1;
  return {{{"100 × 100", small, quick ? 6u : 40u}, {"220 × 180", medium, quick ? 2u : 20u}}};
}

struct OnGenerated {
  std::size_t regions = 0;
  double dca = 0;
  double hra = 0;
};

/// A map as in generated.csv.
struct GeneratedRow {
  std::string size;
  std::uint64_t seed = 0;
  std::uint64_t regions = 0;
  double dca_steps = 0;
  double hra_steps = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.size, plain("size", "Size in pixels."));
    visit(self.seed, plain("seed", "Seed of the map."));
    visit(self.regions, plain("regions", "Number of regions."));
    visit(self.dca_steps, plain("dca_steps", "Mean steps of DCA."));
    visit(self.hra_steps, plain("hra_steps", "Mean steps of HRA."));
  }
};

OnGenerated gather_on_generated(const scenes::Vascular& scene, std::uint32_t trials,
                                const Stop& stop) {
  const navigation::AggregationMap map = gather_map(scene, true);
  const RobotStepper stepper(map.map, 1);
  OnGenerated out{.regions = map.segmentation.regions.size()};
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    for (const navigation::Aggregation method :
         {navigation::Aggregation::divide_and_conquer, navigation::Aggregation::heuristic}) {
      Robots robots = gather_robots(scene, map, stepper, robots_on_generated, trial, 0);
      navigation::AggregationPolicy policy(map, gather_params(scene, method));
      const int steps = navigation::gather(stepper, policy, robots, gather_most_steps, stop).steps;
      (method == navigation::Aggregation::heuristic ? out.hra : out.dca) += steps;
    }
  }
  return out;
}

}  // namespace

void gather_generated(const ReproduceOptions& options, const Stop& stop,
                      std::vector<report::ReproduceRow>& rows) {
  std::vector<GeneratedRow> table;
  const std::uint32_t trials = options.quick ? 2 : 4;
  for (const GeneratedSize& size : generated_sizes(options.quick)) {
    std::vector<OnGenerated> all(size.maps);
    for_each_index(all.size(), 0, [&](std::size_t i) {
      if (stop()) return;
      Rng rng(first_seed + i, Purpose::scene);
      all[i] = gather_on_generated(scenes::random_vascular(size.shape, rng), trials, stop);
    });
    if (stop()) return;
    for (std::size_t i = 0; i < all.size(); ++i)
      table.push_back({.size = size.name,
                       .seed = first_seed + i,
                       .regions = all[i].regions,
                       .dca_steps = all[i].dca / trials,
                       .hra_steps = all[i].hra / trials});
    for (const bool many : {true, false}) {
      double count = 0;
      double best = 0;
      double logs = 0;
      for (const OnGenerated& map : all) {
        if ((map.regions >= enough_regions) != many) continue;
        ++count;
        best += map.dca < map.hra;
        logs += maths::log(map.dca / std::max(1.0, map.hra));
      }
      if (count == 0) continue;
      const std::string what =
          fmt::format("{} generated maps of {}, {} {} regions, n = {}", count, size.name,
                      many ? "at least" : "fewer than", enough_regions, robots_on_generated);
      rows.push_back(row_without_aim(many ? "the paper: DCA is the best" : "too few to divide",
                                     "generated", what + ": DCA needs fewer steps than HRA", "%",
                                     {}, 100 * best / count));
      report::ReproduceRow ratio =
          make_row("generated", what + ": DCA's steps ÷ HRA's, geometric mean", "1", {},
                   maths::exp(logs / count), many ? std::optional(1.0) : std::nullopt);
      rows.push_back(
          noted(std::move(ratio), many ? "the paper: DCA is the best" : "too few to divide"));
    }
  }
  if (!options.out.empty())
    write_file_atomically(std::filesystem::path(options.out) / "generated.csv",
                          io::csv_table(table));
}

}  // namespace microswarm::reproduce

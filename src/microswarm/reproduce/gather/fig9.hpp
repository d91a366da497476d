// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "microswarm/navigation/gathering/policies/aggregation_params.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/scenes/vascular.hpp"

// Fig 9 [gather]: maps, methods and published means.
namespace microswarm::reproduce {

inline constexpr std::size_t populations = 10;
/// Number of robots of the k-th population: 2, 4 … 1024.
constexpr int population(std::size_t k) { return 2 << k; }
inline constexpr std::size_t of_8 = 2;  // from here on DCA+OWRRT is best in the paper
inline constexpr std::size_t of_64 = 5;
inline constexpr std::size_t of_1024 = 9;

/// A method in the comparison.
struct GatherMethod {
  const char* name;
  navigation::Aggregation aggregation{};
  bool weighted;
  std::size_t colour;
};
inline constexpr std::array<GatherMethod, 5> gather_methods{
    {{"DCA+OWRRT", navigation::Aggregation::divide_and_conquer, true,
      report::method_colours::divide_and_conquer},
     {"HRA+OWRRT", navigation::Aggregation::heuristic, true, report::method_colours::heuristic},
     {"HRA+RRT", navigation::Aggregation::heuristic, false,
      report::method_colours::heuristic_plain_tree},
     {"rollout", navigation::Aggregation::rollout, true, report::method_colours::rollout},
     {"DCA+OWRRT, ours", navigation::Aggregation::divide_and_conquer, true, 4}}};
inline constexpr std::size_t published_methods = 3;
inline constexpr std::size_t of_dca = 0;
inline constexpr std::size_t of_hra = 1;
inline constexpr std::size_t of_plain = 2;
inline constexpr std::size_t of_rollout = 3;
inline constexpr std::size_t of_ours = 4;
inline constexpr std::size_t of_anywhere = 1;

/// Published mean steps for n = 2, 4 … 1024.
using Means = std::array<std::optional<double>, populations>;

/// A map with the published means on it.
struct Ground {
  const char* name;
  scenes::Vascular scene{};
  double min_length;  ///< minimum path length of the robots' start positions [µm]
  std::array<Means, published_methods> published;
  int followed_regions;  ///< parameter of DCA in the published program
  int last_regions;
  double work;  ///< budget of the rollout planner for n = 1024, in robot-steps
};

/// In the T-junction the authors' robots start in its arms: at tree nodes with a cost above 40.
inline std::vector<Ground> grounds() {
  const std::array<Means, published_methods> of_t{
      {{112, 160, 221, 260, 276, 287, 287, 292, 294, 290},
       {152, 244, 352, 446, 516, 597, 620, 663, 675, 674},
       {123, 219, 354, 465, 654, 779, 850, 1032, 1168, 1342}}};
  const std::array<Means, published_methods> of_b{
      {{192, 299, 447, 581, 686, 767, 801, 854, 892, 910},
       {217, 410, 630, 811, 984, 1243, 1381, 1531, 1591, 1659},
       {198, 404, 665, 1089, 1400, 1977, 2511, 2919, 3560, 3709}}};
  const std::array<Means, published_methods> of_c{
      {{598, 1128, 1730, 2531, 3438, 4188, 4843, 5253, 5442, 5861},
       {627, 1256, 2150, 3322, 4813, 6204, 7533, 8853, 10257, 11598},
       {522, 1104, 2117, 3665, 6181, 9134, 11607, 15633, std::nullopt, std::nullopt}}};
  return {{"(a) T-junction", scenes::t_junction(), 40, of_t, 0, 1, 40e6},
          {"(a) robots anywhere", scenes::t_junction(), 0, of_t, 0, 1, 40e6},
          {"(b) vascular network", scenes::vascular_network(), 0, of_b, 0, 1, 20e6},
          {"(c) larger network", scenes::larger_vascular_network(), 0, of_c, 3, 3, 40e6}};
}

}  // namespace microswarm::reproduce

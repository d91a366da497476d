// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/world/obstacles/motion.hpp"

namespace microswarm::scenes {

/// Levels of DynaBARN: obstacles of up to 0.95, 1.45 and 1.95 m/s.
enum class DynabarnLevel { easy, medium, hard };
constexpr auto enum_names(DynabarnLevel) {
  return std::array<std::pair<DynabarnLevel, std::string_view>, 3>{
      {{DynabarnLevel::easy, "easy"},
       {DynabarnLevel::medium, "medium"},
       {DynabarnLevel::hard, "hard"}}};
}

/// A world of DynaBARN (Nair et al., "DynaBARN: Benchmarking Metric Ground Navigation in Dynamic
/// Environments", SSRR 2022): discs on tracks; at the end of one the disc disappears and
/// appears at the begin.
struct DynabarnWorld {
  DynabarnLevel level{};
  std::vector<Samples> tracks{};  ///< a lap each [s, µm], 100 µm for a metre
};

/// Reads `worlds.csv` (world, plugin) and `tracks.csv` (plugin, t_s, x_m, y_m) of a folder. Throws
/// InputError "FILE:LINE: WHY".
std::vector<DynabarnWorld> read_dynabarn(const std::filesystem::path& folder);

/// The benchmark's task in a world: a disc of radius 30 µm (0.3 m) crosses it in at most 100 s.
experiment::Scenario dynabarn_scenario(const DynabarnWorld& world, double speed);

}  // namespace microswarm::scenes

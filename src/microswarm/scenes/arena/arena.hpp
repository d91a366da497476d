// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/experiment/scenario/scenario.hpp"

namespace microswarm::scenes {

/// Groups of the arena's scenes.
enum class ArenaGroup { still, corridors, doors, movers, fast, crowds, sight, surprises };
constexpr auto enum_names(ArenaGroup) {
  return std::array<std::pair<ArenaGroup, std::string_view>, 8>{
      {{ArenaGroup::still, "still"},
       {ArenaGroup::corridors, "corridors"},
       {ArenaGroup::doors, "doors"},
       {ArenaGroup::movers, "movers"},
       {ArenaGroup::fast, "fast"},
       {ArenaGroup::crowds, "crowds"},
       {ArenaGroup::sight, "sight"},
       {ArenaGroup::surprises, "surprises"}}};
}

/// A kind of scene in the arena.
struct ArenaKind {
  std::string_view name{};
  ArenaGroup group{};
  std::string_view description{};
  double clearance = 52;  ///< of a path from start to goal [µm], for navigators that need one
};

/// All kinds, by group. One swarm, a vortex of radius 40 µm with 80 µm/s, crosses 2 × 1.2 mm.
const std::vector<ArenaKind>& arena_kinds();

/// The scene of a kind; its navigator is the default one. Pure function of its arguments.
/// Precondition: kind < arena_kinds().size().
experiment::Scenario arena_scenario(std::size_t kind, std::uint64_t seed);

}  // namespace microswarm::scenes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm::scenes {

/// Robots under one input, with their goals on a map.
struct GlobalTask {
  std::string name{};
  Map map{};
  std::vector<Vec2> starts{};
  std::vector<Vec2> goals{};
  double robostep = 5;
  double tolerance = 20;
};

/// Six robots in Env 1–4: the four of [global], and two more in line with them.
GlobalTask six_robots(int env);
/// Other goals for them in Env 1, spread over the map at least 50 µm apart: the positions reached
/// by six random inputs, each held for 5 to 44 steps.
std::vector<Vec2> six_goals_apart();

/// Three robots among the veins of a leaf, with starts and goals of the program published with
/// [global]. As there, goal 3 is 0.5 µm inside a wall. The map belongs to that program and is not
/// in the repository.
GlobalTask leaf_task(Map map);

/// Substitutes for the maps of Fig 8 and 12 [global], which are published only as pictures, and a
/// vascular network. Three robots in a vascular network, three in a digestive system (planar: the
/// duodenum runs around the colon, not in front of it), and two magnets between axis-aligned
/// obstacles.
GlobalTask vascular_task();
GlobalTask digestive_task();
GlobalTask magnets_task();

}  // namespace microswarm::scenes

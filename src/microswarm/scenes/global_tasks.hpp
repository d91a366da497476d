// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "microswarm/world/map/map.hpp"

namespace microswarm::scenes {

/// Robots under one input with their goals on a map.
struct GlobalTask {
  std::string name;
  Map map;
  std::vector<Vec2> starts;
  std::vector<Vec2> goals;
  double robostep = 5;
  double tolerance = 20;
};

/// Six robots in Env 1–4: the four of [global], and two more in a row with them.
GlobalTask six_robots(int env);
/// Other goals for them in Env 1, each at least 50 µm from the others and all over the map: where
/// six inputs drawn at random, each held for 5 to 44 steps, bring them.
std::vector<Vec2> six_goals_apart();

/// Three robots among the veins of a leaf, with the starts and goals of the program that was
/// published with [global]; goal 3 lies 0.5 µm in a wall, as it does there. The map is that
/// program's and no part of the repository.
GlobalTask leaf_task(Map map);

/// The maps of Fig 8 and 12 [global] are published as pictures only; these and a vascular network
/// are maps of ours of the same kind: three robots in a vascular network, three in a digestive
/// system (planar: the duodenum goes around the colon, where a body's lies behind it), and two
/// magnets between obstacles whose sides are all along the axes.
GlobalTask vascular_task();
GlobalTask digestive_task();
GlobalTask magnets_task();

}  // namespace microswarm::scenes

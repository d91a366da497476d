// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/global_tasks.hpp"

#include <utility>

#include "microswarm/scenes/global_worlds.hpp"
#include "microswarm/scenes/vascular.hpp"
#include "microswarm/scenes/worlds.hpp"

namespace microswarm::scenes {
namespace {

/// Adds a tube through these joints.
void add_tube(ChannelGraph& graph, std::initializer_list<Disc> joints) {
  auto next = static_cast<std::uint32_t>(graph.joints.size());
  for (const Disc& joint : joints) {
    graph.joints.push_back(joint);
    if (graph.joints.size() > next + 1)
      graph.channels.emplace_back(static_cast<std::uint32_t>(graph.joints.size()) - 2,
                                  static_cast<std::uint32_t>(graph.joints.size()) - 1);
  }
}

Map digestive_map() {
  ChannelGraph graph;
  graph.bounds = {{0, 0}, {400, 500}};
  constexpr double gut = 9;
  constexpr double colon = 17;
  add_tube(graph, {{{200, 485}, 12},                        // oesophagus
                   {{200, 420}, 12},                        //
                   {{185, 385}, 30},                        // stomach
                   {{150, 350}, 40},                        //
                   {{165, 318}, 26},                        //
                   {{115, 292}, gut},                       // duodenum
                   {{45, 282}, gut},                        //
                   {{40, 60}, gut},                         //
                   {{60, 32}, gut},                         //
                   {{130, 32}, gut},                        //
                   {{155, 85}, gut},                        // small intestine
                   {{290, 85}, gut},                        //
                   {{300, 97}, gut},                        //
                   {{290, 109}, gut},                       //
                   {{165, 115}, gut},                       //
                   {{155, 127}, gut},                       //
                   {{165, 139}, gut},                       //
                   {{290, 145}, gut},                       //
                   {{300, 157}, gut},                       //
                   {{290, 169}, gut},                       //
                   {{165, 175}, gut},                       //
                   {{155, 187}, gut},                       //
                   {{165, 199}, gut},                       //
                   {{290, 205}, gut}});                     //
  add_tube(graph, {{{155, 127}, gut}, {{110, 120}, gut}});  // valve
  add_tube(graph, {{{110, 95}, colon},
                   {{110, 245}, colon},
                   {{345, 250}, colon},
                   {{345, 95}, colon},
                   {{300, 45}, colon},
                   {{240, 45}, 14},
                   {{215, 14}, 12}});
  return {graph.bounds, graph_walls(graph)};
}

}  // namespace

GlobalTask six_robots(int env) {
  GlobalTask task{"six robots", global_world(env), {}, {}};
  task.starts.assign(global_starts.begin(), global_starts.end());
  task.goals.assign(global_goals.begin(), global_goals.end());
  for (const Vec2 p : {Vec2{60, 100}, Vec2{60, 75}}) task.starts.push_back(p);
  for (const Vec2 p : {Vec2{330, 100}, Vec2{330, 75}}) task.goals.push_back(p);
  return task;
}

std::vector<Vec2> six_goals_apart() {
  return {{213, 175}, {111, 155}, {111, 105}, {128, 55}, {253, 97}, {311, 50}};
}

GlobalTask leaf_task(Map map) {
  return {"veins of a leaf",
          std::move(map),
          {{222, 74}, {227, 104}, {230, 89.2}},
          {{113.6, 225}, {236.3, 271}, {186.5, 269.8}}};
}

GlobalTask vascular_task() {
  return {"vascular network",
          generated_vascular_network().map(),
          {{26, 77}, {24, 97}, {23, 117}},
          {{114, 71}, {201, 105}, {148, 156}},
          4,
          6};
}

GlobalTask digestive_task() {
  return {"digestive system",
          digestive_map(),
          {{200, 480}, {200, 450}, {190, 395}},
          {{150, 350}, {40, 150}, {230, 85}},
          6,
          8};
}

GlobalTask magnets_task() {
  std::vector<Polygon> walls;
  for (const Box& box : std::initializer_list<Box>{{{70, 0}, {90, 120}},
                                                   {{70, 180}, {90, 240}},
                                                   {{150, 90}, {230, 110}},
                                                   {{150, 170}, {170, 300}},
                                                   {{230, 190}, {300, 210}}})
    walls.push_back(rectangle(box));
  return {"two magnets",
          {{{0, 0}, {300, 300}}, walls},
          {{30, 250}, {30, 60}},
          {{265, 255}, {200, 60}},
          5,
          25};
}

}  // namespace microswarm::scenes

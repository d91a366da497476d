// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/arena/arena.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <variant>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/scenario/validate.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/formats/map_file.hpp"
#include "microswarm/planning/exact/shortest_paths.hpp"
#include "microswarm/world/map/map.hpp"
#include "microswarm/world/world.hpp"

namespace microswarm::experiment {
namespace {

double radius_in(const Scenario& s) { return swarm_limits(s.swarm).radius; }

template <class Check>
void for_each_scene(Check&& check_one) {
  for (std::size_t kind = 0; kind < scenes::arena_kinds().size(); ++kind)
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Scenario s = scenes::arena_scenario(kind, seed);
      SCOPED_TRACE(s.name);
      check_one(scenes::arena_kinds()[kind], s, build_world({s, formats::read_map_parts(s.map)}));
    }
}

TEST(Arena, HasSixtyFourKindsWithNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const scenes::ArenaKind& kind : scenes::arena_kinds()) names.insert(kind.name);
  EXPECT_EQ(names.size(), scenes::arena_kinds().size());
  EXPECT_GE(names.size(), 64u);
}

TEST(Arena, ScenesAreTakenWithTheirClearance) {
  for_each_scene([](const scenes::ArenaKind& kind, Scenario s, const World& world) {
    for (const Obstacle& obstacle : s.obstacles) EXPECT_TRUE(validate(obstacle).empty());
    navigation::HierarchicalParams navigator;
    navigator.clearance = kind.clearance;
    s.navigator = navigator;
    const Issues issues = validate(s, world);
    EXPECT_TRUE(issues.empty()) << InputError(issues).what();
  });
}

TEST(Arena, NothingIsAtTheStart) {
  for_each_scene([](const scenes::ArenaKind&, const Scenario& s, const World& world) {
    EXPECT_TRUE(world.at(0).moving().is_free(s.start->position, radius_in(s) + 1));
  });
}

/// The walls of a still scene with the bodies that rest in it.
Map map_with_bodies(const Scenario& s, const World& world) {
  formats::MapParts parts = formats::read_map_parts(s.map);
  const Snapshot at_start = world.at(0);
  for (const Body& body : at_start.moving().bodies())
    if (const auto* disc = std::get_if<Disc>(&body.shape))
      parts.discs.push_back(*disc);
    else
      parts.walls.push_back(std::get<Polygon>(body.shape));
  return Map(parts.bounds, parts.walls, parts.discs);
}

/// Where nothing moves there is a way, also past bodies that rest.
TEST(Arena, StillScenesHaveAWay) {
  for_each_scene([](const scenes::ArenaKind& kind, const Scenario& s, const World& world) {
    if (kind.group != scenes::ArenaGroup::still) return;
    const Map map = map_with_bodies(s, world);
    planning::ShortestPaths paths(map, radius_in(s));
    EXPECT_EQ(paths.find(s.start->position, *s.goal).status, Status::solved);
  });
}

Status crossing(std::string_view name, std::uint64_t seed,
                const navigation::NavigatorParams& navigator) {
  const auto& kinds = scenes::arena_kinds();
  const auto kind = std::ranges::find(kinds, name, &scenes::ArenaKind::name);
  Scenario s = scenes::arena_scenario(static_cast<std::size_t>(kind - kinds.begin()), seed);
  s.navigator = navigator;
  return simulate(s, build_world({s, formats::read_map_parts(s.map)})).status;
}

// Among walls that close in the swarm leaves in time, though it would rather wait for its way.
TEST(Arena, NoWaitWhereAChannelClosesIn) {
  for (std::uint64_t seed = 300; seed < 310; ++seed)
    EXPECT_EQ(crossing("channel_narrow", seed, navigation::SafeIntervalParams{}), Status::solved)
        << seed;
}

// A corner is cut only where no body that rests is in the way.
TEST(Arena, NoCornerIsCutInAForestOfDiscs) {
  for (std::uint64_t seed = 100; seed < 116; ++seed)
    EXPECT_EQ(crossing("forest_of_discs", seed, navigation::SafeIntervalParams{}), Status::solved)
        << seed;
}

// Discs that rest or swing stand in the way among walls: the hierarchy comes no nearer.
TEST(Arena, TheHierarchyIsLedRoundWhatItCannotPass) {
  navigation::HierarchicalParams led, alone;
  led.speed = alone.speed = 80;
  led.clearance = alone.clearance = 46;
  alone.tuning.patience = 1e9;
  for (const std::string_view kind : {"gap_among_discs", "lane_oscillator"}) {
    EXPECT_EQ(crossing(kind, 301, led), Status::solved) << kind;
    EXPECT_NE(crossing(kind, 301, alone), Status::solved) << kind;
  }
  // It leads on while discs that breathe are near.
  for (std::uint64_t seed = 100; seed < 104; ++seed)
    EXPECT_EQ(crossing("breathing_field", seed, led), Status::solved) << seed;
}

/// A scenario with the samples of its tracks.
std::string whole_text(const Scenario& s) {
  std::string text = scenario_text(s);
  for (const Obstacle& obstacle : s.obstacles)
    if (const Track* track = find_track(obstacle.motion))
      text +=
          std::to_string(track->samples->times[0]) + std::to_string(track->samples->points[0].x);
  return text;
}

TEST(Arena, SeedsDiffer) {
  for (std::size_t kind = 0; kind < scenes::arena_kinds().size(); ++kind) {
    Scenario a = scenes::arena_scenario(kind, 1), b = scenes::arena_scenario(kind, 2);
    EXPECT_EQ(whole_text(a), whole_text(scenes::arena_scenario(kind, 1)));
    b.name = a.name;
    b.seed = a.seed;
    EXPECT_NE(whole_text(a), whole_text(b)) << a.name;
  }
}

}  // namespace
}  // namespace microswarm::experiment

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "microswarm/contracts/command.hpp"
#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/navigator_state.hpp"
#include "microswarm/contracts/plan.hpp"
#include "microswarm/core/status.hpp"
#include "microswarm/experiment/run/tick.hpp"
#include "microswarm/navigation/radar/radar_scan.hpp"
#include "microswarm/planning/common/detection.hpp"
#include "microswarm/planning/gathering/map_segmentation.hpp"
#include "microswarm/world/obstacles/body.hpp"

namespace microswarm {

/// An experiment at a moment, as plain values: what a front end draws.
struct SessionView {
  Frame frame;                        ///< pose, radius, command, distances, state
  std::uint64_t number = 0;           ///< of the frame, from 0
  std::optional<Status> end;          ///< of the last frame
  std::vector<Body> bodies;           ///< the obstacles at the frame's time
  std::vector<Vec2> robots;           ///< positions [µm] of individually tracked robots
  std::vector<Vec2> path;             ///< that the navigator follows
  std::optional<Vec2> target;         ///< that it heads for
  std::uint64_t plans = 0;            ///< planning events so far: another number, another tree
  std::vector<TreeNode> tree;         ///< of the newest plan
  std::vector<Detection> detections;  ///< its detection circles [drrt]
  std::vector<RunEvent> events;       ///< of the tick
  std::optional<RadarScan> radar;     ///< the decision of a hierarchical radar
};

/// What robots are gathered by, as plain values; the same from the first tick on.
struct AggregationView {
  std::vector<Vec2> nodes;          ///< of the tree [µm]
  std::vector<std::uint32_t> next;  ///< node that leads from each to the goal
  MapSegmentation segmentation;     ///< regions and branches of the nodes
};

/// The view of a tick of this navigator, which is null for a record's.
SessionView view_of(const Tick& tick, std::uint64_t number, std::uint64_t plans,
                    const Navigator* navigator);

/// Nothing for other navigators, and before the first tick.
std::optional<AggregationView> aggregation_of(const Navigator& navigator);

}  // namespace microswarm

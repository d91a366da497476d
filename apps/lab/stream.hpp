// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lab/message.hpp"
#include "lab/request.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/session/session.hpp"

namespace microswarm::lab {

/// A tick's numbers for plots, kept of every tick.
struct Row {
  double t = 0;              ///< [s]
  Vec2 position;             ///< of the swarm, or the robots' mean [µm]
  double clearance = 0;      ///< to walls and obstacles [µm]
  double cost = 0;           ///< δ
  double goal_distance = 0;  ///< [µm]
  double step_time = 0;      ///< of the navigator [s]
  double speed = 0;          ///< commanded [µm/s]
  NavigatorState state = NavigatorState::hold;
  bool planned = false;
};
Row row_of(const Tick& tick);

/// How a session stands.
struct Standing {
  bool plays = false;
  double speed = 1;         ///< simulated seconds per second; 0: as fast as possible
  bool looks_back = false;  ///< at an earlier frame
  std::uint64_t frame = 0;  ///< number of the shown frame
  std::uint64_t frames = 0;
  bool ended = false;
  bool growing = false;  ///< a record that its run still writes
  OperatingMode mode = OperatingMode::autonomous;
  std::vector<std::string> changes;  ///< since the start, KEY=VALUE; the last of each key
  std::string trouble;               ///< why it could not go on; empty otherwise
};

/// What a session was opened from.
/// A photograph beneath the map, its lower left corner at the origin.
struct BackgroundPhoto {
  std::filesystem::path file;
  double um_per_px = 1;
};

struct Source {
  std::string file;
  std::string rig;  ///< empty: none
  std::vector<std::string> settings{};
  std::vector<std::string> rig_settings{};
  bool live = false;  ///< on the rig in real time; else the rig is simulated
  std::optional<BackgroundPhoto> photo{};
};
/// The command line that repeats it, for a shell.
std::string command_of(const Source& source, bool is_record);

/// What a page needs once: scenario, map, what can be changed while it runs.
MessagePtr hello_message(const Session& session, const Source& source);
nlohmann::json hello_json(const Session& session, const Source& source);
/// The scenario after a change.
MessagePtr scenario_message(const Scenario& scenario);
MessagePtr frame_message(const SessionView& view);
MessagePtr plan_message(const SessionView& view);
MessagePtr aggregation_message(const AggregationView& view);
/// Clearance of the map at the centres of square cells, row by row from below.
MessagePtr clearance_message(const Map& map);
MessagePtr rows_message(std::span<const Row> rows, std::span<const RunEvent> events, bool anew);
MessagePtr standing_message(const Standing& standing, const RunResult& result);
/// The answer to a request; the issues say why it was not done.
MessagePtr answer_message(std::uint64_t id, const Issues& issues);

}  // namespace microswarm::lab

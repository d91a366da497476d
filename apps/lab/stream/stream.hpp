// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lab/stream/message.hpp"
#include "lab/stream/request.hpp"
#include "microswarm/core/errors/issue.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace microswarm::lab {

/// Numbers of a tick for plots, kept for every tick.
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
Row to_row(const experiment::Tick& tick);

/// Standing of a session, for its pages.
struct Standing {
  bool plays = false;
  double speed = 1;         ///< simulated seconds per second; 0: as fast as possible
  bool looks_back = false;  ///< whether an earlier frame is shown
  std::uint64_t frame = 0;  ///< number of the shown frame
  std::uint64_t frames = 0;
  bool ended = false;
  bool growing = false;  ///< whether it is a record that a run still writes
  experiment::OperatingMode mode = experiment::OperatingMode::autonomous;
  bool steered = false;              ///< whether it was held or steered by hand since the start
  std::vector<std::string> changes;  ///< since the start, KEY=VALUE, one for each key
  /// Metrics at the shown frame, while an earlier one is shown.
  std::optional<experiment::Metrics> past_metrics;
  std::uint64_t decisions_every = 1;  ///< diagnostics are kept of every such frame
  std::string trouble;                ///< why it could not continue; empty otherwise
};

/// A photograph as background of the map, lower left corner at the origin.
struct BackgroundPhoto {
  std::filesystem::path file;
  double um_per_px = 1;
};

/// Source of a session, as the command line names it.
struct Source {
  std::string file;
  std::string rig;  ///< empty for none
  std::vector<std::string> settings{};
  std::vector<std::string> rig_settings{};
  bool live = false;  ///< whether the rig runs in real time; otherwise it is simulated
  std::optional<BackgroundPhoto> photo{};
};
/// Shell command that repeats the session.
std::string command_line(const Source& source, bool is_record);

/// Hello of a session: scenario, map, keys that can be changed during the run.
MessagePtr hello_message(const experiment::Session& session, const Source& source);
nlohmann::json hello_json(const experiment::Session& session, const Source& source);
/// The scenario after a change.
MessagePtr scenario_message(const experiment::Scenario& scenario);
MessagePtr frame_message(const experiment::SessionView& view, const Diagnostics& diagnostics);
MessagePtr plan_message(const experiment::SessionView& view);
MessagePtr aggregation_message(const AggregationDiagnostics& plan);
/// Clearance of the map at the centres of at most so many square cells, row by row from below.
MessagePtr clearance_message(const Map& map, double max_cells = 40'000);
MessagePtr rows_message(std::span<const Row> rows, std::span<const experiment::RunEvent> events,
                        bool anew);
MessagePtr standing_message(const Standing& standing, const experiment::RunResult& result);
/// Answer to a request; with issues it was refused.
MessagePtr answer_message(std::uint64_t id, const Issues& issues);

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/experiment/record/diagnostics_log.hpp"
#include "microswarm/experiment/record/rig_log.hpp"
#include "microswarm/experiment/run/run_listener.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

namespace microswarm::experiment {

/// Record of a run, sufficient to repeat, measure and draw it.
struct Record {
  std::string version{};  ///< library version of the run
  Scene scene{};          ///< includes the world, so that a record needs no other file
  std::uint32_t trial = 0;
  std::string rig{};  ///< name of the rig; empty for a simulation. Runs on a rig have no replay
  /// "external" if the run's navigator was not the scenario's, or the name of one that is gone
  /// since the version that made the record; a replay repeats its commands.
  std::string navigator{};
  RunResult result{};
  std::vector<Frame> frames{};  ///< one per tick, and one for the end with state "end"
  std::vector<PathChange> paths{};
  std::vector<PlanEvent> plans{};
  std::vector<RunEvent> events{};
  std::vector<Change> changes{};      ///< changes during the run; the scene is the initial one
  std::vector<RobotMoment> robots{};  ///< individually tracked robots, at a subset of the frames
  std::vector<PhasedGoal> phased_goals{};  ///< of an external navigator, for a replay
  DiagnosticsLog diagnostics{};            ///< empty unless the scenario keeps them
  RigLog rig_log{};                        ///< of a run on a rig
  std::string stated_hash{};               ///< hash stated in the file; empty for a new record

  /// The tables of the record.
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.frames, plain("frames", "Ticks, and the end."));
    visit(self.paths, plain("paths", "Paths that the navigator followed."));
    visit(self.plans, plain("plans", "Planning events."));
    visit(self.events, plain("events", "What happened, between the ticks too."));
    visit(self.robots, plain("robots", "Where individually tracked robots were."));
  }

  /// Fingerprint of all physical data: frames, paths, plans, events, status, metrics and any
  /// changes.
  std::string hash() const;
};

/// The bytes of an HDF5 file with the layout in docs/reference/record.md.
std::string record_bytes(const Record& record);

/// Writes an HDF5 file with the layout in docs/reference/record.md, atomically through a temporary
/// file. A symbolic link is replaced, its target is kept. Throws InputError "FILE: cannot write:
/// REASON" and leaves no file behind; leftovers of killed processes are removed.
void write_record(const Record& record, const std::filesystem::path& file);

/// Reads a record. Throws InputError if the file is not a record, is damaged or is inconsistent.
Record read_record(const std::filesystem::path& file);

}  // namespace microswarm::experiment

namespace microswarm {

/// Compiled once, in record.cpp; describes the whole record.
extern template const Type& type_of<experiment::Record>();

}  // namespace microswarm

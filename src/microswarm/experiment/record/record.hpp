// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/experiment/record/rig_log.hpp"
#include "microswarm/experiment/run/run.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

namespace microswarm {

/// Record of a run, sufficient to repeat, measure and draw it.
struct Record {
  std::string version;  ///< library version of the run
  Scene scene;          ///< includes the world, so that a record needs no other file
  std::uint32_t trial = 0;
  std::string rig;  ///< name of the rig; empty for a simulation. Runs on a rig have no replay
  /// "external" if the run's navigator was not the scenario's; a replay repeats its commands.
  std::string navigator;
  RunResult result;
  std::vector<Frame> frames;  ///< one per tick, and one for the end with state "end"
  std::vector<PathChange> paths;
  std::vector<PlanEvent> plans;
  std::vector<RunEvent> events;
  std::vector<Change> changes;           ///< changes during the run; the scene is the initial one
  std::vector<RobotMoment> robots;       ///< individually tracked robots, at a subset of the frames
  std::vector<PhasedGoal> phased_goals;  ///< of an external navigator, for a replay
  RigLog rig_log;                        ///< of a run on a rig
  std::string stated_hash;               ///< hash stated in the file; empty for a new record

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

/// Compiled once, in record.cpp; describes the whole record.
extern template const Type& type_of<Record>();

/// Keeps a run in memory. Pass it to run(), then take the record. Robot positions are kept at 64 to
/// 128 equally spaced frames and at the end.
class Recorder : public RunListener {
 public:
  explicit Recorder(Scene scene, std::uint32_t trial = 0, std::string rig = {});
  void on_tick(const Tick& tick) override;
  void on_end(const RunResult& result) override;
  /// Notes that the navigator is not the scenario's.
  void note_external_navigator() { record_.navigator = "external"; }
  /// Sets the result so far of a run that has not ended.
  void keep(const RunResult& result) { record_.result = result; }

  /// Log of a rig.
  RigLog& rig_log() { return record_.rig_log; }
  const Record& record() const { return record_; }
  Record take() { return std::move(record_); }

 private:
  void keep_robots(double t, std::span<const Vec2> robots);

  Record record_;
  std::size_t robot_period_ = 1;  // frames
  std::size_t robot_frames_ = 0;
  RobotMoment last_robots_;
};

/// Writes an HDF5 file with the layout in docs/reference/record.md, atomically through a temporary
/// file. A symbolic link is replaced, its target is kept. Throws InputError "FILE: cannot write:
/// REASON" and leaves no file behind; leftovers of killed processes are removed.
void write_record(const Record& record, const std::filesystem::path& file);

/// Reads a record. Throws InputError if the file is not a record, is damaged or is inconsistent.
Record read_record(const std::filesystem::path& file);

/// Result of a replay.
struct ReplayResult {
  bool identical = false;
  bool stopped = false;    ///< stopped by the caller
  std::string difference;  ///< first difference, as text; empty if identical
};

/// Runs the stored scene again and compares it up to the record's last frame. Throws InputError for
/// a run on a rig.
ReplayResult replay(const Record& record, const Stop& stop = {});

}  // namespace microswarm

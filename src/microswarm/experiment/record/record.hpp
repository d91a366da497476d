// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/experiment/run/run.hpp"
#include "microswarm/experiment/scenario/scene.hpp"

namespace microswarm {

/// Everything worth keeping of a run: enough to repeat it, to measure it again and to draw it.
struct Record {
  std::string version;  ///< of the library that ran it
  Scene scene;          ///< world included: a record needs no other file
  std::uint32_t trial = 0;
  std::string rig;  ///< name of the rig it ran on, which no replay has; empty for a simulation
  RunResult result;
  std::vector<Frame> frames;  ///< one a tick, and one for the end, whose state is "end"
  std::vector<PathChange> paths;
  std::vector<PlanEvent> plans;
  std::vector<RunEvent> events;
  std::vector<Change> changes;      ///< what was changed while it ran; the scene is as it began
  std::vector<RobotMoment> robots;  ///< of robots that are told apart: a part of the frames
  std::string stated_hash;  ///< what the file it was read from says it is; empty for a new one

  /// The tables.
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.frames, {"frames", Unit::none, {}, "Ticks, and the end."});
    visit(self.paths, {"paths", Unit::none, {}, "Paths that the navigator followed."});
    visit(self.plans, {"plans", Unit::none, {}, "Planning events."});
    visit(self.events, {"events", Unit::none, {}, "What happened, between the ticks too."});
    visit(self.robots, {"robots", Unit::none, {}, "Where individually tracked robots were."});
  }

  /// Fingerprint of all that is physical: frames, paths, plans, events, status and metrics, and of
  /// the changes, where there are any.
  std::string hash() const;
};

/// Compiled once, in record.cpp: it describes all that a record holds.
extern template const Type& type_of<Record>();

/// Keeps a run in memory. Give it to run(), then take the record. Where robots are it keeps at 64
/// to 128 moments, evenly from the start on, and at the end.
class Recorder : public RunListener {
 public:
  explicit Recorder(Scene scene, std::uint32_t trial = 0, std::string rig = {});
  void on_tick(const Tick& tick) override;
  void on_end(const RunResult& result) override;

  const Record& record() const { return record_; }
  Record take() { return std::move(record_); }

 private:
  void keep_robots(double t, std::span<const Vec2> robots);

  Record record_;
  std::size_t robot_period_ = 1;  // frames
  std::size_t robot_frames_ = 0;
  RobotMoment last_robots_;
};

/// Writes an HDF5 file, layout in docs/reference/record.md, under a temporary name first. Throws
/// InputError "FILE: cannot write: REASON" and leaves nothing behind.
void write_record(const Record& record, const std::filesystem::path& file);

/// Reads one back. Throws InputError for a file that is none, is damaged or contradicts itself.
Record read_record(const std::filesystem::path& file);

/// What a replay found.
struct ReplayResult {
  bool identical = false;
  bool stopped = false;    ///< by the caller, before it came to an end
  std::string difference;  ///< where they parted, for people; empty when identical
};

/// Runs the stored scene again and compares, up to the frame at which the record ends. Throws
/// InputError for a run on a rig.
ReplayResult replay(const Record& record, const Stop& stop = {});

}  // namespace microswarm

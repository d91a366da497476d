// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "microswarm/contracts/navigator.hpp"
#include "microswarm/contracts/plant.hpp"
#include "microswarm/experiment/record/recorder.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/experiment/session/source.hpp"
#include "microswarm/experiment/session/view.hpp"

namespace microswarm::experiment {

/// Data that a session keeps of its ticks.
enum class Keep {
  nothing,  ///< for a session without listeners
  result,   ///< status, metrics and times
  record    ///< all, for a replay
};

/// Parts of a session beside its scenario, and the data it keeps.
struct SessionParts {
  std::uint32_t trial = 0;                 ///< selects the random streams
  std::shared_ptr<Plant> plant{};          ///< null: the kinematic simulation
  std::shared_ptr<Navigator> navigator{};  ///< null: the scenario's
  std::string rig{};                       ///< name of the rig behind `plant`
  Keep keep = Keep::record;
};

/// An open experiment: the common interface of command line, trials, sweeps, learning, lab, Python
/// and C. It advances only when stepped. Use one session from one thread at a time; several
/// sessions may run in separate threads.
///
///     const auto session = open_session("scenario.yaml");
///     while (session->step()) draw(session->view());
///     session->record_to("run.h5");
class Session {
 public:
  /// Runs an experiment.
  explicit Session(Experiment experiment, SessionParts parts = {});
  /// Plays a record back.
  explicit Session(Record record);
  ~Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The next tick, also passed to the listeners; null after the last one. Valid until the next
  /// call.
  const Tick* step(const Stop& stop = {});
  /// Steps to the end.
  const RunResult& finish(const Stop& stop = {});
  /// Adds a listener for all further ticks and the end; it must outlive them.
  void listen(RunListener& listener) { listeners_.push_back(&listener); }

  /// Sets a scenario value, written as in a file, from the next tick on. Returns all issues; if
  /// there are any, nothing changes. See RunningExperiment::set for the settable values. A record
  /// cannot be changed.
  Issues set(const std::string& key, const std::string& value);
  /// Manual operation of the experiment: pause, steer, end; usable from any thread. Null for a
  /// record.
  Operation* operation() { return source_->operation(); }
  /// Seeks a frame of a record, at most its last: view() shows it, step() returns the next one.
  /// False if the session is not a record, or has no frames.
  bool seek(std::size_t frame);

  /// One line for each former key in the files and settings.
  const Notes& notes() const { return notes_; }

  bool is_playback() const { return source_->record() != nullptr; }
  /// The current scenario with all changes.
  const Scenario& scenario() const { return source_->scenario(); }
  const Map& map() const { return *source_->world().map; }
  /// The newest tick; null before the first. Valid until the next step.
  const Tick* tick() const { return tick_; }
  /// Current state; before the first tick only a frame at t = 0 and the robots, if known.
  SessionView view() const;
  /// Diagnostics of the navigator in the newest tick, computed when they are first asked for; of a
  /// record, those that it keeps. Valid until the next step.
  const Diagnostics& diagnostics() const;
  /// Result so far, with status `running` before the last tick. It must be kept.
  const RunResult& result() const;
  /// Record so far, which can be replayed; complete after the last tick. It must be kept.
  const Record& record() const;
  /// Writes the record. Throws InputError like write_record.
  void record_to(const std::filesystem::path& file) const { write_record(record(), file); }
  /// Log of a rig in the record, which must be kept.
  RigLog& rig_log() { return recorder_->rig_log(); }

 private:
  std::unique_ptr<Recorder> recorder_;  ///< of a run that is recorded
  RunResult result_;                    ///< if no record is kept
  std::optional<MetricsListener> metrics_;
  Notes notes_;
  std::unique_ptr<SessionSource> source_;
  std::vector<RunListener*> listeners_;
  const Tick* tick_ = nullptr;
  std::uint64_t ticks_ = 0;
  std::uint64_t plans_ = 0;
};

/// Whether the file has the signature or the name of an HDF5 file.
bool is_record(const std::filesystem::path& file);

/// Opens a scenario (YAML) with `settings`, or a record (.h5), which accepts neither settings nor
/// parts. Throws InputError with one line per issue.
std::unique_ptr<Session> open_session(const std::filesystem::path& file,
                                      const Settings& settings = {}, SessionParts parts = {});

/// Runs one trial of a scenario to its end, and passes its ticks to the listeners. Of its ticks
/// only the result is kept.
RunResult simulate(const Scenario& scenario, const World& world, SessionParts parts = {},
                   std::span<RunListener* const> listeners = {}, const Stop& stop = {});

}  // namespace microswarm::experiment

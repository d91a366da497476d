// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "microswarm/experiment/record/playback.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/run/metrics_listener.hpp"
#include "microswarm/experiment/run/open_run.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"
#include "microswarm/session/view.hpp"

namespace microswarm {

/// Options for opening a scenario.
struct SessionOptions {
  Settings settings{};                  ///< of the scenario
  std::optional<std::uint64_t> seed{};  ///< overrides the scenario's seed
  std::uint32_t trial = 0;              ///< selects the random streams
  std::filesystem::path rig{};          ///< file of a rig to simulate; empty for none
  std::vector<std::string> rig_settings{};
};

/// An open experiment: the common interface of command line, lab, Python and C. It advances only
/// when stepped, and records every step. Use a session from one thread at a time; several sessions
/// may run in separate threads.
///
///     const auto session = open_session("scenario.yaml");
///     while (session->step()) draw(session->view());
///     session->record_to("run.h5");
class Session {
 public:
  /// Opens an experiment in the kinematic simulation or through `plant`, with the scenario's
  /// navigator or `navigator`. `rig` is the name of the rig behind `plant`.
  explicit Session(Experiment experiment, std::uint32_t trial = 0,
                   std::unique_ptr<Plant> plant = nullptr,
                   std::unique_ptr<Navigator> navigator = nullptr, const std::string& rig = {});
  /// Opens a record for playback.
  explicit Session(Record record);
  virtual ~Session() = default;
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
  /// there are any, nothing changes. See OpenRun::change for the settable values. A record cannot
  /// be changed.
  Issues set(const std::string& key, const std::string& value);
  /// Manual operation of the experiment: pause, steer, end; usable from any thread. Null for a
  /// record.
  Operation* operation();
  /// Seeks a frame of a record, at most its last: view() shows it, step() returns the next one.
  /// False if the session is not a record, or has no frames.
  bool seek(std::size_t frame);

  /// One line for each former key in the files and settings.
  const Notes& notes() const { return notes_; }

  bool is_playback() const { return std::holds_alternative<Playback>(source_); }
  /// The current scenario with all changes.
  const Scenario& scenario() const;
  const Map& map() const;
  /// Current state; before the first tick only a frame at t = 0.
  SessionView view() const;
  /// Aggregation tree and map segmentation; empty for other navigators, before the first tick and
  /// for records.
  std::optional<AggregationView> aggregation() const;
  /// Result so far, with status `running` before the last tick.
  const RunResult& result() const;
  /// Record so far, which can be replayed; complete after the last tick.
  const Record& record() const;
  /// Writes the record. Throws InputError like write_record.
  void record_to(const std::filesystem::path& file) const { write_record(record(), file); }

 protected:
  /// The newest tick; null before the first.
  const Tick* newest() const { return tick_; }
  /// Log of a rig in the record of a running session.
  RigLog& rig_log() { return std::get<0>(source_)->recorder.rig_log(); }

 private:
  struct Running {
    Running(Experiment experiment, std::uint32_t trial, std::unique_ptr<Plant> plant,
            std::unique_ptr<Navigator> navigator, const std::string& rig);
    OpenRun run;
    Recorder recorder;
    MetricsListener metrics;
  };

  std::variant<std::unique_ptr<Running>, Playback> source_;
  Notes notes_;
  std::vector<RunListener*> listeners_;
  const Tick* tick_ = nullptr;  ///< the newest tick
  std::uint64_t ticks_ = 0;
  std::uint64_t plans_ = 0;
};

/// Opens a scenario (YAML) in the kinematic simulation or through a simulated rig, or a record
/// (.h5), which accepts no options. Throws InputError with one line per issue.
std::unique_ptr<Session> open_session(const std::filesystem::path& file,
                                      const SessionOptions& options = {});

/// Opens a session through a simulated rig. Throws InputError if rig and scenario do not fit.
std::unique_ptr<Session> rig_session(const RigExperiment& on, std::uint32_t trial = 0);

/// JSON Schema of scenarios: every key with its unit, range, default and description.
std::string session_schema();

}  // namespace microswarm

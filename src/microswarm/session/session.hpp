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
#include "microswarm/rig/runtime/devices.hpp"
#include "microswarm/session/view.hpp"

namespace microswarm {

/// How a scenario is opened.
struct SessionOptions {
  std::vector<std::string> settings{};  ///< KEY=VALUE of the scenario, as from --set
  std::optional<std::uint64_t> seed{};  ///< in place of the scenario's
  std::uint32_t trial = 0;              ///< chooses the random streams
  std::filesystem::path rig{};          ///< file of a rig, which is simulated; none: no rig
  std::vector<std::string> rig_settings{};
};

/// An experiment that is open: what the command line, the lab, Python and C share. It stands still
/// until it is stepped; what is stepped is recorded. One thread at a time.
///
///     const auto session = open_session("scenario.yaml");
///     while (session->step()) draw(session->view());
///     session->record_to("run.h5");
class Session {
 public:
  /// An experiment in the simulation without physics, or through `plant`, with the scenario's
  /// navigator or another one. `rig` is the name of the rig that the plant is.
  explicit Session(Experiment experiment, std::uint32_t trial = 0,
                   std::unique_ptr<Plant> plant = nullptr,
                   std::unique_ptr<Navigator> navigator = nullptr, const std::string& rig = {});
  /// A record, which is played back.
  explicit Session(Record record);
  virtual ~Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The next tick, which the listeners hear too; null after the last one. Valid until the next.
  const Tick* step(const Stop& stop = {});
  /// Steps to the end.
  const RunResult& finish(const Stop& stop = {});
  /// Hears every tick from now on, and the end; must outlive the session.
  void listen(RunListener& listener) { listeners_.push_back(&listener); }

  /// Sets a value of the scenario as it would stand in a file, from the next tick on. Where there
  /// are issues, all of them, nothing has changed. See OpenRun::change for what can be set; a
  /// record can be changed in nothing.
  Issues set(const std::string& key, const std::string& value);
  /// Goes to a frame of a record. False for what is no record.
  bool seek(std::size_t frame);

  /// One line for each former key that was read in the files and settings.
  const Notes& notes() const { return notes_; }

  bool is_playback() const { return std::holds_alternative<Playback>(source_); }
  /// As it is by now.
  const Scenario& scenario() const;
  const Map& map() const;
  /// The present; before the first tick with a frame at t = 0 alone.
  SessionView view() const;
  /// What robots are gathered by; nothing for other navigators, before the first tick and of a
  /// record.
  std::optional<AggregationView> aggregation() const;
  /// Up to now; whole after the last tick.
  const RunResult& result() const;
  /// Up to now; whole after the last tick.
  const Record& record() const;
  /// Writes the record. Throws InputError, see write_record.
  void record_to(const std::filesystem::path& file) const { write_record(record(), file); }

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
  const Tick* tick_ = nullptr;  ///< the newest
  std::uint64_t ticks_ = 0;
  std::uint64_t plans_ = 0;
};

/// Opens a scenario (YAML), in the simulation without physics or through a simulated rig, or a
/// record (.h5), which takes no options. Throws InputError with a line for each thing wrong.
std::unique_ptr<Session> open_session(const std::filesystem::path& file,
                                      const SessionOptions& options = {});

/// A session through a simulated rig. Throws InputError when rig and scenario do not go together.
std::unique_ptr<Session> rig_session(const RigExperiment& on, std::uint32_t trial = 0);

/// JSON Schema of scenarios: every key with its unit, range, default and doc.
std::string session_schema();

}  // namespace microswarm

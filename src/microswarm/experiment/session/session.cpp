// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/session/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/session/playback.hpp"
#include "microswarm/experiment/session/running_experiment.hpp"

namespace microswarm::experiment {

bool is_record(const std::filesystem::path& file) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  return file.extension() == ".h5" || read_begin(file, signature.size()) == signature;
}

Session::Session(Experiment experiment, SessionParts parts) : notes_(experiment.keys.notes()) {
  if (parts.keep == Keep::record) {
    recorder_ = std::make_unique<Recorder>(experiment.scene, parts.trial, std::move(parts.rig));
    if (parts.navigator) recorder_->note_external_navigator();
  } else if (parts.keep == Keep::result) {
    metrics_.emplace(experiment.scenario(), result_);
  }
  source_ = std::make_unique<RunningExperiment>(std::move(experiment.scene.scenario),
                                                std::move(experiment.world), parts.trial,
                                                std::move(parts.plant), std::move(parts.navigator));
}

Session::Session(Record record) : source_(std::make_unique<Playback>(std::move(record))) {}

const Tick* Session::step(const Stop& stop) {
  const Tick* tick = source_->step(stop);
  if (!tick) return nullptr;
  tick_ = tick;
  ++ticks_;
  plans_ += tick->frame.planned;
  if (recorder_) recorder_->on_tick(*tick);
  if (metrics_) metrics_->on_tick(*tick);
  for (RunListener* listener : listeners_) listener->on_tick(*tick);
  const bool has_result = recorder_ || metrics_;
  if (tick->end && ticks_ == 1 && has_result && result().status == Status::solved)
    notes_.push_back(fmt::format(
        "nothing was to be done: the distance to the goal, {:.4g} µm, is within goal_tolerance_um, "
        "{:.4g} µm, at the start",
        result().metrics.goal_distance, scenario().goal_tolerance));
  if (tick->end)
    for (RunListener* listener : listeners_) listener->on_end(result());
  return tick;
}

const RunResult& Session::finish(const Stop& stop) {
  while (step(stop)) {
  }
  return result();
}

Issues Session::set(const std::string& key, const std::string& value) {
  Issues issues;
  if (!key.empty() && key.find('=') == std::string::npos) return source_->set(key, value);
  issues.add(key, key.empty() ? "a key is missing" : "a key has no '='");
  return issues;
}

bool Session::seek(std::size_t frame) {
  const std::optional<std::size_t> found = source_->seek(frame);
  if (!found) return false;
  ticks_ = *found;
  tick_ = source_->step({});
  ticks_ += tick_ != nullptr;
  const auto& frames = record().frames;
  plans_ = static_cast<std::uint64_t>(
      std::count_if(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(ticks_),
                    [](const Frame& f) { return f.planned; }));
  return tick_ != nullptr;
}

SessionView Session::view() const {
  if (tick_) return session_view(*tick_, ticks_ - 1, plans_);
  SessionView view;
  if (scenario().start) view.frame.pose = *scenario().start;
  if (!scenario().robots) return view;
  view.robots = source_->first_robots();
  for (const Vec2 robot : view.robots)
    view.frame.pose.position += robot / static_cast<double>(view.robots.size());
  return view;
}

const Diagnostics& Session::diagnostics() const {
  static const Diagnostics none;
  return tick_ ? tick_->diagnostics.value() : none;
}

const RunResult& Session::result() const { return metrics_ ? result_ : record().result; }

const Record& Session::record() const {
  const Record* played = source_->record();
  assert(played || recorder_);
  return played ? *played : recorder_->record();
}

std::unique_ptr<Session> open_session(const std::filesystem::path& file, const Settings& settings,
                                      SessionParts parts) {
  if (!is_record(file))
    return std::make_unique<Session>(open_experiment(file, settings), std::move(parts));
  if (!settings.empty() || parts.trial != 0 || parts.plant || parts.navigator)
    throw InputError(file.string(), "a record accepts no options");
  return std::make_unique<Session>(read_record(file));
}

RunResult simulate(const Scenario& scenario, const World& world, SessionParts parts,
                   std::span<RunListener* const> listeners, const Stop& stop) {
  parts.keep = Keep::result;
  Session session(Experiment{{scenario, {}}, world, {}}, std::move(parts));
  for (RunListener* listener : listeners) session.listen(*listener);
  return session.finish(stop);
}

}  // namespace microswarm::experiment

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/session/session.hpp"

#include <array>
#include <fstream>
#include <string_view>

#include <algorithm>

#include "microswarm/config/schema.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/simulation/simulated_rig.hpp"

namespace microswarm {
namespace {

/// A simulated rig that owns its parameters.
class OwnedRig : public Plant {
 public:
  OwnedRig(const Scenario& scenario, const World& world, Rig rig, std::uint32_t trial)
      : rig_(std::move(rig)), plant_(scenario, world, rig_, trial) {}
  Observation observe() override { return plant_.observe(); }
  void apply(const Command& command, double dt) override { plant_.apply(command, dt); }
  bool set_obstacles(const std::vector<Obstacle>& obstacles) override {
    return plant_.set_obstacles(obstacles);
  }
  std::optional<GroundTruth> ground_truth() const override { return plant_.ground_truth(); }

 private:
  Rig rig_;
  SimulatedRig plant_;
};

/// Whether the file has the signature or the name of an HDF5 file.
bool is_hdf5(const std::filesystem::path& file) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::array<char, signature.size()> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return file.extension() == ".h5" || std::string_view(begin.data(), begin.size()) == signature;
}

}  // namespace

Session::Running::Running(Experiment experiment, std::uint32_t trial, std::unique_ptr<Plant> plant,
                          std::unique_ptr<Navigator> navigator, const std::string& rig)
    : run(experiment.scenario(), experiment.world,
          plant ? std::move(plant)
                : make_kinematic_plant(experiment.scenario(), experiment.world, trial),
          trial, std::move(navigator)),
      recorder(std::move(experiment.scene), trial, rig),
      metrics(run.scenario()) {
  if (run.has_external_navigator()) recorder.note_external_navigator();
}

Session::Session(Experiment experiment, std::uint32_t trial, std::unique_ptr<Plant> plant,
                 std::unique_ptr<Navigator> navigator, const std::string& rig)
    : notes_(experiment.keys.notes()) {
  source_ = std::make_unique<Running>(std::move(experiment), trial, std::move(plant),
                                      std::move(navigator), rig);
}

Session::Session(Record record) : source_(Playback(std::move(record))) {}

const Tick* Session::step(const Stop& stop) {
  Running* running = is_playback() ? nullptr : std::get<0>(source_).get();
  const Tick* tick = running ? running->run.step(stop) : std::get<Playback>(source_).step();
  if (!tick) return nullptr;
  tick_ = tick;
  ++ticks_;
  plans_ += tick->frame.planned;
  if (running) {
    running->recorder.on_tick(*tick);
    running->metrics.on_tick(*tick);
    if (tick->end) running->recorder.on_end(running->metrics.result());
  }
  for (RunListener* listener : listeners_) {
    listener->on_tick(*tick);
    if (tick->end) listener->on_end(result());
  }
  return tick;
}

const RunResult& Session::finish(const Stop& stop) {
  while (step(stop)) {
  }
  return result();
}

Issues Session::set(const std::string& key, const std::string& value) {
  Issues issues;
  if (is_playback())
    issues.add(key, "a record cannot be changed");
  else if (key.empty() || key.find('=') != std::string::npos)
    issues.add(key, key.empty() ? "a key is missing" : "a key has no '='");
  else
    issues = std::get<0>(source_)->run.change(key, value);
  return issues;
}

Operation* Session::operation() {
  return is_playback() ? nullptr : &std::get<0>(source_)->run.operation();
}

bool Session::seek(std::size_t frame) {
  if (!is_playback()) return false;
  auto& playback = std::get<Playback>(source_);
  ticks_ = playback.seek(frame);
  tick_ = playback.step();
  ticks_ += tick_ != nullptr;
  const auto& frames = playback.record().frames;
  plans_ = static_cast<std::uint64_t>(
      std::count_if(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(ticks_),
                    [](const Frame& f) { return f.planned; }));
  return tick_ != nullptr;
}

const Scenario& Session::scenario() const {
  return is_playback() ? std::get<Playback>(source_).scenario()
                       : std::get<0>(source_)->run.scenario();
}

const Map& Session::map() const {
  return is_playback() ? *std::get<Playback>(source_).world().map
                       : *std::get<0>(source_)->run.world().map;
}

SessionView Session::view() const {
  if (!tick_) {
    SessionView view;
    if (scenario().start) view.frame.pose = *scenario().start;
    return view;
  }
  const Navigator* navigator = is_playback() ? nullptr : &std::get<0>(source_)->run.navigator();
  return view_of(*tick_, ticks_ - 1, plans_, navigator);
}

std::optional<AggregationView> Session::aggregation() const {
  if (is_playback()) return std::nullopt;
  return aggregation_of(std::get<0>(source_)->run.navigator());
}

const RunResult& Session::result() const {
  return is_playback() ? std::get<Playback>(source_).record().result
                       : std::get<0>(source_)->metrics.result();
}

const Record& Session::record() const {
  if (is_playback()) return std::get<Playback>(source_).record();
  Running& running = *std::get<0>(source_);
  if (running.metrics.result().status == Status::running)
    running.recorder.keep(running.metrics.result());
  return running.recorder.record();
}

std::unique_ptr<Session> open_session(const std::filesystem::path& file,
                                      const SessionOptions& options) {
  if (is_hdf5(file)) {
    if (!options.settings.empty() || !options.rig_settings.empty() || options.seed ||
        options.trial != 0 || !options.rig.empty())
      throw InputError(file.string() + ": a record accepts no options");
    return std::make_unique<Session>(read_record(file));
  }
  if (options.rig.empty() && !options.rig_settings.empty())
    throw InputError("values of a rig are set, but there is no rig");
  if (options.rig.empty())
    return std::make_unique<Session>(open_experiment(file, options.settings, options.seed),
                                     options.trial);
  return rig_session(
      open_rig_experiment(file, options.settings, options.rig, options.rig_settings, options.seed),
      options.trial);
}

std::unique_ptr<Session> rig_session(const RigExperiment& on, std::uint32_t trial) {
  auto plant = std::make_unique<OwnedRig>(on.scenario(), on.experiment.world, on.rig, trial);
  return std::make_unique<Session>(on.experiment, trial, std::move(plant), nullptr,
                                   name_of(on.rig));
}

std::string session_schema() { return json_schema<Scenario>("microswarm scenario"); }

}  // namespace microswarm

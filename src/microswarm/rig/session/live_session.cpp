// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/session/live_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <limits>
#include <utility>

#include "microswarm/config/write.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/rig/watch/map_check.hpp"

namespace microswarm::rig {

namespace {

/// The experiment if its rig can make the field and has all limits. Disables the following check if
/// no current is sent to the coils or a video plays.
RigExperiment checked(RigExperiment on, const LiveOptions& options) {
  require_field(on.rig);
  if (has_coil_device(on.rig) && !options.dry && !options.without_limits)
    on.rig.keys.require_none(missing_limits(on.rig));
  if (!options.dry && !options.uncommissioned)
    on.rig.keys.require_none(missing_commissioning(on.rig, commissioning_state(on.rig)));
  if (options.dry || camera_kind(on.rig.params) == CameraKind::video) {
    SafetyParams& safety = on.rig.params.safety;
    safety.min_follow_share = safety.max_follow_share = safety.frozen_swarm = 0;
    safety.max_map_shift_px = 0;
  }
  return on;
}

std::unique_ptr<vision::VideoRecorder> video_recorder(const std::filesystem::path& file,
                                                      std::optional<double> rate) {
  if (file.empty()) return nullptr;
  return std::make_unique<vision::VideoRecorder>(file, rate.value_or(0));
}

experiment::SessionParts to_parts(const Rig& rig, std::shared_ptr<Plant> plant,
                                  const LiveOptions& options) {
  return {.plant = std::move(plant), .rig = rig_name(rig) + (options.dry ? ", dry run" : "")};
}

/// Date and local time, ISO 8601.
std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 64> text{};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S%z", &local);
  return {text.data(), size};
}

/// Log of a rig at the start of an experiment.
experiment::RigLog make_log(const Rig& rig, const std::string& note) {
  experiment::RigLog log;
  log.began = date_now();
  log.note = note;
  log.rig_file = to_yaml(rig.params);
  log.coils_file = read_file(rig.folder / rig.params.coils, 1 << 24);
  log.coils = rig.system.coil_names();
  return log;
}

experiment::RigLatency rig_latency(const RigTiming& timing) {
  const Durations& times = timing.camera_to_current;
  return {.median = times.quantile(0.5),
          .p99 = times.quantile(0.99),
          .longest = times.longest(),
          .pictures = static_cast<int>(times.count()),
          .late_currents = timing.late_currents,
          .ticks = static_cast<int>(timing.tick.count()),
          .missed_deadlines = timing.missed_deadlines};
}

constexpr double device_check = 0.3;    // [s]
constexpr double disk_period = 10;      // between looks at the disk [s]
constexpr double warned_before = 1800;  // the disk is full [s]

/// Time after which a run has ended at the latest [s].
double longest_time(const experiment::Scenario& scenario, const LiveOptions& options) {
  return std::min(scenario.time_limit + scenario.hold_at_goal, options.seconds.value_or(infinity));
}

/// The options if what the longest run writes has space in its folder.
LiveOptions with_space(LiveOptions options, const RigExperiment& on) {
  const experiment::Scenario& scenario = on.scenario();
  if (const auto free = options.folder.empty() ? std::nullopt : options.free_space(options.folder))
    require_space(options.folder,
                  needed_space(on.rig, scenario.tick, longest_time(scenario, options)), *free);
  return options;
}

}  // namespace

LiveSession::LiveSession(RigExperiment on, const LiveOptions& options)
    : options_(with_space(options, on)),
      map_limit_(on.rig.params.safety.max_map_shift_px),
      on_(checked(std::move(on), options)),
      commissioning_(commissioning_state(on_.rig)),
      devices_(open_devices(on_, options.dry, options.idle)),
      kept_(make_log(on_.rig, options.note)),
      log_(options.folder, on_.rig.system, options.dry),
      video_(video_recorder(options.video, devices_.camera_rate)),
      plant_(std::make_shared<LiveRig>(
          on_.scenario(), on_.experiment.world.map, on_.rig, std::move(devices_.camera),
          devices_.scale, devices_.driver(),
          LiveRigListeners{
              .coils = [this](const CoilMoment& moment) { keep(moment); },
              .pictures = video_ ? video_->input() : vision::FrameListener(),
              .detections = [this](const Detections& seen, double t) { keep(seen, t); }})),
      session_(on_.experiment, to_parts(on_.rig, plant_, options)) {
  warn_of_slow_ticks();
  require_map();
  if (video_) video_->begin(plant_->start());
  if (device_camera(on_.rig.params))
    require(check_camera(plant_->camera(), on_.rig, devices_.camera_rate, device_check));
  if (has_coil_device(on_.rig) && !options.dry) open_coils(options);
  kept_.commissioning = commissioning_.text;
  if (const std::string state = to_text(commissioning_, std::time(nullptr)); !state.empty())
    warnings_.push_back("commissioning: " + state);
  session_.rig_log() = kept_;
}

void LiveSession::warn_of_slow_ticks() {
  const double tick = on_.scenario().tick;
  if (tick <= on_.rig.params.safety.lost_swarm) return;
  warnings_.push_back(fmt::format(
      "the scenario's tick is {:.4g} s: pictures are judged that rarely, and without commands the "
      "coils stop after {:.4g} s",
      tick, deadman(on_.rig, tick)));
}

void LiveSession::require(const std::vector<RigCheck>& checks) {
  for (const RigCheck& check : checks) {
    if (check.good) continue;
    const std::string line = check.what + ": " + check.answer;
    if (check.required) throw HardwareError(line);
    warnings_.push_back(line);
  }
}

/// Refuses a map that does not lie over the picture. Nothing is driven by a dry run or a video:
/// there it is a warning.
void LiveSession::require_map() {
  const MapCheck check = check_map(plant_->first_fit(), map_limit_);
  const bool drives = !options_.dry && camera_kind(on_.rig.params) != CameraKind::video;
  if (!check.good && drives) throw on_.rig.keys.error("scale", check.text);
  if (!check.good || !check.sure) warnings_.push_back(check.text);
  if (!plant_->first_fit().unsure.empty())
    warnings_.push_back("later pictures are compared with the first one of the run");
}

void LiveSession::open_coils(const LiveOptions& options) {
  require(check_driver(devices_.driver(), on_.rig, device_check));
  temperatures_.emplace(on_.rig, options.coils_cold);
  plant_->warm(temperatures_->at_start());
  if (!temperatures_->known()) warnings_.push_back(temperatures_->why_hot());
}

/// Logs the detections of a new picture: the swarm and other bodies.
void LiveSession::keep(const Detections& seen, double t) {
  keep_picture_state(t);
  if (kept_.seen_until) return;
  if (kept_.seen_at.size() >= options_.max_logged) {
    kept_.seen_until = kept_.seen_at.empty() ? 0 : kept_.seen_at.back();
    return;
  }
  if (seen.swarm) kept_.see(t, -1, seen.swarm->pose.position, seen.swarm->radius);
  for (const Body& body : seen.moving) {
    const Disc extent = enclosing_disc(body);
    kept_.see(t, body.obstacle, extent.centre, extent.radius);
  }
}

void LiveSession::keep_picture_state(double t) {
  constexpr double period = 1;  // [s]
  constexpr std::size_t most = 1'000'000;
  if (t < state_due_ || kept_.pictures.size() >= most) return;
  state_due_ = t + period;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const PictureState state = plant_->picture_state();
  kept_.pictures.push_back({.t = t,
                            .light = state.light,
                            .focus = state.focus.value_or(unknown),
                            .shift_px = state.shift_px.value_or(unknown),
                            .unseen_share = state.unseen_share,
                            .follow_share = state.follow_share.value_or(unknown)});
}

/// In the coils' thread.
void LiveSession::keep(const CoilMoment& moment) {
  const double start = plant_->start();
  log_.add(moment, start);
  if (kept_.currents.size() >= options_.max_logged) {
    if (!currents_full_)
      kept_.currents_until = kept_.driven_at.empty() ? 0 : kept_.driven_at.back();
    currents_full_ = true;
  } else {
    kept_.driven_at.push_back(moment.t - start);
    kept_.answered_at.push_back(moment.driven - start);
    kept_.pictured_at.push_back(moment.seen - start);
    kept_.currents.insert(kept_.currents.end(), moment.output.acknowledged.begin(),
                          moment.output.acknowledged.end());
  }
  if (temperatures_) temperatures_->take(moment.output.temperatures);
  if (options_.driven) options_.driven();
}

actuation::StopReport LiveSession::stop(const std::string& why, FaultKind kind) {
  actuation::StopReport zero = plant_->stop(why, kind);
  if (temperatures_) temperatures_->take(zero);
  return zero;
}

void LiveSession::set_field_frequency(double frequency) {
  if (!kept_.turning.empty() && kept_.turning.back() == frequency) return;
  plant_->set_field_frequency(frequency);
  kept_.turning_at.push_back(steady_seconds() - plant_->start());
  kept_.turning.push_back(frequency);
}

std::string LiveSession::close() {
  const actuation::StopReport zero = stop("the run has ended");
  if (!kept_.empty()) {
    kept_.latency = rig_latency(plant_->timing());
    session_.rig_log() = std::exchange(kept_, {});
  }
  if (video_) video_->finish();
  return log_.finish(zero);
}

std::vector<std::string> LiveSession::take_notes() {
  std::vector<std::string> notes;
  if (currents_full_ && !std::exchange(told_currents_, true))
    notes.push_back(
        fmt::format("the record keeps {} values of the currents: later ones are in "
                    "commands.csv only",
                    options_.max_logged));
  if (kept_.seen_until && !std::exchange(told_sightings_, true))
    notes.push_back(
        fmt::format("the record keeps {} sightings: later ones are left out", options_.max_logged));
  for (std::string& note : coil_notes_.take(plant_->load().output, on_.rig.system))
    notes.push_back(std::move(note));
  for (std::string& note : plant_->take_notes()) notes.push_back(std::move(note));
  if (std::string low = look_at_disk(); !low.empty()) notes.push_back(std::move(low));
  return notes;
}

/// A line, once, if the disk will be full soon; empty otherwise.
std::string LiveSession::look_at_disk() {
  const experiment::Tick* const tick = session_.tick();
  if (options_.folder.empty() || told_space_ || !tick || tick->frame.t < disk_due_) return {};
  disk_due_ = tick->frame.t + disk_period;
  const std::optional<double> free = options_.free_space(options_.folder);
  const experiment::Scenario& scenario = session_.scenario();
  const double until = std::min(tick->frame.t + warned_before, longest_time(scenario, options_));
  const double soon = needed_space(on_.rig, scenario.tick, until, tick->frame.t);
  if (!free || *free >= soon) return {};
  told_space_ = true;
  return fmt::format(
      "{}: only {:.0f} MB are free on its disk, too little for the record of the next half hour",
      options_.folder.string(), *free / 1e6);
}

std::string LiveSession::fault() {
  std::string why(plant_->fault());
  const actuation::StopReport zero = stop("the run has ended");
  if (zero.good()) return why;
  if (!why.empty()) why += "; ";
  return why + "the coil driver " +
         (zero.confirmed ? zero.trouble : "did not confirm that the coils are at zero");
}

FaultKind LiveSession::fault_kind() {
  return stop("the run has ended").good() ? plant_->fault_kind() : FaultKind::device;
}

std::optional<vision::RecordedVideo> LiveSession::video() const {
  return video_ ? std::optional(video_->finish()) : std::nullopt;
}

LiveStatus LiveSession::status() const {
  const Detections& sight = plant_->detections();
  const RigTiming timing = plant_->timing();
  LiveStatus status{.not_found = sight.not_found,
                    .robots = static_cast<int>(sight.robots.size()),
                    .unseen = sight.unseen,
                    .coils = plant_->load(),
                    .frame_age = plant_->frame_age(),
                    .tick_p95 = timing.tick.quantile(0.95),
                    .missed_deadlines = timing.missed_deadlines};
  const experiment::Tick* const tick = session_.tick();
  if (!tick) return status;
  status.t = tick->frame.t;
  status.state = tick->frame.state;
  status.holding = tick->holding;
  status.goal_distance = tick->frame.goal_distance;
  status.command_speed = tick->frame.command.speed;
  status.radius = tick->frame.radius;
  status.gap = std::min(tick->frame.wall_clearance, tick->frame.obstacle_clearance) - status.radius;
  return status;
}

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/session/live_session.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <utility>

#include "microswarm/config/write.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/rig/runtime/coil_temperatures.hpp"
#include "microswarm/rig/runtime/command_log.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"

namespace microswarm {

namespace {

/// Disables the following check if no current is sent to the coils or a video plays.
RigExperiment without_following(RigExperiment on, bool dry) {
  if (dry || camera_kind(on.rig.params) == CameraKind::video)
    on.rig.params.safety.min_follow_share = 0;
  return on;
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
RigLog log_of(const Rig& rig, const std::string& note) {
  RigLog log;
  log.began = date_now();
  log.note = note;
  log.rig_file = to_yaml(rig.params);
  log.coils_file = read_file(rig.folder / rig.params.coils, 1 << 24);
  log.coils = rig.system.coil_names();
  return log;
}

RigLatency latency_of(const RigTiming& timing) {
  const Durations& times = timing.camera_to_current;
  return {.median = times.quantile(0.5),
          .p99 = times.quantile(0.99),
          .longest = times.longest(),
          .pictures = static_cast<int>(times.count()),
          .late_currents = timing.late_currents,
          .ticks = static_cast<int>(timing.tick.count()),
          .missed_deadlines = timing.missed_deadlines};
}

constexpr std::size_t max_logged = 10'000'000;  // values

}  // namespace

/// A live rig that owns its devices.
class LiveSession::LivePlant : public Plant {
 public:
  LivePlant(RigExperiment on, const LiveOptions& options)
      : on_(without_following(checked(std::move(on), options), options.dry)),
        devices_(open_devices(on_, options.dry, options.idle)),
        kept_(log_of(on_.rig, options.note)),
        log_(options.folder, on_.rig.system, options.dry),
        video_(recorder(options.video, devices_.camera_rate)),
        rig_(
            on_.scenario(), on_.experiment.world.map, on_.rig, std::move(devices_.camera),
            devices_.scale, devices_.driver(), [this](const CoilMoment& m) { take(m); },
            video_ ? video_->input() : FrameListener()) {
    if (video_) video_->begin(rig_.clock_zero());
    if (device_camera(on_.rig.params))
      require(check_camera(rig_.camera(), on_.rig, devices_.camera_rate, device_check));
    if (has_coil_device(on_.rig) && !options.dry) open_coils(options);
  }

  Observation observe() override {
    Observation observation = rig_.observe();
    keep_sight(observation.seen);
    return observation;
  }
  void apply(const Command& command, double dt) override { rig_.apply(command, dt); }
  bool set_obstacles(const std::vector<Obstacle>& obstacles) override {
    return rig_.set_obstacles(obstacles);
  }
  std::string_view fault() const override { return rig_.fault(); }

  LiveRig& rig() { return rig_; }
  const RigExperiment& on() const { return on_; }
  CommandLog& log() { return log_; }
  /// The log; to be used outside of the coils' thread only before the first command and after the
  /// stop.
  RigLog& kept() { return kept_; }
  VideoRecorder* video() { return video_.get(); }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  static constexpr double device_check = 0.3;  // [s]

  static RigExperiment checked(RigExperiment on, const LiveOptions& options) {
    Issues issues;
    if (const RigCheck field = check_field(on.rig); !field.good)
      issues.add({"field.amplitude_mt", "field"}, field.answer);
    if (has_coil_device(on.rig) && !options.dry && !options.without_limits)
      issues.add(missing_limits(on.rig));
    on.rig.keys.require_none(issues);
    return on;
  }

  static std::unique_ptr<VideoRecorder> recorder(const std::filesystem::path& file,
                                                 std::optional<double> rate) {
    constexpr double usual_rate = 30;  // [Hz]
    if (file.empty()) return nullptr;
    return std::make_unique<VideoRecorder>(file, rate.value_or(usual_rate));
  }

  void require(const std::vector<RigCheck>& checks) {
    for (const RigCheck& check : checks) {
      if (check.good) continue;
      const std::string line = check.what + ": " + check.answer;
      if (check.required) throw HardwareError(line);
      warnings_.push_back(line);
    }
  }

  void open_coils(const LiveOptions& options) {
    require(check_driver(devices_.driver(), on_.rig, device_check));
    temperatures_.emplace(on_.rig, options.coils_cold);
    rig_.warm(temperatures_->at_start());
    if (!temperatures_->known()) warnings_.push_back(temperatures_->why_hot());
  }

  /// Logs the detections of a new picture: the swarm and other bodies.
  void keep_sight(double t) {
    if (t <= seen_ || kept_.seen_at.size() >= max_logged) return;
    seen_ = t;
    const Detections& sight = rig_.sight();
    if (sight.swarm) kept_.see(t, -1, sight.swarm->pose.position, sight.swarm->radius);
    for (const Body& body : sight.moving) {
      const Disc extent = extent_of(body);
      kept_.see(t, body.obstacle, extent.centre, extent.radius);
    }
  }

  void take(const CoilMoment& moment) {
    log_.add(moment, rig_.start());
    if (kept_.currents.size() < max_logged) {
      kept_.driven_at.push_back(moment.t - rig_.start());
      kept_.answered_at.push_back(moment.driven - rig_.start());
      kept_.pictured_at.push_back(moment.seen - rig_.start());
      kept_.currents.insert(kept_.currents.end(), moment.output.acknowledged.begin(),
                            moment.output.acknowledged.end());
    }
    if (temperatures_) temperatures_->take(moment.output.temperatures);
  }

  RigExperiment on_;
  Devices devices_;
  RigLog kept_;  // currents are written by the coils' thread, the rest by the run's
  double seen_ = -1;
  CommandLog log_;
  std::unique_ptr<VideoRecorder> video_;
  std::vector<std::string> warnings_;
  std::optional<CoilTemperatures> temperatures_;
  LiveRig rig_;
};

LiveSession::LiveSession(const RigExperiment& on, const std::string& name,
                         std::unique_ptr<Plant> owned, LivePlant* plant)
    : Session(on.experiment, 0, std::move(owned), nullptr, name), plant_(plant) {}

std::unique_ptr<LiveSession> LiveSession::open(const RigExperiment& on,
                                               const LiveOptions& options) {
  auto plant = std::make_unique<LivePlant>(on, options);
  LivePlant* const live = plant.get();
  std::unique_ptr<LiveSession> session(new LiveSession(
      on, name_of(on.rig) + (options.dry ? ", dry run" : ""), std::move(plant), live));
  session->rig_log() = live->kept();
  return session;
}

const std::vector<std::string>& LiveSession::warnings() const { return plant_->warnings(); }

void LiveSession::stop(const std::string& why) { plant_->rig().stop(why); }

std::string LiveSession::close() {
  stop("the run has ended");
  if (RigLog& kept = plant_->kept(); !kept.empty()) {
    kept.latency = latency_of(timing());
    rig_log() = std::exchange(kept, {});
  }
  if (VideoRecorder* const video = plant_->video()) video->finish();
  return plant_->log().finish(plant_->rig().zero_at(), zero_is_confirmed());
}

std::string LiveSession::stop_trouble() const { return plant_->rig().stop_trouble(); }

bool LiveSession::zero_is_confirmed() const { return plant_->rig().zero_is_confirmed(); }

std::optional<RecordedVideo> LiveSession::video() const {
  VideoRecorder* const video = plant_->video();
  if (!video) return std::nullopt;
  return video->finish();
}

const Image& LiveSession::picture() const { return plant_->rig().picture(); }

const CameraScale& LiveSession::camera_scale() const { return plant_->rig().scale(); }

const Rig& LiveSession::rig() const { return plant_->on().rig; }

int LiveSession::resumed() const { return plant_->rig().resumed(); }

int LiveSession::weakened() const { return plant_->rig().weakened(); }

double LiveSession::weakened_to() const { return plant_->rig().weakened_to(); }

LiveStatus LiveSession::status() const {
  const LiveRig& rig = plant_->rig();
  const Detections& sight = rig.sight();
  const RigTiming timing = rig.timing();
  LiveStatus status{.trouble = sight.trouble,
                    .robots = static_cast<int>(sight.robots.size()),
                    .unseen = sight.unseen,
                    .coils = rig.load(),
                    .frame_age = rig.frame_age(),
                    .tick_p95 = timing.tick.quantile(0.95),
                    .missed_deadlines = timing.missed_deadlines};
  if (sight.swarm) status.trouble = {};
  const Tick* const tick = newest();
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

RigTiming LiveSession::timing() const { return plant_->rig().timing(); }

}  // namespace microswarm

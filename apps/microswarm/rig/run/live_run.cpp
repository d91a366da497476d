// SPDX-License-Identifier: Apache-2.0
#include "rig/run/live_run.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/vision/image/threads.hpp"
#include "rig/commissioner.hpp"
#include "rig/keys/rig_keys.hpp"
#include "rig/run/rig_operator.hpp"
#include "rig/run/rig_status.hpp"

namespace microswarm::cli {
namespace {

void tell(const rig::RigTiming& t) {
  print("  latency   p50 / p95 / p99\n");
  print("    age of a frame   {}\n", rig::quantiles(t.frame_age));
  print("    vision           {}\n", rig::quantiles(t.vision));
  print("    tick             {} (vision and navigator)\n", rig::quantiles(t.tick));
  print("    currents late    {}\n", rig::quantiles(t.coil_late));
  print("    camera to current {}, longest {:.1f} ms\n", rig::quantiles(t.camera_to_current),
        1e3 * t.camera_to_current.longest());
  print("    coil driver      {}\n", rig::quantiles(t.round_trip));
  print("  {} ticks, {} missed their deadline; {} frames read, {} dropped\n", t.tick.count(),
        t.missed_deadlines, t.frames, t.dropped_frames);
  if (t.late_currents > 0)
    print("  {} of {} frames had their currents more than a tick later\n", t.late_currents,
          t.camera_to_current.count());
  if (t.unseen_frames > 0)
    print("  the swarm or robots of it were unseen in {} of {} frames, at most {} of them\n",
          t.unseen_frames, t.frames, t.max_unseen);
  if (t.direction)
    print(
        "  the swarm moved {:.0f} % of the commanded distance, {:+.1f} ± {:.1f}° off its "
        "direction\n",
        100 * t.direction->share, degrees(t.direction->angle), degrees(t.direction->sd));
  if (t.resumed > 0) print("  the coils had switched off by themselves {} times\n", t.resumed);
}

void tell(const rig::PictureState& state, const Durations& looks) {
  print("  pictures: light {:.0f} to {:.0f} % of the start's, sharpness {}, map displaced by {}\n",
        100 * state.lowest_light, 100 * state.highest_light,
        state.focus ? fmt::format("{:.0f} % or more", 100 * state.lowest_focus) : "not known",
        state.shift_px ? fmt::format("at most {:.1f} px", state.largest_shift_px)
                       : "what is not known");
  print("    a look at the map {}\n", rig::quantiles(looks));
}

nlohmann::ordered_json picture_json(const rig::PictureState& state, const Durations& looks) {
  const auto optional = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  return {{"light", state.light},
          {"lowest_light", state.lowest_light},
          {"highest_light", state.highest_light},
          {"focus", optional(state.focus)},
          {"lowest_focus", state.lowest_focus},
          {"shift_px", optional(state.shift_px)},
          {"largest_shift_px", state.largest_shift_px},
          {"frames_without_swarm", state.unseen},
          {"largest_unseen_share", state.highest_unseen_share},
          {"follow_share", optional(state.follow_share)},
          {"look_p50_ms", 1e3 * looks.quantile(0.5)},
          {"look_longest_ms", 1e3 * looks.longest()}};
}

nlohmann::ordered_json timing_json(const rig::RigTiming& t,
                                   const std::optional<vision::RecordedVideo>& video) {
  const auto ms = [](const Durations& d) {
    return nlohmann::ordered_json{{"p50_ms", 1e3 * d.quantile(0.5)},
                                  {"p95_ms", 1e3 * d.quantile(0.95)},
                                  {"p99_ms", 1e3 * d.quantile(0.99)},
                                  {"longest_ms", 1e3 * d.longest()}};
  };
  nlohmann::ordered_json json{{"frame_age", ms(t.frame_age)},
                              {"vision", ms(t.vision)},
                              {"tick", ms(t.tick)},
                              {"camera_to_current", ms(t.camera_to_current)},
                              {"currents_late", ms(t.coil_late)},
                              {"coil_driver", ms(t.round_trip)},
                              {"ticks", t.tick.count()},
                              {"missed_deadlines", t.missed_deadlines},
                              {"late_currents", t.late_currents},
                              {"frames_read", t.frames},
                              {"frames_dropped", t.dropped_frames},
                              {"frame_gaps", t.frame_gaps},
                              {"frames_with_unseen_robots", t.unseen_frames},
                              {"max_unseen_robots", t.max_unseen},
                              {"fields_not_made", t.unmade},
                              {"fields_weakened", t.limited},
                              {"least_field_share", t.min_scale},
                              {"coils_resumed", t.resumed},
                              {"currents_weakened", t.scaled},
                              {"least_current_share", t.min_device_scale}};
  if (t.direction)
    json["direction"] = {{"angle_deg", degrees(t.direction->angle)},
                         {"sd_deg", degrees(t.direction->sd)},
                         {"share", t.direction->share}};
  if (video)
    json["video"] = {{"file", video->file.string()},
                     {"frames", video->frames},
                     {"frames_dropped", video->dropped}};
  return json;
}

/// Warns on stderr if the connection or the computer is too slow for the field.
void note_pace(const rig::RigTiming& t, const rig::RigParams& rig) {
  const double rate = t.sent_rate();
  if (t.sent_for < 1 || rate >= 0.8 * rig.drive_rate) return;
  note(
      "note: currents were sent {:.0f} times a second, drive_rate_hz is {:.6g}; the field "
      "turns {:.6g} times a second\n",
      rate, rig.drive_rate, rig.field.frequency);
}

/// Warns on stderr if the swarm moves in another direction than commanded.
void note_direction(const rig::RigTiming& t) {
  constexpr double turned = 8 * pi / 180;  // smaller angles are corrected by the navigator
  constexpr double certain = 3;            // standard deviations
  if (!t.direction || std::abs(t.direction->angle) < turned ||
      std::abs(t.direction->angle) < certain * t.direction->sd)
    return;
  note(
      "note: the swarm moves {:.0f} ± {:.0f}° {} of its commands: is the camera turned against the "
      "coils (scale.rotation_deg)?\n",
      std::abs(degrees(t.direction->angle)), degrees(t.direction->sd),
      t.direction->angle > 0 ? "left" : "right");
}

/// Warns on stderr if the limits of the coils or of the device weakened the field.
void note_limits(const rig::RigTiming& t) {
  if (t.unmade > 0)
    note(
        "note: these coils cannot make the field in {} of {} outputs, see `microswarm rig "
        "check`\n",
        t.unmade, t.round_trip.count());
  if (t.limited > 0)
    note(
        "note: the coils' limits weakened the field in {} of {} outputs, to a minimum of {:.0f} "
        "%\n",
        t.limited, t.round_trip.count(), 100 * t.min_scale);
  if (t.scaled > 0)
    note("note: the device weakened the currents in {} of {} outputs, to a minimum of {:.3g} %\n",
         t.scaled, t.round_trip.count(), 100 * t.min_device_scale);
}

/// Reports during the run that the coils had switched off by themselves or that the device weakens
/// their currents; the latter once as long as it lasts or soon recurs.
class DeviceNotes : public experiment::RunListener {
 public:
  explicit DeviceNotes(const rig::LiveRig& rig) : rig_(rig) {}
  void on_tick(const experiment::Tick& tick) override {
    const rig::DeviceEvents device = rig_.device_events();
    if (device.resumed > resumed_)
      note("note: the coils had switched off by themselves; armed again\n");
    resumed_ = device.resumed;
    if (device.scaled == weakened_) return;
    weakened_ = device.scaled;
    if (tick.frame.t - weakened_at_ > quiet)
      note("note: the device weakens the currents to {:.3g} % by its own limits\n",
           100 * device.scale);
    weakened_at_ = tick.frame.t;
  }

 private:
  static constexpr double quiet = 10;  // [s] without weakening, after which it is reported again

  const rig::LiveRig& rig_;
  int resumed_ = 0;
  int weakened_ = 0;
  double weakened_at_ = -infinity;  // [s]
};

void tell(const vision::RecordedVideo& video) {
  print("  video: {} frames in {}, {} dropped\n", video.frames, video.file.string(), video.dropped);
}

void note_virtual_obstacles(const rig::RigExperiment& on) {
  const std::size_t count = on.scenario().obstacles.size();
  if (count == 0 || rig::camera_kind(on.rig.params) == rig::CameraKind::simulated) return;
  if (on.rig.params.virtual_obstacles)
    note("note: {} obstacles of the scenario are virtual: avoided and recorded\n", count);
  else
    note("note: {} obstacles of the scenario count only where the camera sees them\n", count);
}

/// Keeps the highest temperature of the coil that is nearest to its limit.
class HottestCoil : public experiment::RunListener {
 public:
  explicit HottestCoil(const rig::LiveRig& rig) : rig_(rig) {}
  void on_tick(const experiment::Tick&) override {
    const rig::CoilLoad load = rig_.load();
    if (load.output.temperatures.size() > 0)
      temperature_ = std::max(temperature_.value_or(load.temperature), load.temperature);
  }
  /// [°C]; nothing before the first output.
  std::optional<double> temperature() const { return temperature_; }

 private:
  const rig::LiveRig& rig_;
  std::optional<double> temperature_;
};

/// Steps a session to its end with a status line.
void drive(rig::LiveSession& live, const Stop& stop) {
  experiment::Session& session = live.session();
  DeviceNotes notes(live.live());
  session.listen(notes);
  note_oddities(session);
  RigStatusLine status(live);
  bool began = false;
  while (session.step(stop)) {
    if (!std::exchange(began, true)) note_regions(session);
    note_each(live.take_notes());
    status.update();
  }
}

/// Runs a session to its end, operated by keys; `failed` gets an exception's reason when the coils
/// are at zero. Returns which data was lost, see LiveSession::close().
std::string operate(rig::LiveSession& session, bool drives_coils, std::optional<double> seconds,
                    const LiveRunOptions& o, const Context& context) {
  RigOperator person(session);
  const RigKeys keys([&] { session.stop("the emergency key was pressed"); },
                     [&](const Key& key) { person.press(key); }, context.stop);
  if (keys.are_there() || drives_coils) note_how_to_stop(keys.are_there(), RigOperator::keys);
  try {
    drive(session, seconds ? context.within(*seconds) : context.stop);
  } catch (const std::exception& error) {
    session.stop(error.what());
    o.ended(error.what());
    o.failed(error.what());
    throw;
  }
  const std::string why = session.fault();
  o.ended(why.empty() ? std::string(to_string(session.session().result().status)) : why);
  return session.close();
}

}  // namespace

LiveRunEnd run_live(const rig::RigExperiment& on, const LiveRunOptions& o, const Context& context) {
  vision::set_picture_threads(1);
  rig::LiveSession live(on, o.live);
  experiment::Session& session = live.session();
  note_each(live.warnings());
  note_virtual_obstacles(on);
  if (o.live.dry) note("dry run: no current is sent to the coils\n");
  const std::string folder = o.live.folder.string();
  const auto growing = grow_record(session, folder);
  HottestCoil hottest(live.live());
  session.listen(hottest);
  std::string lost =
      operate(live, rig::has_coil_device(on.rig) && !o.live.dry, o.live.seconds, o, context);
  LiveRunEnd end{.fault = live.fault(), .kind = live.fault_kind()};
  if (!end.fault.empty()) o.failed(end.fault);
  const std::optional<vision::RecordedVideo> video = live.video();
  const rig::RigTiming timing = live.live().timing();
  if (!lost.empty()) note("microswarm: {}\n", lost);
  if (video && !video->trouble.empty()) note("microswarm: {}\n", lost = video->trouble);
  const bool at_zero = note_zero(live.stop("the run has ended"));
  note_limits(timing);
  note_direction(timing);
  note_each(live.take_notes());
  const rig::PictureState pictures = live.live().picture_state();
  const Durations looks = live.live().look_times();
  const auto json = [&] {
    nlohmann::ordered_json timing_of_run = timing_json(timing, video);
    timing_of_run["pictures"] = picture_json(pictures, looks);
    return timing_of_run;
  };
  end.code = tell_run(session,
                      {.out = folder,
                       .json = o.json,
                       .rig_timing = json,
                       .commissioning = [&] { return commissioning_json(live.commissioning()); },
                       .print = o.print},
                      {});
  note_pace(timing, on.rig.params);
  if (!o.json) tell(timing);
  if (!o.json) tell(pictures, looks);
  if (!o.json && video && video->trouble.empty()) tell(*video);
  if (!at_zero)
    end.code = hardware;
  else if (end.code == ok)
    end.code = lost.empty() ? complete : bad_input;
  end.status = session.result().status;
  end.ending = ending(session.result());
  if (session.tick()) end.t = session.tick()->frame.t;
  end.max_temperature = hottest.temperature();
  end.lost = std::move(lost);
  return end;
}

}  // namespace microswarm::cli

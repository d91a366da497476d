// SPDX-License-Identifier: Apache-2.0
// `rig run` runs a scenario on a rig in real time.
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/run_output.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/rig/runtime/rig_checks.hpp"
#include "microswarm/rig/session/fault_command.hpp"
#include "microswarm/rig/session/live_session.hpp"
#include "microswarm/vision/image/threads.hpp"
#include "rig/commissioner.hpp"
#include "rig/keys/rig_keys.hpp"
#include "rig/real_coils.hpp"
#include "rig/rig.hpp"
#include "rig/rig_notes.hpp"
#include "rig/rig_settings.hpp"
#include "rig/run/rig_operator.hpp"
#include "rig/run/rig_status.hpp"
#include "support/service_manager.hpp"

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
    print("  robots were unseen in {} frames, at most {} of them\n", t.unseen_frames, t.max_unseen);
  if (t.direction)
    print(
        "  the swarm moved {:.0f} % of the commanded distance, {:+.1f} ± {:.1f}° off its "
        "direction\n",
        100 * t.direction->share, degrees(t.direction->angle), degrees(t.direction->sd));
  if (t.resumed > 0) print("  the coils had switched off by themselves {} times\n", t.resumed);
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

/// Throws InputError if the folder has an experiment, even a killed one, or the video exists.
void require_new(const std::filesystem::path& folder, const std::filesystem::path& video) {
  std::vector<std::filesystem::path> files;
  if (!folder.empty())
    for (const char* name : {"run.h5", "run.part.h5", "commands.csv", "commands.csv.part"})
      files.push_back(folder / name);
  if (!video.empty()) files.insert(files.end(), {video, vision::VideoRecorder::times_file(video)});
  for (const std::filesystem::path& file : files)
    if (std::error_code none; std::filesystem::exists(file, none))
      throw InputError(file.string(),
                       "is there from another experiment: choose another name, "
                       "or run with --overwrite");
}

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

struct RigRunOptions {
  std::string scenario;
  std::string rig;
  std::string out;
  std::string video;
  std::vector<std::string> settings;
  std::vector<std::string> rig_settings;
  std::optional<double> seconds;
  std::optional<double> hold;
  std::string note;
  bool dry_run = false;
  bool drawn_swarm = false;
  CoilOptions coils;
  bool overwrite = false;
  bool json = false;
};

/// Throws InputError unless driving the coils is intended and somebody can stop them.
void require_person(const rig::Rig& rig, const RigRunOptions& o) {
  if (o.dry_run || !rig::has_coil_device(rig)) return;
  require_emergency_stop(o.coils);
  if (rig::shows_drawn_swarm(rig.params) && !o.drawn_swarm)
    throw rig.keys.error("camera",
                         "the camera is simulated and the coil driver is not: real coils would be "
                         "driven for a drawn swarm; for a test, run with --drawn-swarm");
}

/// Runs a session to its end, operated by keys; `failed` gets an exception's reason when the coils
/// are at zero. Returns which data was lost, see LiveSession::close().
std::string operate(rig::LiveSession& session, bool drives_coils, std::optional<double> seconds,
                    const std::function<void(const std::string&)>& failed, ServiceManager& service,
                    const Context& context) {
  RigOperator person(session);
  const RigKeys keys([&] { session.stop("the emergency key was pressed"); },
                     [&](const Key& key) { person.press(key); }, context.stop);
  if (keys.are_there() || drives_coils) note_how_to_stop(keys.are_there(), RigOperator::keys);
  try {
    drive(session, seconds ? context.within(*seconds) : context.stop);
  } catch (const std::exception& error) {
    session.stop(error.what());
    service.stopping(error.what());
    failed(error.what());
    throw;
  }
  const std::string why = session.fault();
  service.stopping(why.empty() ? to_string(session.session().result().status)
                               : std::string_view(why));
  return session.close();
}

int rig_run(const RigRunOptions& o, const Context& context) {
  std::vector<std::string> settings = o.settings;
  if (o.hold) settings.push_back("hold_at_goal_s=" + number_text(*o.hold));
  const rig::RigExperiment on = reading([&] {
    return rig::open_rig_experiment(o.scenario, {settings, "--set"}, o.rig,
                                    {o.rig_settings, "--set-rig"});
  });
  note_each(on.experiment.keys.notes());
  note_field(on.rig, on.scenario());
  require_person(on.rig, o);
  if (!o.overwrite) require_new(o.out, o.video);
  const OutFolder hold(o.out);
  vision::set_picture_threads(1);
  rig::FaultCommand command([](const std::string& failed) { note("note: {}\n", failed); });
  const auto tell_fault = [&](const std::string& why) {
    if (!o.dry_run) command.start(on.rig, why, o.out);
  };
  ServiceManager service;
  rig::LiveSession live(on, {.dry = o.dry_run,
                             .folder = o.out,
                             .video = o.video,
                             .without_limits = o.coils.without_limits,
                             .coils_cold = o.coils.coils_cold,
                             .note = o.note,
                             .seconds = o.seconds,
                             .driven = [&] {
                               service.ready();
                               service.drive();
                             }});
  experiment::Session& session = live.session();
  note_each(live.warnings());
  note_virtual_obstacles(on);
  if (o.dry_run) note("dry run: no current is sent to the coils\n");
  const auto growing = grow_record(session, o.out);
  std::string lost = operate(live, rig::has_coil_device(on.rig) && !o.dry_run, o.seconds,
                             tell_fault, service, context);
  if (const std::string why = live.fault(); !why.empty()) tell_fault(why);
  const std::optional<vision::RecordedVideo> video = live.video();
  const rig::RigTiming timing = live.live().timing();
  if (!lost.empty()) note("microswarm: {}\n", lost);
  if (video && !video->trouble.empty()) note("microswarm: {}\n", lost = video->trouble);
  const bool at_zero = note_zero(live.stop("the run has ended"));
  note_limits(timing);
  note_direction(timing);
  const int code = tell_run(session,
                            {o.out, false, o.json, [&] { return timing_json(timing, video); },
                             [&] { return commissioning_json(live.commissioning()); }},
                            {});
  note_pace(timing, on.rig.params);
  if (!o.json) tell(timing);
  if (!o.json && video && video->trouble.empty()) tell(*video);
  if (!at_zero) return hardware;
  if (code == ok) return lost.empty() ? complete : bad_input;
  return code;
}

}  // namespace

void add_rig_run(Command rig, Action& action) {
  auto o = std::make_shared<RigRunOptions>();
  Command cmd = rig.add_command(
      "run", "Run a scenario on a rig, in real time",
      "rig run scenarios/first_rig.yaml --rig scenarios/rigs/vortex.yaml --dry-run --out out/rig");
  cmd.add_option("scenario", o->scenario, "Scenario file (YAML)")
      .required()
      .type_name("FILE")
      .input("papers");
  cmd.add_option("--rig", o->rig, "Rig file (YAML)").required().type_name("FILE").input("rigs");
  cmd.add_option("--out", o->out, "Folder for run.h5, commands.csv and the report")
      .type_name("FOLDER");
  cmd.add_option("--video", o->video,
                 "Record the camera without loss to this file (.mkv, .avi), and the frames' times "
                 "beside it (CSV)")
      .type_name("FILE")
      .check(file_kind({".mkv", ".avi"}));
  cmd.add_flag("--dry-run", o->dry_run, "Send nothing to the coils");
  cmd.add_flag("--drawn-swarm", o->drawn_swarm, "Drive coils for a simulated camera's swarm");
  add_coil_options(cmd, o->coils);
  cmd.add_flag("--overwrite", o->overwrite, "Replace the experiment in the folder, or the video");
  add_settings(cmd, o->settings, "Override a scenario value", type_of<experiment::Scenario>);
  add_rig_settings(cmd, "--set-rig", o->rig_settings);
  cmd.add_option("--seconds", o->seconds, "Duration after the first command")
      .type_name("SECONDS")
      .check(number(0.1, 1e6));
  cmd.add_option("--hold", o->hold, "Hold the swarm at the goal for this time, or until stopped")
      .type_name("SECONDS")
      .check(number(0, 1e6));
  cmd.add_option("--note", o->note, "Note of the operator, kept in the record").type_name("TEXT");
  add_json(cmd, o->json);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return rig_run(*o, context); }; });
}

}  // namespace microswarm::cli

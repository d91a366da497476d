// SPDX-License-Identifier: Apache-2.0
// `rig run`: a scenario on a rig, in real time.
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "commands/run_output.hpp"
#include "microswarm/session/live_session.hpp"
#include "microswarm/vision/image/threads.hpp"
#include "rig/rig.hpp"
#include "rig/rig_notes.hpp"

namespace microswarm::cli {
namespace {

/// Calls `stop` when a key is pressed, if the program has a terminal. The terminal settings are
/// restored when the program is asked to end.
class EmergencyKey {
 public:
  EmergencyKey(std::function<void()> stop, const Stop& ended)
      : stop_(std::move(stop)), ended_(ended) {
    if (::isatty(STDIN_FILENO) == 0 || ::tcgetpgrp(STDIN_FILENO) != ::getpgrp()) return;
    if (::tcgetattr(STDIN_FILENO, &before_) != 0) return;
    thread_ = std::thread([this] { listen(); });
  }
  ~EmergencyKey() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
  }
  EmergencyKey(const EmergencyKey&) = delete;
  EmergencyKey& operator=(const EmergencyKey&) = delete;
  bool is_there() const { return thread_.joinable(); }

 private:
  void listen() {
    termios keys = before_;
    keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    while (!over_ && !ended_.requested()) {
      // Repeated, because a shell resets the terminal when the program is suspended and resumed.
      if (::tcgetpgrp(STDIN_FILENO) == ::getpgrp()) ::tcsetattr(STDIN_FILENO, TCSANOW, &keys);
      pollfd in{STDIN_FILENO, POLLIN, 0};
      if (::poll(&in, 1, 20) <= 0) continue;
      char key = 0;
      if (::read(STDIN_FILENO, &key, 1) != 1) break;
      if (key == ' ' || key == 'e' || key == 'E' || key == '\x1b') stop_();
    }
    if (::tcgetpgrp(STDIN_FILENO) == ::getpgrp()) ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }

  std::function<void()> stop_;
  Stop ended_;
  termios before_{};
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

void tell(const RigTiming& t) {
  print("  latency   p50 / p95 / p99\n");
  print("    age of a frame   {}\n", quantiles(t.frame_age));
  print("    vision           {}\n", quantiles(t.vision));
  print("    tick             {} (vision and navigator)\n", quantiles(t.tick));
  print("    currents late    {}\n", quantiles(t.coil_late));
  print("    coil driver      {}\n", quantiles(t.round_trip));
  print("  {} ticks, {} missed their deadline; {} frames read, {} dropped\n", t.tick.count(),
        t.missed_deadlines, t.frames, t.dropped_frames);
  if (t.unseen_frames > 0)
    print("  robots were unseen in {} frames, at most {} of them\n", t.unseen_frames,
          t.most_unseen);
  if (t.resumed > 0) print("  the coils had been off by themselves {} times\n", t.resumed);
  if (t.scaled > 0) print("  the device weakened the currents {} times\n", t.scaled);
}

nlohmann::ordered_json timing_json(const RigTiming& t) {
  const auto ms = [](const Durations& d) {
    return nlohmann::ordered_json{{"p50_ms", 1e3 * d.quantile(0.5)},
                                  {"p95_ms", 1e3 * d.quantile(0.95)},
                                  {"p99_ms", 1e3 * d.quantile(0.99)}};
  };
  return {{"frame_age", ms(t.frame_age)},
          {"vision", ms(t.vision)},
          {"tick", ms(t.tick)},
          {"currents_late", ms(t.coil_late)},
          {"coil_driver", ms(t.round_trip)},
          {"ticks", t.tick.count()},
          {"missed_deadlines", t.missed_deadlines},
          {"frames_read", t.frames},
          {"frames_dropped", t.dropped_frames},
          {"frames_with_unseen_robots", t.unseen_frames},
          {"max_unseen_robots", t.most_unseen},
          {"fields_not_made", t.unmade},
          {"fields_weakened", t.limited},
          {"least_field_share", t.min_scale},
          {"coils_resumed", t.resumed},
          {"currents_weakened", t.scaled}};
}

/// Notes on stderr if the connection or the computer is too slow for the field.
void note_pace(const RigTiming& t, double seconds, const RigParams& rig) {
  const double rate = static_cast<double>(t.round_trip.count()) / std::max(seconds, 1e-3);
  if (seconds < 1 || rate >= 0.8 * rig.drive_rate) return;
  note(
      "note: currents were sent {:.0f} times a second, drive_rate_hz is {:.6g}; the field "
      "turns {:.6g} times a second\n",
      rate, rig.drive_rate, rig.field.frequency);
}

/// Notes on stderr if the coils' limits weakened the field.
void note_limits(const RigTiming& t) {
  if (t.unmade > 0)
    note(
        "note: these coils cannot make the field in {} of {} sendings, see `microswarm rig "
        "check`\n",
        t.unmade, t.round_trip.count());
  if (t.limited > 0)
    note("note: the coils' limits weakened the field in {} of {} sendings, to {:.0f} % at least\n",
         t.limited, t.round_trip.count(), 100 * t.min_scale);
}

/// Says it as it happens when the coils had been off by themselves.
class TripNotes : public RunListener {
 public:
  explicit TripNotes(const LiveSession& session) : session_(session) {}
  void on_tick(const Tick&) override {
    const int resumed = session_.resumed();
    if (resumed > resumed_) note("\nnote: the coils had been off by themselves; armed again\n");
    resumed_ = resumed;
  }

 private:
  const LiveSession& session_;
  int resumed_ = 0;
};

struct RigRunOptions {
  std::string scenario;
  std::string rig;
  std::string out;
  std::vector<std::string> settings;
  std::vector<std::string> rig_settings;
  std::optional<double> seconds;
  bool dry_run = false;
  bool json = false;
};

int rig_run(const RigRunOptions& o, const Context& context) {
  const RigExperiment on = open_rig_experiment(o.scenario, o.settings, o.rig, o.rig_settings);
  note_each(on.experiment.keys.notes());
  note_field(on.rig, on.scenario());
  const OutFolder hold(o.out);
  set_picture_threads(1);
  const auto opened = LiveSession::open(on, o.dry_run, o.out);
  LiveSession& session = *opened;
  if (o.dry_run) note("dry run: nothing goes to the coils\n");
  const EmergencyKey key([&] { session.stop("the emergency key was pressed"); }, context.stop);
  if (key.is_there()) note("space, e or Esc: coils to zero at once\n");
  TripNotes trips(session);
  session.listen(trips);
  finish_run(session, o.seconds ? context.within(*o.seconds) : context.stop, o.seconds);
  const std::string log_lost = session.close();
  const RigTiming timing = session.timing();
  if (!log_lost.empty()) note("microswarm: {}\n", log_lost);
  if (!session.zero_is_confirmed())
    note(
        "note: the coil driver did not confirm that the coils are at zero; its own watchdog must "
        "do "
        "it\n");
  note_limits(timing);
  const int code =
      tell_run(session, {o.out, false, o.json, [&] { return timing_json(timing); }}, {});
  note_pace(timing, session.result().metrics.time, on.rig.params);
  if (!o.json) tell(timing);
  return code == ok && !log_lost.empty() ? bad_input : code;
}

}  // namespace

void add_rig_run(Command rig, Action& action) {
  auto o = std::make_shared<RigRunOptions>();
  Command cmd = rig.add_command("run", "Run a scenario on a rig, in real time",
                                "rig run scenario.yaml --rig rig.yaml --dry-run --out out/rig");
  cmd.add_option("scenario", o->scenario, "Scenario file (YAML)").required().type_name("FILE");
  cmd.add_option("--rig", o->rig, "Rig file (YAML)").required().type_name("FILE");
  cmd.add_option("--out", o->out, "Folder for run.h5, commands.csv and the report")
      .type_name("FOLDER");
  cmd.add_flag("--dry-run", o->dry_run, "Send nothing to the coils");
  add_settings(cmd, o->settings, "Override a scenario value (repeatable)");
  cmd.add_option("--set-rig", o->rig_settings, "Override a rig value (repeatable)")
      .type_name("KEY=VALUE");
  cmd.add_option("--seconds", o->seconds, "End after this time")
      .type_name("S")
      .check(number(0.1, 1e6));
  add_json(cmd, o->json);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return rig_run(*o, context); }; });
}

}  // namespace microswarm::cli

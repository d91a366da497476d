// SPDX-License-Identifier: Apache-2.0
// `rig queue` runs scenarios on a rig one after the other, without a person.
#include <fmt/chrono.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <memory>

#include "microswarm/config/write.hpp"
#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/rig/queue/run_queue.hpp"
#include "microswarm/rig/runtime/disk_space.hpp"
#include "microswarm/rig/runtime/rig_priority.hpp"
#include "microswarm/rig/session/fault_command.hpp"
#include "rig/queue/queue_progress.hpp"
#include "rig/real_coils.hpp"
#include "rig/rig.hpp"
#include "rig/rig_settings.hpp"
#include "rig/run/live_run.hpp"
#include "support/service_manager.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

struct RigQueueOptions {
  std::string queue;
  std::string rig;
  std::string out;
  std::string status;
  std::vector<std::string> rig_settings;
  std::string note;
  bool dry_run = false;
  bool drawn_swarm = false;
  bool failed_again = false;
  CoilOptions coils;
  bool json = false;

  Settings settings() const { return {rig_settings, "--set-rig"}; }
};

double wall_seconds() {
  using Clock = std::chrono::system_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// The runs of a queue in this process.
class QueueRuns {
 public:
  QueueRuns(const RigQueueOptions& o, const rig::Rig& rig, QueueProgress& progress,
            ServiceManager& service, const Context& context)
      : o_(o),
        rig_hash_(rig::rig_hash(rig)),
        progress_(progress),
        service_(service),
        context_(context) {}

  rig::AttemptResult run(const rig::QueueItem& item, const fs::path& folder) {
    progress_.begin_run();
    ended_ = false;
    try {
      return drive(item, folder);
    } catch (const HardwareError& error) {
      return failed(rig::FaultKind::device, error.what());
    } catch (const WriteError& error) {
      return failed(rig::FaultKind::disk, error.what());
    } catch (const InputError& error) {
      // Before the end it says why the run was refused, after it what the program cannot do.
      if (ended_) return failed(rig::FaultKind::computer, error.what());
      return {.end = rig::AttemptEnd::refused, .reason = error.what()};
    } catch (const std::exception& error) {
      return failed(rig::FaultKind::device, error.what());
    }
  }

 private:
  static rig::AttemptResult failed(rig::FaultKind kind, const std::string& why) {
    return {.end = rig::AttemptEnd::fault, .fault = kind, .reason = why};
  }

  /// Why the rig is no longer that of the queue's start, which all scenarios were opened with.
  std::string changed_rig() const {
    const std::string look = "look at the rig, and start the queue again";
    try {
      if (rig::rig_hash(rig::read_rig(o_.rig, o_.settings())) == rig_hash_) return {};
    } catch (const InputError& error) {
      return fmt::format("the rig's file has changed since the queue began: {}: {}", error.what(),
                         look);
    }
    return fmt::format("{} or its coils have changed since the queue began: {}", o_.rig, look);
  }

  rig::AttemptResult drive(const rig::QueueItem& item, const fs::path& folder) {
    if (const std::string why = changed_rig(); !why.empty())
      return failed(rig::FaultKind::person, why);
    const rig::RigExperiment on = rig::open_item(item, o_.rig, o_.settings());
    if (on.experiment.scene.hash() != item.hash)
      throw InputError(item.scenario.string(), "has changed since the queue began");
    const OutFolder hold(folder.string());
    std::string result;
    const LiveRunEnd end =
        run_live(on,
                 {.live = {.dry = o_.dry_run,
                           .folder = folder,
                           .video = item.video ? folder / "camera.mkv" : fs::path(),
                           .without_limits = o_.coils.without_limits,
                           .note = o_.note,
                           .seconds = item.time_budget,
                           .driven = [this] { service_.drive(); }},
                  .json = true,
                  .print = [&](std::string_view text) { result += text; },
                  .ended =
                      [this](const std::string& why) {
                        ended_ = true;
                        service_.rest(why);
                        progress_.begin_run();
                      }},
                 context_);
    write_file_atomically(folder / "result.json", result);
    rig::AttemptResult attempt{.status = end.ending, .max_temperature = end.max_temperature};
    if (!end.fault.empty()) {
      attempt.end = rig::AttemptEnd::fault;
      attempt.status.clear();
      attempt.fault = end.kind;
      attempt.reason = end.fault;
    } else if (!end.lost.empty()) {
      attempt.end = rig::AttemptEnd::fault;
      attempt.fault = rig::FaultKind::disk;
      attempt.reason = end.lost;
    } else if (end.status == Status::stopped && context_.stop.requested()) {
      attempt.end = rig::AttemptEnd::stopped;
    } else if (end.status == Status::stopped) {
      attempt.status = end.t < item.time_budget ? "ended by a key" : "time budget";
    }
    return attempt;
  }

  const RigQueueOptions& o_;
  const std::string rig_hash_;  // at the queue's start
  QueueProgress& progress_;
  ServiceManager& service_;
  const Context& context_;
  bool ended_ = false;
};

int show_status(const RigQueueOptions& o) {
  const rig::QueueState state = rig::show_queue_state(o.status);
  put(o.json ? to_json_text(state) + "\n" : queue_table(state));
  return ok;
}

/// Makes the temperatures of the coils known, of which a queue that begins may say that they are
/// cold.
void know_temperatures(const rig::Rig& rig, const RigQueueOptions& o, bool begins) {
  if (!begins && o.coils.coils_cold)
    note("note: --coils-cold counts where a queue begins: this one goes on\n");
  const rig::CoilTemperatures known(rig, begins && o.coils.coils_cold);
  if (!known.known()) note_each({known.why_hot()});
}

/// Items that have failed are to be run again.
void reopen_failed(const fs::path& folder) {
  auto state = rig::read_queue_state(folder);
  if (!state) return;
  for (rig::ItemStatus& item : state->items) {
    if (item.state != rig::ItemState::failed) continue;
    item.state = rig::ItemState::waiting;
    item.forgiven = item.attempts.size();
  }
  rig::write_queue_state(folder, *state);
}

int rig_queue(const RigQueueOptions& o, const Context& context) {
  if (!o.status.empty()) return show_status(o);
  if (o.queue.empty()) throw InputError("a queue is missing: a folder of scenarios, or a file");
  if (o.rig.empty()) throw InputError("--rig is missing");
  if (o.out.empty()) throw InputError("--out is missing: the folder for records and state");
  const rig::Queue queue = reading([&] { return rig::open_queue(o.queue, o.rig, o.settings()); });
  const rig::Rig rig = rig::read_rig(o.rig, o.settings());
  require_person(rig, o.coils, o.dry_run, o.drawn_swarm);
  const bool drives = rig::has_coil_device(rig) && !o.dry_run;
  if (drives && !o.coils.without_limits) rig.keys.require_none(rig::missing_limits(rig));
  const OutFolder hold(o.out);
  if (o.failed_again) reopen_failed(o.out);
  if (drives) know_temperatures(rig, o, !fs::exists(rig::queue_state_file(o.out)));
  rig::FaultCommand command([](const std::string& failed) { note("note: {}\n", failed); });
  ServiceManager service;
  service.ready();
  rig::QueueEnd end{};
  {
    const rig::RigPriority is_permitted(rig);  // else refused now, rather than run by run
  }
  {
    QueueProgress progress(service, context);
    QueueRuns runs(o, rig, progress, service, context);
    const rig::QueueHost host{
        .run = [&](const auto& item, const auto& folder) { return runs.run(item, folder); },
        .temperatures =
            [&] { return drives ? std::optional(rig::kept_temperatures(rig)) : std::nullopt; },
        .wall = wall_seconds,
        .clock = [] { return rig::read_clocks().uptime; },
        .wait = [&](double seconds) { progress.wait(seconds); },
        .stops = [&] { return progress.stops(); },
        .halts = [&] { return progress.halts(); },
        .free_space = rig::free_space,
        .tell =
            [](const std::string& line) {
              note("{:%H:%M:%S} {}\n", fmt::localtime(std::time(nullptr)), line);
            },
        .doing = [&](const std::string& doing) { progress.show(doing); },
        .alarm =
            [&](const std::string& why, const fs::path& record) {
              if (!o.dry_run) command.start(rig, why, record);
            }};
    rig::read_queue_state(o.out);  // a damaged one is bad input, one that cannot be written is not
    try {
      end = rig::run_queue(queue, rig, o.rig, o.out, host);
    } catch (const InputError& error) {
      note("microswarm: {}; the queue has stopped\n", error.what());
      host.alarm(std::string(error.what()) + "; the queue has stopped", {});
      end = rig::QueueEnd::needs_person;
    }
    service.stopping("the queue has ended");
  }
  const rig::QueueState state = rig::show_queue_state(o.out);
  put(o.json ? to_json_text(state) + "\n" : queue_table(state));
  switch (end) {
    case rig::QueueEnd::complete:
      return complete;
    case rig::QueueEnd::incomplete:
    case rig::QueueEnd::stopped:
      return not_reached;
    case rig::QueueEnd::needs_person:
      return hardware;
  }
  return failed;
}

}  // namespace

void add_rig_queue(Command rig, Action& action) {
  auto o = std::make_shared<RigQueueOptions>();
  Command cmd = rig.add_command(
      "queue", "Run scenarios on a rig one after the other, with cool-downs between them",
      "rig queue scenarios/queues/night.yaml --rig scenarios/rigs/vortex.yaml --out out/night");
  cmd.add_option("queue", o->queue, "Queue file (YAML), or a folder of scenarios")
      .type_name("FILE")
      .input("queues");
  cmd.add_option("--rig", o->rig, "Rig file (YAML)").type_name("FILE").input("rigs");
  cmd.add_option("--out", o->out, "Folder for records, state and summary.csv; it goes on there")
      .type_name("FOLDER");
  Option status =
      cmd.add_option("--status", o->status, "Print the state of the queue in this folder")
          .type_name("FOLDER");
  status.excludes("--out").excludes("--rig");
  cmd.add_flag("--dry-run", o->dry_run, "Send nothing to the coils");
  cmd.add_flag("--drawn-swarm", o->drawn_swarm, "Drive coils for a simulated camera's swarm");
  add_coil_options(cmd, o->coils);
  cmd.add_flag("--failed-again", o->failed_again, "Run what has failed again");
  add_rig_settings(cmd, "--set-rig", o->rig_settings);
  cmd.add_option("--note", o->note, "Note of the operator, kept in the records").type_name("TEXT");
  add_json(cmd, o->json);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return rig_queue(*o, context); }; });
}

}  // namespace microswarm::cli

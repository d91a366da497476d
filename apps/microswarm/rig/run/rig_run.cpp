// SPDX-License-Identifier: Apache-2.0
// `rig run` runs a scenario on a rig in real time.
#include <memory>

#include "microswarm/core/text/text.hpp"
#include "microswarm/rig/session/fault_command.hpp"
#include "rig/real_coils.hpp"
#include "rig/rig.hpp"
#include "rig/rig_notes.hpp"
#include "rig/rig_settings.hpp"
#include "rig/run/live_run.hpp"
#include "support/service_manager.hpp"

namespace microswarm::cli {
namespace {

/// Throws InputError if the folder has an experiment, even a killed one, or the video exists.
void require_new(const std::filesystem::path& folder, const std::filesystem::path& video) {
  std::vector<std::filesystem::path> files;
  if (!folder.empty())
    for (const char* name :
         {"run.h5", "run.part.h5", "commands.csv", "commands.csv.part", "commands-0001.csv"})
      files.push_back(folder / name);
  if (!video.empty()) files.insert(files.end(), {video, vision::VideoRecorder::times_file(video)});
  for (const std::filesystem::path& file : files)
    if (std::error_code none; std::filesystem::exists(file, none))
      throw InputError(file.string(),
                       "is there from another experiment: choose another name, "
                       "or run with --overwrite");
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

int rig_run(const RigRunOptions& o, const Context& context) {
  std::vector<std::string> settings = o.settings;
  if (o.hold) settings.push_back("hold_at_goal_s=" + number_text(*o.hold));
  const rig::RigExperiment on = reading([&] {
    return rig::open_rig_experiment(o.scenario, {settings, "--set"}, o.rig,
                                    {o.rig_settings, "--set-rig"});
  });
  note_each(on.experiment.keys.notes());
  note_field(on.rig, on.scenario());
  require_person(on.rig, o.coils, o.dry_run, o.drawn_swarm);
  if (!o.overwrite) require_new(o.out, o.video);
  const OutFolder hold(o.out);
  rig::FaultCommand command([](const std::string& failed) { note("note: {}\n", failed); });
  ServiceManager service;
  return run_live(on,
                  {.live = {.dry = o.dry_run,
                            .folder = o.out,
                            .video = o.video,
                            .without_limits = o.coils.without_limits,
                            .coils_cold = o.coils.coils_cold,
                            .note = o.note,
                            .seconds = o.seconds,
                            .driven =
                                [&] {
                                  service.ready();
                                  service.drive();
                                }},
                   .json = o.json,
                   .ended = [&](const std::string& why) { service.stopping(why); },
                   .failed =
                       [&](const std::string& why) {
                         if (!o.dry_run) command.start(on.rig, why, o.out);
                       }},
                  context)
      .code;
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

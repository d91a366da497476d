// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

#include "commands/commands.hpp"
#include "lab/net/address_file.hpp"
#include "lab/net/server.hpp"
#include "lab/sessions/record_watch.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"
#include "microswarm/rig/runtime/rig_priority.hpp"
#include "rig/keys/rig_keys.hpp"
#include "rig/rig_notes.hpp"
#include "rig/rig_settings.hpp"
#include "support/options.hpp"
#include "support/service_manager.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

struct LabOptions {
  std::string file;
  std::vector<std::string> settings;
  std::string rig;
  std::vector<std::string> rig_settings;
  bool simulate = false;
  std::string out;
  bool without_limits = false;
  bool coils_cold = false;
  bool drawn_swarm = false;
  PhotoOptions photo;
  std::vector<std::string> folders;
  std::string queue;
  std::string listen;
  int port = 0;
  bool no_open = false;
};

/// Folders of the shipped scenarios: of a checkout, of an installation, or none.
std::vector<fs::path> shipped_scenarios() {
  std::error_code error;
  const fs::path bin = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {bin / "../share/microswarm/scenarios", bin / "../../../scenarios"})
    if (fs::is_directory(folder, error)) return {folder};
  return {};
}

bool has_desktop() { return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY"); }

/// Opens the page in the user's browser, if there is a program for it.
void open_in_browser(const lab::AddressFile& page) {
  if (page.path().empty()) return;  // the address was printed
  std::string quoted;
  for (const char c : page.path().string()) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  const std::string command = "xdg-open '" + quoted + "' >/dev/null 2>&1 &";
  [[maybe_unused]] const int failed = std::system(command.c_str());
}

/// Content of the first page; opened once, so that its errors are reported before the server
/// listens.
std::optional<lab::Opening> to_opening(const LabOptions& o) {
  if (o.file.empty()) {
    if (!o.settings.empty())
      throw InputError("--set: there is no scenario whose values could be set");
    if (!o.rig.empty()) throw InputError("--rig: there is no scenario for the rig");
    if (!o.photo.file.empty()) throw InputError("--photo: there is no map for the photograph");
    return std::nullopt;
  }
  lab::Opening opening{.file = lab::present_record(o.file),
                       .options = {.settings = {o.settings, "--set"},
                                   .rig = o.rig,
                                   .rig_settings = {o.rig_settings, "--set-rig"}}};
  if (report_options(o.photo).photo)  // reports an unreadable photograph
    opening.photo = lab::BackgroundPhoto{.file = o.photo.file, .um_per_px = *o.photo.um_per_px};
  if (o.rig.empty() || o.simulate) {
    note_each(reading([&] { return rig::open_on_rig(opening.file, opening.options); })->notes());
    return opening;
  }
  const rig::RigExperiment on = reading([&] {
    return rig::open_rig_experiment(o.file, {o.settings, "--set"}, o.rig,
                                    {o.rig_settings, "--set-rig"});
  });
  note_each(on.experiment.keys.notes());
  note_field(on.rig, on.scenario());
  std::error_code error;
  if (!o.out.empty()) std::filesystem::create_directories(o.out, error);
  if (error) throw InputError("--out " + o.out + ": cannot make the folder: " + error.message());
  opening.live = lab::RigOpening{.out = o.out,
                                 .without_limits = o.without_limits,
                                 .coils_cold = std::make_shared<std::atomic<bool>>(o.coils_cold),
                                 .drawn_swarm = o.drawn_swarm,
                                 .priority = rig::urgent_priority(on.rig)};
  return opening;
}

int lab_command(const LabOptions& o, const Context& context) {
  lab::ServerOptions options;
  options.folders = shipped_scenarios();
  for (const std::string& folder : o.folders) options.folders.emplace_back(folder);
  options.queue = o.queue;
  if (!o.queue.empty() && !fs::is_directory(o.queue))
    throw InputError("--queue " + o.queue + ": is no folder: it is the --out of `rig queue`");
  options.listen = o.listen;
  options.port = static_cast<std::uint16_t>(o.port);
  options.opening = to_opening(o);
  ServiceManager service;
  options.lives = [&] { service.live(); };
  std::string fault;  // of the last run that drove the coils
  if (options.opening && options.opening->live) {
    options.priority = options.opening->live->priority;
    options.opening->live->driven = [&] { service.drive(); };
    options.opening->live->ended = [&](const std::string& why) { service.rest(fault = why); };
    options.opening->live->note = [](const std::string& line) { note_each({line}); };
  }
  std::optional<lab::Server> server(std::in_place, std::move(options));
  if (!o.listen.empty())
    note("warning: anybody who reaches {} and has the token can use this lab, unencrypted\n",
         o.listen);
  print("{}\n", server->url());
  flush_output();
  std::optional<lab::AddressFile> page;
  if (!o.no_open && has_desktop()) open_in_browser(page.emplace(server->url()));
  const bool is_live = !o.rig.empty() && !o.simulate;
  std::optional<RigKeys> keys;
  if (is_live)
    keys.emplace([&] { server->stop_rigs("the emergency key was pressed"); }, [](const Key&) {},
                 context.stop);
  if (keys && keys->are_there()) note("space, e or Esc: coils to zero at once, as on the page\n");
  service.ready();
  const bool has_ended = server->run(context.stop);
  service.stopping("the lab has ended");
  // A session that still reads a large file has nothing to lose and cannot be stopped. A session
  // with a rig is waited for.
  if (!has_ended && !is_live) {
    page.reset();
    std::_Exit(ok);
  }
  keys.reset();
  server.reset();
  return fault.empty() ? complete : hardware;
}

}  // namespace

void add_lab(Command app, Action& action) {
  auto o = std::make_shared<LabOptions>();
  Command cmd = app.add_command("lab", "See, touch and stop experiments in a browser",
                                "lab scenarios/papers/radar/twelve.yaml");
  cmd.add_option("file", o->file, "Scenario (YAML) or record (run.h5) to begin with")
      .type_name("FILE")
      .input("papers");
  add_settings(cmd, o->settings, "Override a scenario value", type_of<experiment::Scenario>);
  const Option rig =
      cmd.add_option("--rig", o->rig, "Run the scenario on this rig (YAML), in real time")
          .type_name("FILE")
          .input("rigs");
  cmd.add_flag("--simulate", o->simulate, "Simulate the rig, as `rig simulate` does").needs(rig);
  cmd.add_option("--out", o->out, "Folder in which each run that drives the coils gets one")
      .type_name("FOLDER")
      .needs(rig);
  cmd.add_flag("--drawn-swarm", o->drawn_swarm, "Drive coils for a simulated camera's swarm")
      .needs(rig);
  cmd.add_flag("--without-limits", o->without_limits,
               "Drive coils whose file limits no current or temperature")
      .needs(rig);
  cmd.add_flag("--coils-cold", o->coils_cold, "The coils are at ambient temperature").needs(rig);
  add_rig_settings(cmd, "--set-rig", o->rig_settings).needs("--rig");
  add_photo(cmd, o->photo);
  cmd.add_option("--folder", o->folders,
                 "Folder whose scenarios and records are listed, beside the shipped ones")
      .type_name("FOLDER")
      .repeatable();
  cmd.add_option("--queue", o->queue, "Folder of a `rig queue` whose state the gallery shows")
      .type_name("FOLDER");
  cmd.add_option("--port", o->port, "Port of the page; 0: any that is free")
      .type_name("NUMBER")
      .check(whole(0, 65535));
  cmd.add_option("--listen", o->listen,
                 "Address to listen at, for other computers; otherwise this one alone")
      .type_name("ADDRESS");
  cmd.add_flag("--no-open", o->no_open, "Do not open the browser");
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return lab_command(*o, context); }; });
}

}  // namespace microswarm::cli

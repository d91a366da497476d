// SPDX-License-Identifier: Apache-2.0
// `rig identify` measures how a swarm answers its commands and writes it into the rig's file.
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "microswarm/config/yaml_edit.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "rig/commissioner.hpp"
#include "rig/identify/identify_drive.hpp"
#include "rig/identify/identify_output.hpp"
#include "rig/keys/answer_line.hpp"
#include "rig/rig.hpp"
#include "rig/rig_settings.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

struct IdentifyOptions {
  std::string rig;
  std::string scenario;
  std::string record;
  std::vector<std::string> settings;
  std::vector<std::string> rig_settings;
  IdentifyDrive drive;
  bool write = false;
  std::string by;
  bool json = false;
};

/// Fits a record. Throws InputError if nothing follows from it.
Identification identify(const experiment::Record& record, const rig::RigParams& file) {
  Identification of{.response = rig::RecordedResponse(record)};
  const rig::RigParams& driven = of.response.rig;
  if (driven.field.kind != file.field.kind)
    throw InputError(
        fmt::format("the record is of a field that is {}, the rig's file has one that "
                    "is {}",
                    enum_name(driven.field.kind), enum_name(file.field.kind)));
  if (driven.name != file.name)
    note("note: the record is of the rig '{}', the file of '{}'\n", driven.name, file.name);
  auto fit = rig::fit_response(of.response.data);
  if (!fit) throw InputError("too few sightings of a driven swarm: nothing follows from it");
  of.fit = std::move(*fit);
  of.sweep = rig::fit_step_out(of.response.data, of.fit);
  of.values = rig::measured_values(of.response.rig, file, of.fit, of.sweep);
  of.doubts = rig::doubts(of.fit);
  return of;
}

/// Asks at a terminal; false without one.
bool says_yes(const std::string& question, const Stop& stop) {
  AnswerLine answer(false);
  if (!answer.is_terminal()) return false;
  answer.ask(question);
  while (!stop() && !answer.ended()) {
    if (const auto line = answer.poll()) return *line == "y" || *line == "yes";
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

/// Entries of the commissioning record, for the rig's file as it is now.
std::vector<rig::CommissioningEntry> entries_of(const Identification& of, const std::string& file,
                                                const std::string& by) {
  const rig::Rig now = rig::read_rig(file);
  std::vector<rig::CommissioningEntry> entries;
  for (const rig::MeasuredValue& value : of.values)
    entries.push_back(rig::commissioning_entry(value.what, value.measured, by,
                                               rig::key_fingerprint(now, value.what)));
  // A bound is a measurement without a value for the file.
  if (of.sweep.followed && !of.sweep.lost)
    entries.push_back(rig::commissioning_entry(rig::Quantity::step_out,
                                               rig::step_out_text(of.sweep), by,
                                               rig::key_fingerprint(now, rig::Quantity::step_out)));
  return entries;
}

/// Throws InputError if the file's field or scale is not the one that was driven, apart from the
/// values that are measured.
void require_same_rig(const Identification& of, const std::string& file) {
  const auto text_of = [&](rig::RigParams params) {
    const actuation::FieldGeneratorParams plain;
    params.field.speed_per_pitch = plain.speed_per_pitch;
    params.field.length_per_turn = plain.length_per_turn;
    params.field.heading_offset = plain.heading_offset;
    params.field.step_out_frequency = plain.step_out_frequency;
    return to_yaml(params.field) + (params.scale ? to_yaml(*params.scale) : std::string());
  };
  if (text_of(of.response.rig) != text_of(rig::read_rig(file).params))
    throw InputError(file,
                     "has another field or scale than the rig that was driven: nothing is "
                     "written");
}

void write_values(const Identification& of, const IdentifyOptions& o) {
  require_same_rig(of, o.rig);
  std::vector<Setting> settings;
  for (const rig::MeasuredValue& value : of.values) settings.push_back(value.setting());
  const std::string text = edit_yaml(read_file(o.rig, max_yaml_bytes), o.rig, settings);
  write_file_atomically(o.rig, text);
  commission(o.rig, entries_of(of, o.rig, commissioner(o.by)));
}

/// Reports an identification and writes its values, if that is wanted. Returns the exit code.
int tell_and_write(const Identification& of, const IdentifyOptions& o, const Context& context) {
  if (!o.json) print_identification(of);
  flush_output();
  for (const std::string& doubt : of.doubts) note("microswarm: {}\n", doubt);
  if (!o.drive.out.empty()) {
    write_file_atomically(std::filesystem::path(o.drive.out) / "identify.json",
                          to_json(of).dump(2) + "\n");
    draw_identification(of, o.drive.out);
  }
  const bool writes =
      of.doubts.empty() &&
      (o.write ||
       (!o.json && says_yes("write these values into " + o.rig + "? y or n: ", context.stop)));
  if (writes) write_values(of, o);
  if (o.json) {
    nlohmann::ordered_json json = to_json(of);
    json["written"] = writes;
    print("{}\n", json.dump(2));
  } else if (writes) {
    print("wrote {}\n", o.rig);
  }
  if (!of.doubts.empty()) {
    note("nothing is written\n");
    return not_reached;
  }
  if (!writes) note("note: nothing is written; --write writes the values into {}\n", o.rig);
  return ok;
}

/// Throws InputError unless the values can be written into the rig's file, and its record.
void require_editable(const IdentifyOptions& o, const rig::Rig& rig) {
  if (!o.write) return;
  rig::read_commissioning(o.rig);
  std::vector<Setting> settings;
  for (const rig::MeasuredValue& value : rig::measured_values(
           rig.params, rig.params, {.gain = {1, 0}}, {.levels = {}, .followed = 1, .lost = 2}))
    settings.push_back(value.setting());
  edit_yaml(read_file(o.rig, max_yaml_bytes), o.rig, settings);
}

int rig_identify(const IdentifyOptions& o, const Context& context) {
  if (o.scenario.empty() == o.record.empty())
    throw InputError("rig identify: give either --scenario, to drive, or --record, to fit a run");
  const rig::Rig file = reading([&] {
    return rig::read_rig(o.rig, {o.rig_settings, "--set-rig"});
  });
  require_editable(o, file);
  const OutFolder hold(o.drive.out);
  if (!o.record.empty())
    return tell_and_write(identify(experiment::read_record(o.record), file.params), o, context);
  const std::filesystem::path kept = std::filesystem::path(o.drive.out) / "run.h5";
  if (std::error_code none; !o.drive.out.empty() && std::filesystem::exists(kept, none))
    throw InputError(kept.string(), "is there from another experiment: choose another name");
  IdentifyOutcome driven =
      drive_to_identify(reading([&] {
                          return rig::open_rig_experiment(o.scenario, {o.settings, "--set"}, o.rig,
                                                          {o.rig_settings, "--set-rig"});
                        }),
                        o.drive, context);
  if (!o.drive.out.empty()) experiment::write_record(driven.record, kept);
  if (driven.code != ok) return driven.code;
  return tell_and_write(identify(driven.record, file.params), o, context);
}

}  // namespace

void add_rig_identify(Command rig, Action& action) {
  auto o = std::make_shared<IdentifyOptions>();
  Command cmd =
      rig.add_command("identify", "Measure how a swarm answers its commands, for the rig's file",
                      "rig identify scenarios/rigs/vortex.yaml --scenario scenarios/first_rig.yaml "
                      "--out out/identify");
  cmd.add_option("rig", o->rig, "Rig file (YAML)").required().type_name("FILE").input("rigs");
  const Option scenario =
      cmd.add_option("--scenario", o->scenario, "Drive the swarm of this scenario, from its start")
          .type_name("FILE")
          .input("papers");
  cmd.add_option("--record", o->record, "Fit a recorded run (HDF5) and drive nothing")
      .type_name("FILE")
      .input()
      .excludes(scenario);
  cmd.add_flag("--by-hand", o->drive.by_hand, "Drive by hand with the keys of `rig run`")
      .needs(scenario);
  cmd.add_option("--seconds", o->drive.seconds, "Duration, about; by hand at most")
      .type_name("SECONDS")
      .check(number(20, 3600));
  cmd.add_option("--speed", o->drive.speed, "Commanded speed in µm/s")
      .type_name("UM/S")
      .default_text("that of the scenario's swarm")
      .check(number(1e-3, 1e6));
  cmd.add_option("--max-frequency", o->drive.max_frequency, "End of the sweep in Hz")
      .type_name("HZ")
      .default_text("three times the field's, or what rate and coils allow")
      .check(number(1e-3, 1e4));
  cmd.add_flag("--write", o->write, "Write the values into the rig's file without a question");
  add_by(cmd, o->by);
  cmd.add_option("--out", o->drive.out, "Folder for the record, identify.json and the plots")
      .type_name("FOLDER");
  cmd.add_flag("--drawn-swarm", o->drive.drawn_swarm, "Drive coils for a simulated camera's swarm");
  add_coil_options(cmd, o->drive.coils);
  add_settings(cmd, o->settings, "Override a scenario value", type_of<experiment::Scenario>);
  add_rig_settings(cmd, "--set-rig", o->rig_settings);
  add_json(cmd, o->json);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return rig_identify(*o, context); }; });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "microswarm/config/help.hpp"
#include "microswarm/config/schema.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/experiment/queries/global_query.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/queue/queue_params.hpp"
#include "microswarm/sweep/sweep_file.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

/// A kind of file, or the values of a command's --set.
struct Kind {
  std::string_view name;
  Type type;
};

std::array<Kind, 7> kinds() {
  return {{{"scenario", type_of<experiment::Scenario>()},
           {"sweep", type_of<sweep::Sweep>()},
           {"rig", type_of<rig::RigParams>()},
           {"queue", type_of<rig::QueueParams>()},
           {"coils", type_of<actuation::CoilSystemParams>()},
           {"track", type_of<vision::TrackSettings>()},
           {"global", type_of<experiment::GlobalChoice>()}}};
}

void show(std::string_view name, bool keys) {
  for (const Kind& kind : kinds())
    if (kind.name == name)
      put(keys ? help_text(kind.type) : json_schema(kind.type, fmt::format("microswarm {}", name)));
}

using Json = nlohmann::ordered_json;

Json to_json(const std::vector<KeyHelp>& keys) {
  Json list = Json::array();
  for (const KeyHelp& key : keys) {
    Json types = Json::array();
    for (const KeyHelp& type : key.types)
      types.push_back({{"type", type.key}, {"keys", to_json(type.keys)}});
    list.push_back({{"key", key.key},
                    {"unit", key.unit},
                    {"default", key.default_text},
                    {"range", key.range},
                    {"words", key.words},
                    {"doc", key.doc},
                    {"keys", to_json(key.keys)},
                    {"types", types}});
  }
  return list;
}

void print_description(const CommandLine& line) {
  Json keys;
  for (const Kind& kind : kinds()) keys[std::string(kind.name)] = to_json(key_help(kind.type));
  const Json all = {{"version", version}, {"program", line.description()}, {"keys", keys}};
  put(all.dump() + "\n");
}

}  // namespace

void add_describe(CommandLine& line, Action& action) {
  auto json = std::make_shared<bool>(false);
  Command cmd = line.root().add_command(
      "describe", "Print all commands, their options, and the keys of files", "describe --json");
  cmd.hide();
  cmd.add_flag("--json", *json, "Print the result as JSON").required();
  cmd.callback([json, &line, &action] {
    action = [&line](const Context&) {
      print_description(line);
      return ok;
    };
  });
}

void add_schema(Command app, Action& action) {
  auto name = std::make_shared<std::string>("scenario");
  auto keys = std::make_shared<bool>(false);
  Command cmd = app.add_command(
      "schema", "Print all keys of a kind of file, as JSON Schema (for editors) or as a table",
      "schema rig --keys");
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  cmd.add_option(
         "kind", *name,
         "Scenario, sweep, rig, queue or coil system file, or the --set values of track or global")
      .type_name("KIND")
      .check(any_word(names));
  cmd.add_flag("--keys", *keys, "Print a table with unit, default, range and meaning of each key");
  cmd.callback([=, &action] {
    action = [=](const Context&) {
      show(*name, *keys);
      return ok;
    };
  });
}

}  // namespace microswarm::cli

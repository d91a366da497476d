// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "microswarm/config/help.hpp"
#include "microswarm/config/schema.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/session/global_query.hpp"
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

std::array<Kind, 6> kinds() {
  return {{{"scenario", type_of<Scenario>()},
           {"sweep", type_of<Sweep>()},
           {"rig", type_of<RigParams>()},
           {"coils", type_of<CoilSystemParams>()},
           {"track", type_of<TrackSettings>()},
           {"global", type_of<GlobalChoice>()}}};
}

void show(std::string_view name, bool keys) {
  for (const Kind& kind : kinds())
    if (kind.name == name)
      put(keys ? help_text(kind.type) : json_schema(kind.type, fmt::format("microswarm {}", name)));
}

}  // namespace

void add_schema(Command app, Action& action) {
  auto name = std::make_shared<std::string>("scenario");
  auto keys = std::make_shared<bool>(false);
  Command cmd = app.add_command(
      "schema", "Print all keys of a kind of file, as JSON Schema (for editors) or as a table",
      "schema rig --keys");
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  cmd.add_option("kind", *name,
                 "Scenario, sweep, rig or coil system file, or the --set values of track or global")
      .check(one_of(names))
      .capture_default();
  cmd.add_flag("--keys", *keys, "Print a table with unit, default, range and meaning of each key");
  cmd.callback([=, &action] {
    action = [=](const Context&) {
      show(*name, *keys);
      return ok;
    };
  });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "microswarm/config/help.hpp"
#include "microswarm/config/schema.hpp"
#include "microswarm/experiment/scenario.hpp"
#include "microswarm/sweep/sweep_file.hpp"
#include "options.hpp"

namespace microswarm::cli {

void add_schema(CLI::App& app, Action& action) {
  auto keys = std::make_shared<bool>(false);
  auto sweep = std::make_shared<bool>(false);
  CLI::App* cmd = add_command(
      app, "schema", "Every key a scenario may have, as JSON Schema (for editors) or as a table",
      "schema --keys");
  cmd->add_flag("--keys", *keys, "A table of every key with unit, default, range and meaning");
  cmd->add_flag("--sweep", *sweep, "Of a sweep file in place of a scenario");
  cmd->callback([=, &action] {
    action = [=](const Context&) {
      if (*sweep) {
        put(*keys ? help_text<Sweep>() : json_schema<Sweep>("microswarm sweep"));
        return ok;
      }
      put(*keys ? help_text<Scenario>() : json_schema<Scenario>("microswarm scenario"));
      return ok;
    };
  });
}

}  // namespace microswarm::cli

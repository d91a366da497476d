// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string_view>

#include "global_choice.hpp"
#include "microswarm/config/help.hpp"
#include "microswarm/config/schema.hpp"
#include "microswarm/experiment/scenario.hpp"
#include "microswarm/sweep/sweep_file.hpp"

namespace microswarm::cli {

namespace {

template <HasFields T>
void show(bool keys, std::string_view title) {
  put(keys ? help_text<T>() : json_schema<T>(title));
}

}  // namespace

void add_schema(CLI::App& app, Action& action) {
  auto keys = std::make_shared<bool>(false);
  auto sweep = std::make_shared<bool>(false);
  auto global = std::make_shared<bool>(false);
  CLI::App* cmd = add_command(
      app, "schema", "Every key a scenario may have, as JSON Schema (for editors) or as a table",
      "schema --keys");
  cmd->add_flag("--keys", *keys, "A table of every key with unit, default, range and meaning");
  cmd->add_flag("--sweep", *sweep, "Of a sweep file in place of a scenario");
  cmd->add_flag("--global", *global, "Of what `global --set` changes in place of a scenario")
      ->excludes("--sweep");
  cmd->callback([=, &action] {
    action = [=](const Context&) {
      if (*sweep)
        show<Sweep>(*keys, "microswarm sweep");
      else if (*global)
        show<GlobalChoice>(*keys, "microswarm global");
      else
        show<Scenario>(*keys, "microswarm scenario");
      return ok;
    };
  });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli.hpp"
#include "microswarm/config/help.hpp"
#include "microswarm/config/schema.hpp"
#include "microswarm/experiment/scenario.hpp"

namespace microswarm::cli {

void add_schema(CLI::App& app, Action& action) {
  auto keys = std::make_shared<bool>(false);
  CLI::App* cmd = app.add_subcommand("schema", "JSON Schema of scenario files, for editors");
  cmd->add_flag("--keys", *keys, "A table of every key with unit, default and range instead");
  cmd->callback([=, &action] {
    action = [=](const Context&) {
      fmt::print("{}",
                 *keys ? help_text<Scenario>() : json_schema<Scenario>("microswarm scenario"));
      return ok;
    };
  });
}

}  // namespace microswarm::cli

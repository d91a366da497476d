// SPDX-License-Identifier: Apache-2.0
#include "reproduce.hpp"

#include <fmt/format.h>

#include <memory>

#include "microswarm/core/error.hpp"

namespace microswarm::cli {
namespace {

int reproduce_command(const std::string& key, ReproduceOptions options, bool json,
                      const Context& context) {
  options.scenarios = scenario_folder();
  const std::string paper = key.substr(0, key.find('/'));
  const std::string figure = key.size() > paper.size() ? key.substr(paper.size() + 1) : "";
  if (paper != "drrt")
    throw InputError(fmt::format("reproduce: unknown paper '{}', there is: drrt", paper));
  if (!options.out.empty()) make_folder(options.out);
  const std::vector<ReproduceRow> rows = reproduce_drrt(figure, options, context.stop);
  if (options.quick && !json)
    fmt::print("quick: {} seeds instead of {}\n", options.seed_count(), full_seeds);
  fmt::print("{}", json ? rows_json(rows) : rows_table(rows));
  if (context.stop.requested()) return not_reached;
  return all_ok(rows) ? ok : not_reached;
}

}  // namespace

void add_reproduce(CLI::App& app, Action& action) {
  auto key = std::make_shared<std::string>();
  auto o = std::make_shared<ReproduceOptions>();
  auto json = std::make_shared<bool>(false);
  CLI::App* cmd = app.add_subcommand("reproduce", "A paper's figures beside ours");
  cmd->add_option("key", *key, "Paper and figure: drrt, drrt/fig3, drrt/fig5a, drrt/fig5b")
      ->required();
  cmd->add_option("--out", o->out, "Folder for plots, pictures and the table as CSV");
  cmd->add_flag("--quick", o->quick, "Fewer seeds: ends within 50 s");
  cmd->add_flag("--json", *json, "Rows for machines");
  cmd->callback([=, &action] {
    action = [=](const Context& context) { return reproduce_command(*key, *o, *json, context); };
  });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "reproduce.hpp"

#include <memory>

#include "microswarm/core/error.hpp"
#include "options.hpp"

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
  if (options.quick)
    fmt::print(stderr, "quick: {} seeds instead of {}\n", options.seed_count(), full_seeds);
  put(json ? rows_json(rows) : rows_table(rows) + aims_met(rows));
  if (context.stop.requested()) return not_reached;
  return all_ok(rows) ? ok : not_reached;
}

}  // namespace

void add_reproduce(CLI::App& app, Action& action) {
  auto key = std::make_shared<std::string>();
  auto o = std::make_shared<ReproduceOptions>();
  auto json = std::make_shared<bool>(false);
  CLI::App* cmd = add_command(app, "reproduce",
                              "A paper's figures beside ours: exit code 3 when one falls short",
                              "reproduce drrt/fig5a --quick --out out/drrt");
  cmd->add_option("key", *key,
                  "Paper, or one of its figures: drrt, drrt/fig3, drrt/fig5a, drrt/fig5b")
      ->required()
      ->type_name("KEY");
  cmd->add_option("--out", o->out, "Folder for plots, pictures and the table as CSV")
      ->type_name("FOLDER");
  cmd->add_flag("--quick", o->quick, "Fewer seeds: ends within 50 s");
  add_json(cmd, *json);
  cmd->callback([=, &action] {
    action = [=](const Context& context) { return reproduce_command(*key, *o, *json, context); };
  });
}

}  // namespace microswarm::cli

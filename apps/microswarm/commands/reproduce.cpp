// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/reproduce.hpp"

#include <fmt/ranges.h>

#include <array>
#include <memory>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/choices.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Reproduce = std::vector<report::ReproduceRow> (*)(const std::string& figure,
                                                        const reproduce::ReproduceOptions& options,
                                                        const Stop& stop);

constexpr std::array<std::pair<std::string_view, Reproduce>, 7> reproduced_papers{
    {{"drrt", reproduce::drrt_figures},
     {"global", reproduce::global_figures},
     {"radar", reproduce::radar_figures},
     {"gather", reproduce::gather_figures},
     {"arena", reproduce::arena_figures},
     {"dynabarn", reproduce::dynabarn_figures},
     {"crowd", reproduce::crowd_figures}}};

Reproduce find_paper(const std::string& paper) {
  std::vector<std::string_view> names;
  for (const auto& [name, figures] : reproduced_papers) {
    if (name == paper) return figures;
    names.push_back(name);
  }
  throw InputError(fmt::format("reproduce: unknown paper or benchmark '{}', {}", paper,
                               allowed_words(paper, names)));
}

int reproduce_command(const std::string& key, reproduce::ReproduceOptions options, bool json,
                      const Context& context) {
  options.scenarios = scenario_folder();
  options.progress = progress_bars();
  options.note = [](const std::string& what) { note("{}\n", what); };
  const std::string paper = key.substr(0, key.find('/'));
  const std::string figure = key.size() > paper.size() ? key.substr(paper.size() + 1) : "";
  const Reproduce figures = find_paper(paper);
  if (figure.empty() && key != paper)
    throw InputError(
        fmt::format("reproduce: '{}' names no figure; all of them are '{}'", key, paper));
  const OutFolder hold(options.out);
  const std::vector<report::ReproduceRow> rows = figures(figure, options, context.stop);
  if (options.quick) note("quick: fewer seeds\n");
  put(json ? report::rows_json(rows) : report::rows_table(rows) + aims_met(rows));
  if (context.stop.requested()) return not_reached;
  return report::all_ok(rows) ? ok : not_reached;
}

}  // namespace

void add_reproduce(Command app, Action& action) {
  auto key = std::make_shared<std::string>();
  auto o = std::make_shared<reproduce::ReproduceOptions>();
  auto json = std::make_shared<bool>(false);
  Command cmd =
      app.add_command("reproduce", "Reproduce a paper's figures; exit code 3 if one misses its aim",
                      "reproduce drrt/fig5a --quick --out out/drrt");
  std::vector<std::string> papers;
  papers.reserve(std::size(reproduced_papers));
  for (const auto& [name, figures] : reproduced_papers) papers.emplace_back(name);
  cmd.add_option("key", *key, "Paper, figure or benchmark: drrt, drrt/fig3, arena, crowd …")
      .required()
      .type_name("KEY")
      .suggest(suggest_words(papers));
  cmd.add_option("--out", o->out, "Folder for plots, pictures and the table as CSV")
      .type_name("FOLDER");
  cmd.add_flag("--quick", o->quick, "Fewer seeds; takes at most 50 s");
  add_json(cmd, *json);
  cmd.callback([=, &action] {
    action = [=](const Context& context) { return reproduce_command(*key, *o, *json, context); };
  });
}

}  // namespace microswarm::cli

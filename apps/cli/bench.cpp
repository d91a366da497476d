// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/report/rows.hpp"
#ifdef MICROSWARM_HAS_BENCH
#include "bench/planning.hpp"
#endif

namespace microswarm::cli {
namespace {

#ifdef MICROSWARM_HAS_BENCH
int bench_command(const std::string& group, const std::string& csv, bool quick, bool json,
                  const Context& context) {
  if (group != "planning")
    throw InputError(fmt::format("bench: unknown group '{}', there is: planning", group));
  const std::vector<BenchRow> rows = bench::planning(scenario_folder(), quick, context.stop);
  if (!csv.empty() && !context.stop.requested())
    write_file_atomically(csv, "# " + bench::machine_line() + "\n" + rows_csv(rows));
  if (quick && !json) fmt::print("quick: fewer repetitions\n");
  fmt::print("{}", json ? rows_json(rows) : bench::machine_line() + "\n" + rows_table(rows));
  if (context.stop.requested()) return not_reached;
  return all_ok(rows) ? ok : not_reached;
}
#else
int bench_command(const std::string&, const std::string&, bool, bool, const Context&) {
  throw InputError(
      "bench: this program was built without the benches (CMake MICROSWARM_BENCH=OFF)");
}
#endif

}  // namespace

void add_bench(CLI::App& app, Action& action) {
  auto group = std::make_shared<std::string>();
  auto csv = std::make_shared<std::string>();
  auto quick = std::make_shared<bool>(false);
  auto json = std::make_shared<bool>(false);
  CLI::App* cmd = app.add_subcommand("bench", "Measure speeds beside a peer in the same run");
  cmd->add_option("group", *group, "Group: planning")->required();
  cmd->add_option("--csv", *csv, "Write the rows to this file too");
  cmd->add_flag("--quick", *quick, "Fewer repetitions: ends within 50 s");
  cmd->add_flag("--json", *json, "Rows for machines");
  cmd->callback([=, &action] {
    action = [=](const Context& context) {
      return bench_command(*group, *csv, *quick, *json, context);
    };
  });
}

}  // namespace microswarm::cli

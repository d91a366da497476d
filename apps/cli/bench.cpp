// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/report/rows.hpp"
#include "options.hpp"
#ifdef MICROSWARM_HAS_BENCH
#include "bench/global.hpp"
#include "bench/planning.hpp"
#include "bench/radar.hpp"
#include "bench/swarm.hpp"
#include "bench/vision.hpp"
#endif

namespace microswarm::cli {
namespace {

#ifdef MICROSWARM_HAS_BENCH
std::vector<BenchRow> bench_rows(const std::string& group, bool quick, const Stop& stop) {
  if (group == "planning") return bench::planning(scenario_folder(), quick, stop);
  if (group == "radar") return bench::radar(quick, stop);
  if (group == "vision") return bench::vision(quick, stop);
  return group == "global" ? bench::global(quick, stop) : bench::swarm(quick, stop);
}

int measure(const std::string& group, const std::string& csv, bool quick, bool json,
            const Context& context) {
  if (!csv.empty()) const StagedFile can_be_written(csv);
  const std::vector<BenchRow> rows = bench_rows(group, quick, context.stop);
  if (!csv.empty() && !context.stop.requested())
    write_file_atomically(csv, "# " + bench::machine_line() + "\n" + rows_csv(rows));
  if (quick) note("quick: fewer repetitions\n");
  put(json ? rows_json(rows) : bench::machine_line() + "\n" + rows_table(rows) + aims_met(rows));
  if (context.stop.requested()) return not_reached;
  return all_ok(rows) ? ok : not_reached;
}
#else
int measure(const std::string&, const std::string&, bool, bool, const Context&) {
  throw InputError(
      "bench: this program was built without the benches (CMake MICROSWARM_BENCH=OFF)");
}
#endif

}  // namespace

void add_bench(Command app, Action& action) {
  auto group = std::make_shared<std::string>();
  auto csv = std::make_shared<std::string>();
  auto quick = std::make_shared<bool>(false);
  auto json = std::make_shared<bool>(false);
  Command cmd = app.add_command(
      "bench", "Measure speeds beside a peer's in the same run: exit code 3 when one falls short",
      "bench planning --quick --csv planning.csv");
  cmd.add_option("group", *group, "What to measure: planning, swarm, global, radar, vision")
      .required()
      .type_name("GROUP");
  cmd.add_option("--csv", *csv, "Write the rows to this file too").type_name("FILE");
  cmd.add_flag("--quick", *quick, "Fewer repetitions: ends within 50 s");
  add_json(cmd, *json);
  cmd.callback([=, &action] {
    action = [=](const Context& context) {
      if (*group != "planning" && *group != "swarm" && *group != "global" && *group != "radar" &&
          *group != "vision")
        throw InputError(fmt::format(
            "bench: unknown group '{}', there are: planning, swarm, global, radar, vision",
            *group));
      return measure(*group, *csv, *quick, *json, context);
    };
  });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
// microswarm-bench compares speeds with those of peers, which only this program links.
#include <memory>

#ifdef MICROSWARM_BENCH_BINDINGS
#include "bench/bindings.hpp"
#endif
#include "bench/gathering.hpp"
#include "bench/global.hpp"
#include "bench/growth.hpp"
#include "bench/lab.hpp"
#include "bench/navigators.hpp"
#include "bench/planning.hpp"
#include "bench/radar.hpp"
#include "bench/rig.hpp"
#include "bench/swarm.hpp"
#include "bench/sweep.hpp"
#include "bench/vision.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/report/rows.hpp"
#include "support/options.hpp"
#include "support/program.hpp"

namespace microswarm::cli {
namespace {

using Rows = std::vector<report::BenchRow>;

struct BenchOptions {
  std::string csv;
  bool quick = false;
  bool json = false;
};

struct Group {
  const char* name;
  const char* doc;
  std::function<Rows(bool quick, const Stop&)> measure;
};

/// The command-line tool beside this program.
std::filesystem::path tool() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "microswarm";
}

int measure(const Group& group, const BenchOptions& o, const Context& context) {
  if (!o.csv.empty()) const StagedFile can_be_written(o.csv);
  const Rows rows = group.measure(o.quick, context.stop);
  if (!o.csv.empty() && !context.stop.requested())
    write_file_atomically(o.csv, "# " + bench::machine_line() + "\n" + report::rows_csv(rows));
  if (o.quick) note("quick: fewer repetitions\n");
  put(o.json ? report::rows_json(rows)
             : bench::machine_line() + "\n" + report::rows_table(rows) + aims_met(rows));
  if (context.stop.requested()) return not_reached;
  return report::all_ok(rows) ? ok : not_reached;
}

void add_group(Command app, const Group& group, Action& action) {
  auto o = std::make_shared<BenchOptions>();
  const std::string example = fmt::format("bench {0} --quick --csv {0}.csv", group.name);
  Command cmd = app.add_command(group.name, group.doc, example.c_str());
  cmd.add_option("--csv", o->csv, "Also write the rows to this CSV file").type_name("FILE");
  cmd.add_flag("--quick", o->quick, "Fewer repetitions; takes at most 50 s");
  add_json(cmd, o->json);
  cmd.callback([=, &action] {
    action = [=](const Context& context) { return measure(group, *o, context); };
  });
}

}  // namespace
}  // namespace microswarm::cli

int main(int argc, char** argv) {
  using namespace microswarm;
  cli::CommandLine line("microswarm-bench",
                        "Compares speeds with those of reference implementations.",
                        std::string(version), "Exit code 3 if a row misses its aim.");
  const cli::Command app = line.root();
  cli::Action action;
  const std::vector<cli::Group> groups{
      {"planning", "Planners, replanning, clearance queries",
       [](bool quick, const Stop& stop) {
         return bench::planning(cli::scenario_folder(), quick, stop);
       }},
      {"sweep", "Sweeps on two threads and two processes, and their database",
       [](bool quick, const Stop& stop) {
         return bench::sweep(cli::scenario_folder(), cli::tool(), quick, stop);
       }},
      {"swarm", "Stepping of robots under one input", bench::swarm},
      {"global", "Planning for several robots under one input", bench::global},
      {"gather", "Steps that gather robots, by each method", bench::gather},
      {"navigators", "Every navigator in scenes of the arena, beside the earliest arrival",
       bench::navigators},
      {"radar", "Decisions of the radar", bench::radar},
      {"growth", "How times grow with robots, obstacles, vertices and shapes", bench::growth},
#ifdef MICROSWARM_BENCH_BINDINGS
      {"bindings", "Steps of a navigator from C, Python and Octave, a sweep from Python",
       [](bool quick, const Stop& stop) {
         return bench::bindings(cli::scenario_folder(), cli::tool(), quick, stop);
       }},
#endif
#ifdef MICROSWARM_BENCH_LAB
      {"lab", "The lab: frames, times, several clients; its page in a browser",
       [](bool quick, const Stop& stop) {
         return bench::lab(cli::scenario_folder(), quick, stop);
       }},
#endif
      {"vision", "Detection and tracking of swarms and robots", bench::vision},
      {"rig", "From camera to current at 100 Hz, in real time", [](bool quick, const Stop& stop) {
         return bench::rig(cli::scenario_folder(), cli::tool(), quick, stop);
       }}};
  for (const cli::Group& group : groups) cli::add_group(app, group, action);
  return cli::run_program("microswarm-bench", line, action, argc, argv);
}

// SPDX-License-Identifier: Apache-2.0
// `bench` hands over to microswarm-bench, the program that links what it is measured beside.
#include <unistd.h>

#include <memory>

#include "commands/commands.hpp"
#include "microswarm/core/error.hpp"

namespace microswarm::cli {
namespace {

struct BenchOptions {
  std::string group;
  std::string csv;
  bool quick = false;
  bool json = false;
};

constexpr const char* groups[] = {"planning", "swarm", "global", "radar", "vision"};

int measure(const BenchOptions& o) {
  if (std::find(std::begin(groups), std::end(groups), o.group) == std::end(groups))
    throw InputError(
        fmt::format("bench: unknown group '{}', there are: {}", o.group, fmt::join(groups, ", ")));
  const auto program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "microswarm-bench";
  std::vector<std::string> words{program.string(), o.group};
  if (!o.csv.empty()) words.insert(words.end(), {"--csv", o.csv});
  if (o.quick) words.push_back("--quick");
  if (o.json) words.push_back("--json");
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  flush_output();
  ::execv(program.c_str(), arguments.data());
  throw InputError(program.string() +
                   ": cannot start; the benches are built where OMPL is installed (CMake "
                   "MICROSWARM_BENCH)");
}

}  // namespace

void add_bench(Command app, Action& action) {
  auto o = std::make_shared<BenchOptions>();
  Command cmd = app.add_command(
      "bench", "Measure speeds beside a peer's in the same run: exit code 3 when one falls short",
      "bench planning --quick --csv planning.csv");
  cmd.add_option("group", o->group, "What to measure: planning, swarm, global, radar, vision")
      .required()
      .type_name("GROUP");
  cmd.add_option("--csv", o->csv, "Write the rows to this file too").type_name("FILE");
  cmd.add_flag("--quick", o->quick, "Fewer repetitions: ends within 50 s");
  cmd.add_flag("--json", o->json, "Print JSON");
  cmd.callback([o, &action] { action = [o](const Context&) { return measure(*o); }; });
}

}  // namespace microswarm::cli

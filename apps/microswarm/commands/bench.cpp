// SPDX-License-Identifier: Apache-2.0
// `bench` executes microswarm-bench, the program that links the peer libraries.
#include <unistd.h>

#include <memory>

#include "commands/commands.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/choices.hpp"

namespace microswarm::cli {
namespace {

struct BenchOptions {
  std::string group;
  std::string csv;
  bool quick = false;
  bool json = false;
};

constexpr std::string_view groups[] = {"planning", "sweep",      "swarm", "global",
                                       "gather",   "navigators", "radar", "growth",
                                       "vision",   "lab",        "rig",   "bindings"};

int measure(const BenchOptions& o) {
  if (std::find(std::begin(groups), std::end(groups), o.group) == std::end(groups))
    throw InputError(
        fmt::format("bench: unknown group '{}', {}", o.group, allowed_words(o.group, groups)));
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
  throw InputError(program.string(),
                   "cannot start; the benches are built where OMPL is installed (CMake "
                   "MICROSWARM_BENCH)");
}

}  // namespace

void add_bench(Command app, Action& action) {
  auto o = std::make_shared<BenchOptions>();
  Command cmd = app.add_command("bench",
                                "Compare speeds with those of reference implementations; exit code "
                                "3 if one is slower than these "
                                "or misses its aim",
                                "bench planning --quick --csv planning.csv");
  cmd.add_option("group", o->group, fmt::format("Benchmark: {}", fmt::join(groups, ", ")).c_str())
      .required()
      .type_name("GROUP")
      .suggest(suggest_words({std::begin(groups), std::end(groups)}));
  cmd.add_option("--csv", o->csv, "Also write the rows to this CSV file").type_name("FILE");
  cmd.add_flag("--quick", o->quick, "Fewer repetitions; takes at most 50 s");
  cmd.add_flag("--json", o->json, "Print JSON");
  cmd.callback([o, &action] { action = [o](const Context&) { return measure(*o); }; });
}

}  // namespace microswarm::cli

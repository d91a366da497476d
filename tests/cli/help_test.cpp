// SPDX-License-Identifier: Apache-2.0
// The help at a terminal, and its examples.
#include <nlohmann/json.hpp>

#include "inputs.hpp"
#include "program.hpp"
#include "support/help_text.hpp"
#include "support/status_line.hpp"
#include "terminal.hpp"

namespace microswarm::test {
namespace {

using HelpJson = nlohmann::json;

class Help : public CommandLine {};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines{""};
  for (const char c : text)
    if (c == '\n')
      lines.emplace_back();
    else if (c != '\r')
      lines.back() += c;
  return lines;
}

/// Words without line ends, blanks and the backslashes of a command line.
std::string words_of(std::string text) {
  std::string words;
  for (const char c : text)
    if (c != ' ' && c != '\n' && c != '\\') words += c;
  return words;
}

TEST_F(Help, IsWrappedToTheColumnsAndSaysTheSame) {
  for (const char* command : {"run", "track", "plan"}) {
    const std::string help = good({command, "--help"});
    EXPECT_EQ(cli::wrapped_help(help, 0), help);
    EXPECT_EQ(cli::wrapped_help(help, 1000), help);
    for (const std::size_t columns : {50U, 80U, 100U}) {
      const std::string wrapped = cli::wrapped_help(help, columns);
      EXPECT_EQ(words_of(wrapped), words_of(help)) << columns;
      for (const std::string& line : lines_of(wrapped)) {
        const bool is_one_word = line.find(' ', line.find_first_not_of(' ')) == line.npos;
        EXPECT_TRUE(cli::to_columns(line) <= columns || is_one_word) << columns << ": " << line;
      }
    }
  }
  EXPECT_EQ(cli::wrapped_help("  --a NUMBER       one two three four five six", 40),
            "  --a NUMBER       one two three four\n                   five six");
  EXPECT_EQ(cli::wrapped_help("  microswarm run a.yaml --out out --set b=c --seed 3", 40),
            "  microswarm run a.yaml --out out \\\n      --set b=c --seed 3");
}

TEST_F(Help, ATerminalOrColumnsSayTheWidth) {
  const auto widest = [&](unsigned short columns, const char* variable) {
    Surroundings in = at;
    in.environment.emplace_back("COLUMNS", variable);
    Terminal terminal({"run", "--help"}, in, columns);
    EXPECT_EQ(terminal.wait(), 0);
    const std::string said = terminal.said();
    std::size_t most = 0;
    for (const std::string& line : lines_of(said)) most = std::max(most, cli::to_columns(line));
    return most;
  };
  EXPECT_LE(widest(60, ""), 60U);
  EXPECT_GT(widest(60, ""), 50U);
  EXPECT_LE(widest(200, "70"), 70U);
  EXPECT_GT(widest(200, "nonsense"), 80U);
}

TEST_F(Help, HelpIsACommandToo) {
  EXPECT_EQ(good({"help"}), good({"--help"}));
  EXPECT_EQ(good({"help", "run"}), good({"run", "--help"}));
  EXPECT_EQ(good({"help", "rig", "see"}), good({"rig", "see", "--help"}));
  refused({"help", "rnu"}, naming("", {"unknown command 'rnu'", "did you mean 'run'"}));
}

TEST_F(Help, AValueThatIsNearlyAWordIsAnsweredWithTheWord) {
  write("flight.yaml", two_rooms());
  refused({"run", "flight.yaml", "--set", "navigator.type=radarr"},
          naming("--set navigator.type", {"'radarr'", "did you mean 'radar'?"}));
  refused({"schema", "scenarioo"}, naming("kind", {"did you mean 'scenario'?"}));
  refused({"reproduce", "drtt"}, naming("reproduce", {"did you mean 'drrt'?"}));
}

TEST(Progress, SaysShareAndTimeInFewColumnsToo) {
  const auto text = [](double share, std::size_t columns) {
    return cli::progress_text("gather", share, 10, "step 7", columns);
  };
  EXPECT_EQ(text(0.5, 79), "gather [############.............]  50 % 10 s left step 7");
  EXPECT_EQ(text(0.5, 39), "gather [#######.......]  50 % 10 s left step 7");
  EXPECT_EQ(text(0.5, 26), "gather  50 % 10 s left step 7");
  EXPECT_EQ(text(0, 79), "gather [.........................]   0 % step 7");
  const std::string named = cli::progress_text(std::string(60, 'x'), 0.5, 10, "", 39);
  EXPECT_NE(named.substr(0, 39).find("50 % 10 s left"), std::string::npos) << named;
}

class Examples : public CommandLine {
 protected:
  /// All examples of the help, in the order in which it lists the commands.
  static void collect(const HelpJson& command, std::vector<std::string>& examples) {
    if (command.contains("example")) examples.push_back(command.at("example"));
    for (const HelpJson& below : command.at("commands")) collect(below, examples);
  }
  Surroundings shell() const {
    Surroundings in = at;
    in.program = "/bin/bash";
    in.path = fs::path(MICROSWARM_PROGRAM).parent_path().string() + ":/usr/bin:/bin";
    return in;
  }
};

TEST_F(Examples, AllRunInTheirOrderInAnEmptyFolder) {
  std::vector<std::string> examples;
  collect(HelpJson::parse(good({"describe", "--json"})).at("program"), examples);
  EXPECT_GE(examples.size(), 25U);
  for (const std::string& example : examples) {
    const auto is_of = [&](const char* command) {
      return example.starts_with("  microswarm " + std::string(command));
    };
    if (is_of("bench") &&
        !fs::exists(fs::path(MICROSWARM_PROGRAM).parent_path() / "microswarm-bench"))
      continue;
    const bool is_long = is_of("lab") || is_of("learn") || is_of("bench") ||
                         is_of("rig identify");  // works until Ctrl-C, or for a minute
    const std::string line = is_of("lab") ? example + " --no-open" : example;
    Program program({"-e", "-c", (is_long ? "exec " : "") + line.substr(2)}, shell());
    if (is_long) {
      program.let_work(1500);
      program.send(SIGINT);
    }
    const Outcome outcome = program.wait();
    const bool has_no_device = is_of("rig still") && outcome.code == 4;
    const bool has_no_verdict = (is_long || is_of("reproduce")) && outcome.code == 3;
    EXPECT_TRUE(outcome.code == 0 || has_no_device || has_no_verdict)
        << example << "\n"
        << outcome.code << ": " << outcome.err;
    EXPECT_TRUE(has_no_device || outcome.err.find("No such file") == std::string::npos)
        << outcome.err;
  }
}

}  // namespace
}  // namespace microswarm::test

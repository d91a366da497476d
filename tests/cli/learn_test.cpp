// SPDX-License-Identifier: Apache-2.0
// Training from the command line, and scenarios with a learned follower.
#include "inputs.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

const Arguments little{"--set",    "runs=10", "--set",        "rounds=0", "--set",
                       "hidden=4", "--set",   "iterations=5", "--set",    "last_iterations=5"};

class Learn : public CommandLine {
 protected:
  static Arguments learn(Arguments more) {
    Arguments words{"learn", "follower"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(Learn, WritesModelCardTableAndPlots) {
  Arguments words = learn({"--out", "out", "--quick", "--jobs", "2"});
  words.insert(words.end(), little.begin(), little.end());
  const Outcome outcome = run(words);
  EXPECT_TRUE(outcome.code == 0 || outcome.code == 3) << outcome.err;  // it need not be good
  for (const char* file : {"out/follower.yaml", "out/follower.md", "out/follower.csv",
                           "out/follower.png", "out/follower-trace.svg"})
    EXPECT_TRUE(exists(file)) << file;
  EXPECT_TRUE(read("out/follower.csv")
                  .starts_with("follower,task,arrived,time_s,way_over_speed_s,rms_off_um,"
                               "most_off_um,field_turning_deg_per_s,fallback_share\n"));
  EXPECT_NE(read("out/follower.yaml").find("\nlayers: [18, 4, 4, 2]\n"), std::string::npos);
  EXPECT_NE(read("out/follower.md").find("--set hidden=4"), std::string::npos);
}

TEST_F(Learn, CtrlCLeavesNothingHalf) {
  Program program(learn({"--out", "out"}), at);
  program.let_work(300);
  ASSERT_TRUE(program.running());
  program.send(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err, "interrupted: nothing is written\n");
  EXPECT_FALSE(exists("out/follower.yaml"));
}

TEST_F(Learn, BadParametersAreToldInOneLine) {
  refused(learn({"--out", "out", "--set", "hiden=4"}), naming("--set hiden", {"hiden", "hidden"}));
}

TEST_F(Learn, AScenarioNamesItsModelAndTheRecordKeepsIt) {
  const std::string text = read_file(fs::path(MICROSWARM_SOURCE_DIR) / "models/follower.yaml");
  write("m.yaml", text);
  write("flight.yaml", two_rooms());
  const Arguments learned{"--set", "navigator.follower.kind=learned", "--set",
                          "navigator.follower.model=m.yaml"};
  Arguments words{"run", "flight.yaml", "--out", "out", "--no-report"};
  words.insert(words.end(), learned.begin(), learned.end());
  good(words);
  fs::remove(at.folder / "m.yaml");
  EXPECT_TRUE(good({"replay", "out/run.h5"}).starts_with("identical: record "));
  write("m.yaml", text.substr(0, text.size() / 2));
  words[3] = "again";
  const Outcome cut = run(words);
  EXPECT_EQ(cut.code, 2);
  EXPECT_NE(cut.err.find("m.yaml:"), std::string::npos) << cut.err;
}

}  // namespace
}  // namespace microswarm::test

// SPDX-License-Identifier: Apache-2.0
// Input that is no file of the user's: shipped files by name, standard input, pipes of the shell.
#include <nlohmann/json.hpp>

#include "inputs.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

using InputJson = nlohmann::json;

class InputFiles : public CommandLine {
 protected:
  InputFiles() { write("flight.yaml", two_rooms()); }

  /// What a command line of bash does, in which `microswarm` is the program.
  Outcome shell(const std::string& line) const {
    Surroundings in = at;
    in.program = "/bin/bash";
    in.path = fs::path(MICROSWARM_PROGRAM).parent_path().string() + ":/usr/bin:/bin";
    return Program({"-e", "-c", line}, in).wait();
  }
  std::string hash_of(const Outcome& outcome) const {
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return InputJson::parse(outcome.out).at("record_hash");
  }
};

TEST_F(InputFiles, AShippedFileIsFoundByItsNameFromAnyFolder) {
  const auto hash = [&](const std::string& name, bool is_noted) {
    const Outcome outcome = run({"run", name, "--json"});
    if (is_noted) {
      EXPECT_TRUE(is_one_line_naming(outcome.err, "note: " + name, {"first_flight.yaml"}));
    }
    return hash_of(outcome);
  };
  const std::string expected =
      hash(std::string(MICROSWARM_SOURCE_DIR) + "/scenarios/first_flight.yaml", false);
  EXPECT_EQ(hash("first_flight", true), expected);
  EXPECT_EQ(hash("first_flight.yaml", true), expected);
  EXPECT_EQ(hash("scenarios/first_flight.yaml", true), expected);
  for (const Arguments& words : {Arguments{"map", "info", "retina"},
                                 {"map", "info", "maps/retina.geojson"},
                                 {"map", "info", "samples/maze.pgm", "--um-per-px", "5"},
                                 {"rig", "field", "cube", "--at", "0,0,0", "--field", "3,0,0"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("note: ")) << outcome.err;
  }
}

TEST_F(InputFiles, AFileThatIsHereComesBeforeAShippedOne) {
  write("first_flight.yaml", two_rooms());
  EXPECT_EQ(hash_of(run({"run", "first_flight.yaml", "--json"})),
            hash_of(run({"run", "flight.yaml", "--json"})));
  EXPECT_EQ(run({"run", "first_flight.yaml", "--json"}).err, "");
}

TEST_F(InputFiles, NoFileOutsideIsTakenForAShippedOne) {
  refused({"run", "../README.md"}, naming("../README.md", {"No such file"}));
  refused({"run", "no_flight"}, naming("no_flight", {"No such file"}));
  refused({"run", "/first_flight.yaml"}, naming("/first_flight.yaml", {"No such file"}));
}

TEST_F(InputFiles, StandardInputAndPipesAreReadLikeTheFile) {
  const std::string expected = hash_of(run({"run", "flight.yaml", "--json"}));
  for (const char* line :
       {"microswarm run - --json < flight.yaml", "cat flight.yaml | microswarm run - --json",
        "cat flight.yaml | microswarm run /dev/stdin --json",
        "microswarm run <(cat flight.yaml) --json",
        "(sleep 0.2; cat flight.yaml) | microswarm run - --json"})
    EXPECT_EQ(hash_of(shell(line)), expected) << line;
  // Names in it count from the working folder.
  write("sweep.yaml", "scenario: flight.yaml\ntrials: 1\n");
  EXPECT_EQ(shell("microswarm sweep - --out s.db < sweep.yaml").code, 0);
  const Outcome bad = shell("echo 'nmae: x' | microswarm run -");
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("/dev/stdin:1:1: unknown key 'nmae', did you mean 'name'?"),
            std::string::npos)
      << bad.err;
}

TEST_F(InputFiles, AMapFromStandardInputIsKnownByItsContent) {
  const std::string samples = std::string(MICROSWARM_SOURCE_DIR) + "/tests/samples/";
  for (const std::string name :
       {"maze.pgm --um-per-px 5", "blocks.map --um-per-px 5", "veins.csv",
        "vessels/retina_mask.png --um-per-px 5", "../../scenarios/maps/retina.geojson"}) {
    const std::string file = samples + name.substr(0, name.find(' '));
    const std::string scale = name.substr(std::min(name.find(' '), name.size()));
    const Outcome read = shell("microswarm map info " + file + scale + " --json");
    const Outcome piped = shell("cat " + file + " | microswarm map info -" + scale + " --json");
    EXPECT_EQ(read.code, 0) << read.err;
    EXPECT_EQ(piped.out, read.out) << name << piped.err;
  }
  const Outcome unknown = shell("echo hello | microswarm map info -");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(is_one_line_naming(unknown.err, "microswarm: /dev/stdin", {"no map"}));
}

/// The picture of a ROS map from standard input counts from the working folder.
TEST_F(InputFiles, ARosMapFromStandardInputFindsItsPicture) {
  write("room.pgm", "P2 3 1 255 0 254 254\n");
  write("room.yaml", "image: room.pgm\nresolution: 0.05\norigin: [0, 0, 0]\n");
  const Outcome read = run({"map", "info", "room.yaml", "--json"});
  EXPECT_EQ(read.code, 0) << read.err;
  for (const char* line : {"cat room.yaml | microswarm map info - --json",
                           "microswarm map info <(cat room.yaml) --um-per-unit 1e6 --json"}) {
    const Outcome piped = shell(line);
    EXPECT_EQ(piped.out, read.out) << line << piped.err;
  }
  const Outcome gone = shell("sed s/room.pgm/gone.pgm/ room.yaml | microswarm map info -");
  EXPECT_EQ(gone.code, 2);
  EXPECT_TRUE(is_one_line_naming(gone.err, "microswarm: gone.pgm", {"No such file"}));
}

TEST_F(InputFiles, AFileOfAnotherKindIsCalledByItsKind) {
  write("sweep.yaml", "scenario: flight.yaml\ntrials: 2\n");
  write("rig.yaml", "coils: helmholtz.yaml\ndriver: {type: simulated}\n");
  refused({"sweep", "flight.yaml"}, naming("flight.yaml", {"a scenario", "microswarm run"}));
  refused({"run", "sweep.yaml"}, naming("sweep.yaml", {"a sweep", "microswarm sweep"}));
  refused({"run", "rig.yaml"}, naming("rig.yaml", {"a rig", "--rig"}));
  refused({"rig", "check", "flight.yaml"}, naming("flight.yaml", {"a scenario", "rig"}));
}

TEST_F(InputFiles, AllThatIsMissingIsSaidAtOnce) {
  write("name.yaml", "name: x\n");
  const Outcome outcome = run({"run", "name.yaml"});
  EXPECT_EQ(outcome.code, 2);
  for (const char* key : {"'map'", "'start'", "'goal_um'"})
    EXPECT_NE(outcome.err.find("missing key " + std::string(key)), std::string::npos)
        << outcome.err;
}

}  // namespace
}  // namespace microswarm::test

// SPDX-License-Identifier: Apache-2.0
// Inputs for several robots: the command `global`.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

constexpr const char* robots = "60,300;60,250";
constexpr const char* goals = "330,300;330,200";

class Global : public CommandLine {
 protected:
  Global() {
    write("l.csv",
          "0,0,400,50\n0,350,400,50\n0,0,50,400\n350,0,50,400\n"
          "175,150,100,25\n150,150,25,100\n");
    write("other.csv",
          "0,0,400,50\n0,350,400,50\n0,0,50,400\n350,0,50,400\n"
          "175,150,100,20\n150,150,25,100\n");
  }
};

TEST_F(Global, PlansAndDraws) {
  const Arguments words{"global", "l.csv", "--robots", robots, "--goals", goals};
  const std::string said = good(words);
  EXPECT_TRUE(said.starts_with("plan of ")) << said;
  EXPECT_NE(said.find("\ninput_x_um,input_y_um,times\n"), std::string::npos);
  Arguments more = words;
  for (const char* word : {"--picture", "ways.png", "--json", "--as-found"}) more.push_back(word);
  const Json json = Json::parse(good(more));
  EXPECT_TRUE(exists("ways.png"));
  EXPECT_EQ(json.at("status"), "solved");
  EXPECT_LE(json.at("worst_um"), 20);
  EXPECT_EQ(json.at("input_count"), json.at("input_count_found"));
  std::size_t inputs = 0;
  for (const Json& run : json.at("inputs")) inputs += run.at("times").get<std::size_t>();
  EXPECT_EQ(inputs, json.at("input_count"));
  EXPECT_EQ(json.at("ways_um").size(), 2u);
  EXPECT_EQ(json.at("ways_um")[0].size(), inputs + 1);
}

TEST_F(Global, ATreeIsKeptAndAskedAgain) {
  const std::string said = good({"global", "l.csv", "--robots", robots, "--save-tree", "tree.h5",
                                 "--set", "planner.max_nodes=30000"});
  EXPECT_TRUE(said.starts_with("tree of 30000 nodes")) << said;
  EXPECT_TRUE(said.ends_with("wrote tree.h5\n"));
  const Json json = Json::parse(good({"global", "l.csv", "--tree", "tree.h5", "--goals", goals,
                                      "--json", "--set", "planner.goal_tolerance_um=40"}));
  EXPECT_EQ(json.at("status"), "solved");
  EXPECT_EQ(json.at("nodes"), 30000);
  refused(
      {"global", "l.csv", "--tree", "tree.h5", "--goals", goals, "--set", "planner.contact=stop"},
      "tree.h5: was grown with contact slide, not stop");
  refused({"global", "l.csv", "--tree", "tree.h5", "--goals", "330,300"},
          naming("goals", {"1", "2", "robots"}));
  refused({"global", "l.csv", "--tree", "l.csv", "--goals", goals},
          naming("l.csv", {"HDF5", "damaged"}));
  const Outcome other = run({"global", "other.csv", "--tree", "tree.h5", "--goals", goals});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(other.err.starts_with("microswarm: tree.h5: ") && names(other.err, "map"))
      << other.err;
}

TEST_F(Global, SaysWhatIsWrong) {
  refused({"global", "l.csv", "--goals", goals}, naming("global", {"--robots", "start", "--tree"}));
  refused({"global", "l.csv", "--robots", robots}, naming("global", {"--goals", "--save-tree"}));
  refused({"global", "l.csv", "--robots", "160,160;60,250", "--goals", goals},
          naming("l.csv", {"robot 1", "start", "10 µm", "wall 2"}));
  refused({"global", "l.csv", "--robots", robots, "--goals", "330,300;20,20", "--set",
           "planner.goal_tolerance_um=5"},
          naming("l.csv", {"robot 2", "goal", "20 µm", "wall 1"}));
  refused({"global", "l.csv", "--robots", "60,250;60,251", "--goals", goals, "--set",
           "planner.separation_um=10"},
          naming("l.csv", {"separation_um", "10"}));
  refused({"global", "l.csv", "--robots", "60,300;60,300", "--goals", goals},
          naming("l.csv", {"1", "2", "start"}));
  refused({"global", "l.csv", "--robots", robots, "--save-tree", "l.csv"},
          "l.csv: is the input, which would be lost");
  refused({"global", "l.csv", "--robots", "60 250", "--goals", goals},
          naming("--robots", {"60,300;60,250", "60 250", "microswarm global --help"}));
  refused({"global", "l.csv", "--robots", robots, "--goals", goals, "--save-tree", "t.h5", "--set",
           "planner.type=global_search"},
          naming("global", {"--save-tree", "planner.type", "global_rrt"}));
}

TEST_F(Global, GivesUpAtTheTimeLimit) {
  const Outcome outcome =
      run({"global", "l.csv", "--robots", "60,300;60,250;60,200;60,150;60,100;110,300", "--goals",
           "330,300;330,200;330,250;330,150;330,100;280,300", "--time-limit", "0.1", "--json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(Json::parse(outcome.out).at("status"), "time_limit");
}

}  // namespace
}  // namespace microswarm::test

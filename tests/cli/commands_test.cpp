// SPDX-License-Identifier: Apache-2.0
// What the commands print when all is well, and with which exit code they end.
#include <map>
#include <nlohmann/json.hpp>

#include "inputs.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

using Json = nlohmann::json;

class Commands : public CommandLine {
 protected:
  Commands() { write("flight.yaml", noisy_rooms()); }
};

TEST_F(Commands, HelpAndVersion) {
  EXPECT_NE(good({"--help"}).find("Exit codes:"), std::string::npos);
  EXPECT_NE(good({"--version"}).find('.'), std::string::npos);
}

TEST_F(Commands, RunReachesTheGoal) {
  const std::string said = good({"run", "flight.yaml", "--out", "out"});
  EXPECT_TRUE(said.starts_with("goal reached after ")) << said;
  for (const char* name :
       {"run.h5", "index.html", "overview.png", "overview.svg", "overview.pdf", "plots.png"})
    EXPECT_TRUE(exists(std::string("out/") + name)) << name;
  EXPECT_EQ(files().size(), 10U);  // and moment-1.png to moment-1.pdf, flight.yaml
  EXPECT_TRUE(good({"report", "out/run.h5", "--out", "page"}).ends_with("page/index.html\n"));
}

TEST_F(Commands, AReportsVideoIsAGif) {
  good({"run", "flight.yaml", "--out", "out", "--no-report"});
  EXPECT_EQ(good({"report", "out/run.h5", "--video", "run.gif", "--from", "0.5", "--to", "1",
                  "--fps", "20", "--width", "240"}),
            "wrote run.gif: 11 pictures\n");
  EXPECT_TRUE(read("run.gif").starts_with("GIF89a"));
  const Outcome fast = run({"report", "out/run.h5", "--video", "fast.gif", "--fps", "60"});
  EXPECT_TRUE(is_one_line_naming(fast.err, "microswarm: fast.gif", {"50"})) << fast.err;
  EXPECT_FALSE(exists("fast.gif"));
}

TEST_F(Commands, RunThatDoesNotReachTheGoal) {
  const Outcome outcome = run({"run", "flight.yaml", "--set", "time_limit_s=0.5", "--json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(Json::parse(outcome.out).at("status"), "time_limit");
}

TEST_F(Commands, RunThatIsHeldSaysWhy) {
  write("wait.yaml",
        "map: {type: rectangles, lo_um: [0, 0], hi_um: [2000, 800], rectangles_um: "
        "[[1000, 0, 60, 250], [1000, 550, 60, 250]]}\n"
        "obstacles:\n"
        "  - shape: {type: valve, span_um: 300, min_gap_um: 0, max_gap_um: 200, period_s: "
        "1000, phase: -0.25}\n"
        "    motion: {type: still, position_um: [1030, 400]}\n"
        "swarm: {type: vortex, radius_um: 50, moving_radius_um: 50}\n"
        "start: {x_um: 700, y_um: 400}\n"
        "goal_um: [1600, 400]\n"
        "hold_limit_s: 20\n"
        "navigator:\n"
        "  type: radar\n"
        "  wait_zones:\n"
        "    - {centre_um: [1030, 400], width_um: 600, height_um: 400, min_gap_um: 190}\n");
  const Outcome outcome = run({"run", "wait.yaml", "--out", "wait"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err, "");
  const std::string first = outcome.out.substr(0, outcome.out.find('\n'));
  EXPECT_TRUE(is_one_line_naming(first, "held", {"valve"}));
  EXPECT_TRUE(names(outcome.out, "avoidance cost")) << outcome.out;
  EXPECT_NE(read("wait/index.html").find("held (wait)"), std::string::npos);
  EXPECT_NE(read("wait/index.html").find("mean avoidance cost δ"), std::string::npos);
  EXPECT_NE(read("wait/overview.svg").size(), 0U);
}

TEST_F(Commands, OddSettingsGetAHint) {
  const Outcome outcome =
      run({"run", "flight.yaml", "--set", "tick_s=10", "--set", "time_limit_s=20"});
  EXPECT_TRUE(is_one_line_naming(outcome.err, "note", {"tick_s", "10", "1200 µm", "80 µm"}));
}

TEST_F(Commands, RunAsJson) {
  const Json run = Json::parse(good({"run", "flight.yaml", "--json", "--seed", "7"}));
  EXPECT_EQ(run.at("status"), "solved");
  EXPECT_GT(run.at("metrics").at("length_um"), 1300);
  EXPECT_GE(run.at("planning").at("count"), 1);
  EXPECT_EQ(run.at("record_hash").get<std::string>().size(), 16U);
  const Json again = Json::parse(good({"run", "flight.yaml", "--json", "--set", "seed=7"}));
  EXPECT_EQ(run.at("record_hash"), again.at("record_hash"));
  const Json other = Json::parse(good({"run", "flight.yaml", "--json", "--seed", "8"}));
  EXPECT_NE(run.at("record_hash"), other.at("record_hash"));
}

TEST_F(Commands, TrialsThatAreOneRunAreNoted) {
  const fs::path shipped = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  const std::map<std::string, bool> is_one_run{{"papers/radar/twelve.yaml", true},
                                               {"papers/radar/single.yaml", true},
                                               {"first_rig.yaml", true},
                                               {"oncoming.yaml", false},
                                               {"first_flight.yaml", false}};
  for (const auto& [file, same] : is_one_run) {
    const Outcome outcome = run(
        {"run", (shipped / file).string(), "--trials", "3", "--json", "--set", "time_limit_s=6"});
    const Json all = Json::parse(outcome.out);
    std::set<std::string> records;
    for (const Json& trial : all.at("trials")) records.insert(trial.at("record_hash"));
    EXPECT_EQ(records.size(), same ? 1U : 3U) << file;
    EXPECT_EQ(all.at("notes").size(), same ? 1U : 0U) << file;
    EXPECT_EQ(names(outcome.err, "all 3 trials are the same run"), same) << file;
  }
}

TEST_F(Commands, TrialsAreTheSameOnAnyNumberOfThreads) {
  const auto hashes = [&](const char* jobs) {
    const Json all = Json::parse(
        good({"run", "flight.yaml", "--trials", "4", "--jobs", jobs, "--json", "--out", jobs}));
    Json list = Json::array();
    for (const Json& trial : all.at("trials")) list.push_back(trial.at("record_hash"));
    return list;
  };
  const Json one = hashes("1");
  EXPECT_EQ(one.size(), 4U);
  EXPECT_EQ(one, hashes("2"));
  const std::string csv = read("1/trials.csv");
  EXPECT_TRUE(
      csv.starts_with("trial,status,time_s,length_um,turning_rad,goal_distance_um,"
                      "hold_time_s,walls_clearance_um,walls_t_s,obstacles_clearance_um,"
                      "obstacles_t_s,avoidance_mean_cost,avoidance_time_s,"
                      "avoidance_mean_gap_um,avoidance_least_gap_um,planning_events,"
                      "contacts,avoidable_contacts,planning_mean_s,planning_max_s,"
                      "record_hash\n"))
      << csv;
  for (const Json& hash : one) EXPECT_NE(csv.find(hash.get<std::string>()), std::string::npos);
  EXPECT_EQ(Json::parse(good({"run", "flight.yaml", "--json"})).at("record_hash"), one[0]);
}

TEST_F(Commands, ReplaySaysIdentical) {
  const Json run = Json::parse(good({"run", "flight.yaml", "--out", "out", "--json"}));
  const std::string hash = run.at("record_hash");
  EXPECT_EQ(good({"replay", "out/run.h5"}), "identical: record " + hash + "\n");
  const Json again = Json::parse(good({"replay", "out/run.h5", "--json"}));
  EXPECT_EQ(again.at("identical"), true);
  EXPECT_EQ(again.at("record_hash"), hash);
}

TEST_F(Commands, ReproduceRows) {
  const Outcome outcome = run({"reproduce", "drrt/fig5a", "--quick", "--json"});
  const Json rows = Json::parse(outcome.out).at("rows");
  bool all_ok = true;
  ASSERT_FALSE(rows.empty());
  for (const Json& row : rows) {
    for (const char* key : {"figure", "quantity", "unit", "paper", "ours", "aim", "ok"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_TRUE(row.at("ok").is_boolean() || row.at("ok").is_null());
    EXPECT_TRUE(!row.at("aim").is_null() || row.at("ok").is_null()) << row;
    all_ok = all_ok && row.at("ok") != false;
  }
  EXPECT_EQ(outcome.code, all_ok ? 0 : 3);
  EXPECT_EQ(outcome.err, "quick: fewer seeds\n");
}

TEST_F(Commands, GatherBringsRobotsTogether) {
  write("t.csv", "x_um,y_um,width_um,height_um\n0,0,45,40\n55,0,45,40\n0,50,100,1\n");
  const Arguments command{"gather", "t.csv", "--goal", "50,3", "--robots", "32"};
  Arguments with_pictures = command;
  with_pictures.insert(with_pictures.end(), {"--out", "out"});
  const Outcome gathered = run(with_pictures);
  EXPECT_EQ(gathered.code, 0);
  EXPECT_TRUE(gathered.out.starts_with("gathered after "));
  EXPECT_TRUE(is_one_line_naming(gathered.err, "note",
                                 {"2 regions", "5", "heuristic", "divide_and_conquer"}));
  EXPECT_TRUE(exists("out/before.png"));
  EXPECT_TRUE(exists("out/after.png"));
  Arguments few_steps = command;
  few_steps.insert(few_steps.end(), {"--max-steps", "3", "--json"});
  const Outcome outcome = run(few_steps);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(Json::parse(outcome.out).at("status"), "time_limit");
  refused({"gather", "t.csv", "--goal", "10,10"}, naming("t.csv", {"goal", "10 µm", "wall 1"}));
  refused({"gather", "t.csv", "--goal", "50,3", "--robots", "0"},
          naming("--robots", {"1..1000000", "0", "microswarm gather --help"}));
}

TEST_F(Commands, SchemaHasTheKeysOfGlobal) {
  const std::string keys = good({"schema", "global", "--keys"});
  for (const char* key :
       {"type: global_search", "type: global_rrt", "separation_um", "robostep_um"})
    EXPECT_NE(keys.find(key), std::string::npos) << key;
}

TEST_F(Commands, SchemaIsJson) {
  const Json schema = Json::parse(good({"schema"}));
  EXPECT_EQ(schema.at("type"), "object");
  EXPECT_TRUE(schema.at("properties").contains("navigator"));
  EXPECT_NE(good({"schema", "--keys"}).find("max_speed_um_per_s"), std::string::npos);
  for (const auto& [kind, key] : {std::pair{"sweep", "scenario"},
                                  {"rig", "driver"},
                                  {"queue", "entries"},
                                  {"coils", "drives"},
                                  {"track", "find"}}) {
    EXPECT_TRUE(Json::parse(good({"schema", kind})).at("properties").contains(key)) << kind;
    EXPECT_NE(good({"schema", kind, "--keys"}).find(key), std::string::npos) << kind;
  }
  refused({"schema", "planet"},
          naming("kind", {"scenario", "sweep", "rig", "queue", "coils", "track", "global", "planet",
                          "microswarm schema --help"}));
}

}  // namespace
}  // namespace microswarm::test

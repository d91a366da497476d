// SPDX-License-Identifier: Apache-2.0
// Every key that --json prints is on the page of the JSON.
#include <nlohmann/json.hpp>
#include <set>

#include "inputs.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

using PrintedJson = nlohmann::json;

/// Words in backquotes of a page; of one of its sections if it is named.
std::set<std::string> quoted_words(const std::string& page, const std::string& section = "") {
  std::string text = read_file(fs::path(MICROSWARM_SOURCE_DIR) / "docs/reference" / page);
  if (!section.empty()) {
    const std::size_t begin = text.find("\n## " + section);
    EXPECT_NE(begin, std::string::npos) << section;
    text = text.substr(begin, text.find("\n## ", begin + 1) - begin);
  }
  std::set<std::string> words;
  for (std::size_t at = text.find('`'); at != text.npos; at = text.find('`', at + 1)) {
    const std::size_t end = text.find('`', at + 1);
    words.insert(text.substr(at + 1, end - at - 1));
    at = end;
  }
  return words;
}

/// Objects whose keys are the user's or other pages'.
bool is_described_elsewhere(const std::string& key) {
  return std::set<std::string>{"metrics",          "planner",    "medians", "parameters",
                               "radius_um_within", "rig_timing", "status"}
      .contains(key);
}

void collect_keys(const PrintedJson& json, std::set<std::string>& keys) {
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    if (json.is_object()) keys.insert(key);
    if (!json.is_object() || !is_described_elsewhere(key)) collect_keys(value, keys);
  }
}

class JsonOutput : public CommandLine {};

TEST_F(JsonOutput, EveryKeyIsOnItsPage) {
  write("flight.yaml", two_rooms());
  write("sweep.yaml", "scenario: flight.yaml\ntrials: 1\n");
  write("queue.yaml", "entries: [{scenario: " MICROSWARM_SOURCE_DIR
                      "/scenarios/first_rig.yaml, time_budget_s: 0.5}]\n");
  const std::string video = "samples/video";
  const std::vector<std::pair<std::string, Arguments>> commands{
      {"run", {"run", "flight.yaml", "--out", "out"}},
      {"run", {"run", "flight.yaml", "--trials", "2"}},
      {"run",
       {"gather", "samples/maze.pgm", "--map-um-per-px", "5", "--goal", "60,60", "--robots", "4",
        "--max-steps", "3"}},
      {"plan", {"plan", "retina", "--start", "2323,3816", "--goal", "3499,2838"}},
      {"global",
       {"global", "samples/veins.csv", "--robots", "20,60;20,50", "--goals", "180,60;180,50"}},
      {"sweep", {"sweep", "sweep.yaml", "--out", "s.db"}},
      {"map", {"map", "info", "retina"}},
      {"map", {"map", "check", "retina"}},
      {"map", {"map", "graph", "retina"}},
      {"map", {"map", "segment", "samples/vessels/retina.png", "--um-per-px", "6"}},
      {"track",
       {"track", video, "--um-per-px", "0.35", "--rate", "20", "--set", "find.diameter_px=11",
        "--out", "t", "--motion"}},
      {"track", {"track", video, "--suggest"}},
      {"replay", {"replay", "out/run.h5"}},
      {"rig", {"rig", "field", "cube", "--at", "0,0,0", "--field", "90,0,0"}},
      {"rig", {"rig", "map", "helmholtz", "--out", "even.csv"}},
      {"rig", {"rig", "cameras"}},
      {"rig",
       {"rig", "scale", "samples/rig/grid.png", "--grid", "9x6", "--pitch", "100", "--pattern",
        "chessboard"}},
      {"rig", {"rig", "see", "samples/rig/frame.png"}},
      {"rig", {"rig", "see", "samples/rig/grid.png"}},
      {"rig", {"rig", "calibrate", "samples/coils/measured.csv", "--out", "coils.yaml"}},
      {"queue of a rig",
       {"rig", "queue", "queue.yaml", "--rig", "vortex", "--dry-run", "--out", "queue"}},
      {"reproduce", {"reproduce", "drrt/fig5a", "--quick"}}};
  for (auto [section, words] : commands) {
    words.emplace_back("--json");
    const Outcome outcome = run(words);
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 3)
        << words[0] << " " << words[1] << ": " << outcome.err;
    const PrintedJson printed = PrintedJson::parse(outcome.out, nullptr, false);
    ASSERT_FALSE(printed.is_discarded()) << words[1] << outcome.err;
    std::set<std::string> keys;
    collect_keys(printed, keys);
    EXPECT_FALSE(keys.empty());
    const std::set<std::string> known = quoted_words("json.md", section);
    for (const std::string& key : keys)
      EXPECT_TRUE(known.contains(key)) << words[0] << " " << words[1] << ": " << key;
  }
}

TEST_F(JsonOutput, MetricsAreThoseOfRecordsAndOfThePageBefore) {
  write("flight.yaml", two_rooms());
  const PrintedJson ran = PrintedJson::parse(run({"run", "flight.yaml", "--json"}).out);
  std::set<std::string> keys;
  collect_keys(ran.at("metrics"), keys);
  std::set<std::string> known = quoted_words("record.md");
  known.merge(quoted_words("json.md", "run"));
  EXPECT_GT(keys.size(), 8U);
  for (const std::string& key : keys) EXPECT_TRUE(known.contains(key)) << key;
}

TEST_F(JsonOutput, APlannersKeysAreThoseOfFiles) {
  const PrintedJson made = PrintedJson::parse(
      run({"plan", "retina", "--start", "2323,3816", "--goal", "3499,2838", "--json"}).out);
  std::set<std::string> keys;
  collect_keys(made.at("planner"), keys);
  const std::set<std::string> known = quoted_words("parameters.md");
  for (const std::string& key : keys) EXPECT_TRUE(known.contains(key)) << key;
}

}  // namespace
}  // namespace microswarm::test

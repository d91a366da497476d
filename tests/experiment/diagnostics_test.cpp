// SPDX-License-Identifier: Apache-2.0
#include "microswarm/contracts/diagnostics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <span>

#include "microswarm/experiment/record/diagnostics_log.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::experiment {
namespace {

const std::filesystem::path all_scenarios =
    std::filesystem::path(MICROSWARM_SOURCE_DIR) / "scenarios";

/// Diagnostics of every tick up to the end.
std::vector<Diagnostics> diagnostics_of(Session& session) {
  std::vector<Diagnostics> all;
  while (session.step()) all.push_back(session.diagnostics());
  return all;
}

std::size_t diagnostics_rows(const DiagnosticsLog& log) {
  std::size_t rows = 0;
  DiagnosticsLog::fields(log, [&](const auto& table, const FieldInfo&) { rows += table.size(); });
  return rows;
}

struct DiagnosticsCase {
  const char* name;
  const char* file;
  std::vector<std::string> settings;
  std::size_t kind;  ///< index in Diagnostics
};

std::vector<std::string> with_diagnostics(std::vector<std::string> settings) {
  settings.push_back("record.diagnostics=true");
  return settings;
}

class KeptDiagnostics : public testing::TestWithParam<DiagnosticsCase> {};

TEST_P(KeptDiagnostics, AreShownAgainAndReplayed) {
  const auto& [name, file, settings, kind] = GetParam();
  const auto live = open_session(all_scenarios / file, Settings(with_diagnostics(settings), ""));
  const std::vector<Diagnostics> then = diagnostics_of(*live);
  const auto shown = std::ranges::count(then, kind, &Diagnostics::index);
  EXPECT_GT(shown, 3);
  EXPECT_EQ(diagnostics_rows(live->record().diagnostics),
            static_cast<std::size_t>(std::ranges::count_if(std::span(then).first(then.size() - 1),
                                                           &Diagnostics::index)));

  const test::Folder folder;
  live->record_to(folder / "run.h5");
  const auto playback = open_session(folder / "run.h5");
  const std::vector<Diagnostics> again = diagnostics_of(*playback);
  ASSERT_EQ(again.size(), then.size());
  for (std::size_t i = 0; i < then.size(); ++i) ASSERT_EQ(again[i], then[i]) << "frame " << i;
  ASSERT_TRUE(playback->seek(then.size() / 2));
  EXPECT_EQ(playback->diagnostics(), then[then.size() / 2]);
  EXPECT_EQ(replay(playback->record()).difference, "");

  const auto bare = open_session(all_scenarios / file, Settings(settings, ""));
  bare->finish();
  EXPECT_TRUE(bare->record().diagnostics.empty());
  EXPECT_EQ(bare->record().hash(), live->record().hash());
}

TEST_P(KeptDiagnostics, AreNoneWhereNoSwarmWasSeen) {
  std::vector<std::string> settings = with_diagnostics(GetParam().settings);
  settings.insert(settings.end(), {"sensing.missed_share=0.8", "sensing.frame_timeout_s=0.15"});
  const auto session = open_session(all_scenarios / GetParam().file, Settings(settings, ""));
  session->finish();
  const Record& record = session->record();
  int blind = 0;
  for (const Frame& frame : record.frames) {
    if (frame.state != NavigatorState::blind) continue;
    ++blind;
    EXPECT_EQ(record.diagnostics.at(frame.t), Diagnostics()) << frame.t;
  }
  EXPECT_GT(blind, 3);
}

INSTANTIATE_TEST_SUITE_P(
    Navigators, KeptDiagnostics,
    testing::Values(
        DiagnosticsCase{"Radar", "papers/radar/twelve.yaml", {"time_limit_s=6"}, 1},
        DiagnosticsCase{
            "RadarWithNoise",
            "papers/radar/twelve.yaml",
            {"time_limit_s=4", "sensing.obstacle_noise_um=5", "sensing.missed_share=0.4"},
            1},
        DiagnosticsCase{"Gathering", "papers/gather/t_junction.yaml", {"time_limit_s=3"}, 2},
        DiagnosticsCase{"Rollout",
                        "papers/gather/t_junction.yaml",
                        {"time_limit_s=2", "navigator.method=rollout"},
                        2},
        DiagnosticsCase{"SafeInterval",
                        "papers/radar/twelve.yaml",
                        {"time_limit_s=3", "navigator.type=safe_interval"},
                        3},
        DiagnosticsCase{"SafeIntervalAmongPolygons",
                        "papers/drrt/moving_obstacles.yaml",
                        {"time_limit_s=3", "navigator.type=safe_interval"},
                        3},
        DiagnosticsCase{
            "Hierarchical", "papers/drrt/moving_obstacles.yaml", {"time_limit_s=6"}, 4}),
    [](const auto& of) { return of.param.name; });

TEST(Diagnostics, AReplayNamesWhatDiffers) {
  const auto session = open_session(all_scenarios / "papers/radar/single.yaml",
                                    Settings(with_diagnostics({"time_limit_s=2"}), ""));
  session->finish();
  Record record = session->record();
  ASSERT_GT(record.diagnostics.radar.size(), 4u);
  record.diagnostics.radar[3].shown.target.x += 1e-9;
  EXPECT_TRUE(test::is_one_line_naming(replay(record).difference, "",
                                       {"diagnostics/radar 3", "target_x_um"}))
      << replay(record).difference;
  record = session->record();
  record.diagnostics.radar[4].shown.beams[7].score += 1e-9;
  EXPECT_TRUE(test::is_one_line_naming(replay(record).difference, "",
                                       {"diagnostics/radar/beams 4", "score"}))
      << replay(record).difference;
}

/// A navigator that counts how often it is asked for its diagnostics.
class Asked : public GoStraight {
 public:
  using GoStraight::GoStraight;
  Diagnostics diagnostics() const override {
    ++times;
    return HierarchicalDiagnostics{.towards = {1, 2}};
  }
  mutable int times = 0;
};

struct Asking : RunListener {
  void on_tick(const Tick& tick) override {
    seen += std::holds_alternative<HierarchicalDiagnostics>(tick.diagnostics.value());
  }
  int seen = 0;
};

TEST(Diagnostics, AreComputedOnRequestAndOncePerTick) {
  const Scenario scenario = open_room();
  Asked navigator(*scenario.goal, 60);
  const auto run = [&](std::initializer_list<RunListener*> listeners) {
    navigator.times = 0;
    Session session({{scenario, {}}, world_of(scenario), {}}, {.navigator = borrowed(navigator)});
    for (RunListener* listener : listeners) session.listen(*listener);
    session.finish();
    EXPECT_TRUE(session.record().diagnostics.empty());
    return static_cast<int>(session.record().frames.size());
  };
  run({});
  EXPECT_EQ(navigator.times, 0);
  Asking first, second;
  const int ticks = run({&first, &second});
  EXPECT_EQ(navigator.times, ticks);
  EXPECT_EQ(first.seen, ticks);
  EXPECT_EQ(second.seen, ticks);
}

TEST(Diagnostics, AreThoseOfWhoSteers) {
  Scenario scenario = open_room();
  scenario.record.diagnostics = true;
  const auto navigator = std::make_shared<Asked>(*scenario.goal, 60);
  Session session({load_scene(scenario, {}), world_of(scenario), {}}, {.navigator = navigator});
  ASSERT_TRUE(session.step());
  EXPECT_NE(session.diagnostics().index(), 0u);
  session.operation()->pause();
  ASSERT_TRUE(session.step());
  EXPECT_NE(session.diagnostics().index(), 0u);
  session.operation()->pause(false);
  session.operation()->manual();
  ASSERT_TRUE(session.step());
  EXPECT_EQ(session.diagnostics().index(), 0u);
  session.operation()->manual(false);
  session.finish();
  EXPECT_EQ(replay(session.record()).difference, "");  // of an external navigator
  Session playback(session.record());
  ASSERT_TRUE(playback.seek(1));
  EXPECT_NE(playback.diagnostics().index(), 0u);
  ASSERT_TRUE(playback.step());
  EXPECT_EQ(playback.diagnostics().index(), 0u);
}

TEST(Diagnostics, OfAnotherNavigatorFollowItsFirstStep) {
  const auto session = open_session(all_scenarios / "papers/radar/twelve.yaml",
                                    Settings(with_diagnostics({"time_limit_s=4"}), ""));
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(session->step());
  const Diagnostics before = session->diagnostics();
  EXPECT_EQ(before.index(), 1u);
  ASSERT_TRUE(session->set("navigator.type", "safe_interval").empty());
  EXPECT_EQ(session->diagnostics(), before);
  ASSERT_TRUE(session->step());
  EXPECT_EQ(session->diagnostics().index(), 3u);
  session->finish();
  EXPECT_EQ(replay(session->record()).difference, "");
}

TEST(DiagnosticsLog, KeepsATreeOnce) {
  DiagnosticsLog log;
  AggregationDiagnostics plan;
  plan.nodes.resize(3);
  plan.regions.resize(1);
  for (int i = 0; i < 4; ++i) {
    plan.mean_distance = i;
    if (i == 2) plan.nodes.resize(5);
    log.add(0.1 * i, plan);
  }
  EXPECT_EQ(log.aggregation[0].shown.nodes.size(), 3u);
  EXPECT_TRUE(log.aggregation[1].shown.nodes.empty());
  EXPECT_EQ(log.aggregation[2].shown.nodes.size(), 5u);
  EXPECT_TRUE(log.aggregation[3].shown.nodes.empty());
  const auto at = [&](int i) { return std::get<AggregationDiagnostics>(log.at(0.1 * i)); };
  EXPECT_EQ(at(1).nodes.size(), 3u);
  EXPECT_EQ(at(1).regions.size(), 1u);
  EXPECT_EQ(at(1).mean_distance, 1);
  EXPECT_EQ(at(3), plan);
  EXPECT_EQ(log.at(0.05).index(), 0u);
}

TEST(DiagnosticsLog, IsThinnedButForItsTrees) {
  DiagnosticsLog log;
  for (int i = 0; i < 8; ++i) {
    AggregationDiagnostics plan{.mean_distance = static_cast<double>(i)};
    plan.nodes.resize(i < 3 ? 3 : 5);
    log.add(i, plan);
  }
  log.thin();
  std::vector<double> times;
  for (const auto& row : log.aggregation) times.push_back(row.t);
  EXPECT_EQ(times, (std::vector<double>{0, 2, 3, 4, 6}));
  EXPECT_EQ(std::get<AggregationDiagnostics>(log.at(2)).nodes.size(), 3u);
  EXPECT_EQ(std::get<AggregationDiagnostics>(log.at(6)).nodes.size(), 5u);
}

TEST(DiagnosticsLog, ADamagedTableIsNamed) {
  AggregationDiagnostics plan;
  plan.nodes.resize(3);
  plan.regions.resize(1);
  const Record flight = record_of(small_flight());
  const auto refused_after = [&](auto damage) {
    Record record = flight;
    record.diagnostics.add(0.1, plan);
    record.diagnostics.add(0.2, RadarDiagnostics{.beams = {{}, {}}});
    record.diagnostics.add(0.3, RadarDiagnostics{.beams = {{}, {}}});
    damage(record.diagnostics);
    const auto file = empty_folder("damaged_diagnostics") / "record.h5";
    write_record(record, file);
    try {
      read_record(file);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  using Log = DiagnosticsLog;
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused_after([](Log&) {}), "");
  const std::vector<std::pair<std::function<void(Log&)>, std::string>> cases{
      {[](Log& log) { log.radar[1].shown.best = 2; }, "radar/best is no beam"},
      {[](Log& log) { log.radar[1].t = log.radar[0].t; }, "radar/t_s does not rise"},
      {[&](Log& log) { log.radar[0].t = nan; }, "radar/t_s does not rise"},
      {[](Log& log) { log.aggregation[0].shown.nodes[2].next = 3; },
       "aggregation/nodes: next is no node"},
      {[](Log& log) { log.aggregation[0].shown.nodes[1].region = 1; },
       "aggregation/nodes: region is no region"},
      {[](Log& log) { log.aggregation[0].shown.regions[0].gate = 3; },
       "aggregation/regions: node or gate is no node"},
      {[](Log& log) { log.aggregation[0].shown.regions[0].next = 1; },
       "aggregation/regions: next is no region"}};
  for (const auto& [damage, wanted] : cases)
    EXPECT_TRUE(refused_after(damage).ends_with("/diagnostics/" + wanted)) << refused_after(damage);
}

}  // namespace
}  // namespace microswarm::experiment

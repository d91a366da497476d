// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "bench/ompl_peer.hpp"
#include "bench/planning.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace microswarm::bench {
namespace {

/// Queries the peer for a path to the goal at every position and time at which our navigator
/// planned.
class PeerListener : public experiment::RunListener {
 public:
  PeerListener(Vec2 goal, double clearance) : goal_(goal), clearance_(clearance) {}
  void on_tick(const experiment::Tick& tick) override {
    const experiment::Frame& frame = tick.frame;
    const Snapshot& world = *tick.world;
    if (!frame.planned || !world.is_free(frame.pose.position, clearance_)) return;
    const OmplResult r = run_ompl(OmplPlanner::rrt_connect, {.world = world,
                                                             .start = frame.pose.position,
                                                             .goal = goal_,
                                                             .clearance = clearance_,
                                                             .goal_tolerance = 30,
                                                             .max_seconds = 0.2});
    times_.push_back(r.seconds);
  }
  const std::vector<double>& times() const { return times_; }

 private:
  Vec2 goal_;
  double clearance_;
  std::vector<double> times_;
};

std::vector<report::BenchRow> one_world(const char* name, const std::filesystem::path& file,
                                        int trials, const Stop& stop) {
  const experiment::Scene scene =
      experiment::load_scene(experiment::read_scenario(file), file.parent_path());
  const World world = experiment::build_world(scene);
  std::vector<double> ours;
  PeerListener peer(*scene.scenario.goal, 90);
  for (int trial = 0; trial < trials && !stop(); ++trial) {
    const auto number = static_cast<std::uint32_t>(trial);
    const experiment::RunResult r =
        experiment::simulate(scene.scenario, world, {.trial = number}, {}, stop);
    ours.insert(ours.end(), r.timing.planning.begin(), r.timing.planning.end());
    if (trial >= 5) continue;
    experiment::RunListener* const listeners[] = {&peer};
    experiment::simulate(scene.scenario, world, {.trial = number}, listeners, stop);
  }
  const experiment::TimeSummary mine = experiment::summarise(ours);
  const experiment::TimeSummary theirs = experiment::summarise(peer.times());
  const std::string title = std::string("replanning, ") + name;
  const std::string whom = "OMPL RRTConnect, same places, to the goal";
  return {{.name = title,
           .quantity = "time, mean",
           .unit = "ms",
           .ours = 1e3 * mine.mean,
           .peer = 1e3 * theirs.mean,
           .peer_name = whom,
           .aim = 0.05},
          {.name = title,
           .quantity = "time, p99",
           .unit = "ms",
           .ours = 1e3 * mine.p99,
           .peer = 1e3 * theirs.p99,
           .peer_name = whom},
          {.name = title,
           .quantity = "time, max",
           .unit = "ms",
           .ours = 1e3 * mine.max,
           .peer = 1e3 * theirs.max,
           .peer_name = whom,
           .aim = 0.3}};
}

}  // namespace

std::vector<report::BenchRow> replanning(const std::filesystem::path& scenarios, bool quick,
                                         const Stop& stop) {
  const auto folder = scenarios / "papers" / "drrt";
  const int trials = quick ? 10 : 100;
  std::vector<report::BenchRow> rows =
      one_world("deforming channel", folder / "deforming_channel.yaml", trials, stop);
  for (report::BenchRow& row :
       one_world("moving obstacles", folder / "moving_obstacles.yaml", trials, stop))
    rows.push_back(std::move(row));
  return rows;
}

}  // namespace microswarm::bench

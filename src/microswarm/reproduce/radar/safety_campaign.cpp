// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/radar/safety_campaign.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/navigation/make.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <mutex>
#include <numeric>
#include <utility>

#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/session/session.hpp"
#include "microswarm/io/columns.hpp"

namespace microswarm::reproduce {
namespace {

bool has_walls(const experiment::Scenario& scenario) {
  const auto* map = std::get_if<formats::PolygonsMap>(&scenario.map);
  return (map && (!map->walls.empty() || !map->discs.empty())) ||
         std::ranges::any_of(scenario.obstacles, [](const Obstacle& obstacle) {
           return std::holds_alternative<DeformingChannel>(obstacle.shape);
         });
}

/// Sets what a navigator must know of the swarm, and of a world with walls whose passages leave
/// `passage_gap` [µm] beside the swarm.
navigation::NavigatorParams suited(navigation::NavigatorParams params,
                                   const experiment::Scenario& scenario, double passage_gap) {
  const SwarmLimits swarm = swarm_limits(scenario.swarm);
  const double margin = swarm.radius + 0.8 * passage_gap;
  std::visit(
      Overloaded{[&](navigation::HierarchicalParams& p) {
                   p.speed = swarm.max_speed;
                   p.clearance = margin;
                 },
                 [&](navigation::RadarParams& p) {
                   p.speed = swarm.max_speed;
                   p.global_plan = has_walls(scenario);
                   p.planner.clearance = margin;
                 },
                 [&](OneOf<navigation::StraightParams, navigation::PotentialFieldParams,
                           navigation::VelocityObstacleParams, navigation::PathNavigatorParams,
                           navigation::SafeIntervalParams> auto& p) { p.speed = swarm.max_speed; },
                 [](OneOf<navigation::PlanExecutorParams, navigation::AggregationParams> auto&) {}},
      params);
  return params;
}

Contestant contestant(std::string name, const navigation::NavigatorParams& params) {
  return {std::move(name), [params](const experiment::Scenario& scenario, double passage_gap) {
            return suited(params, scenario, passage_gap);
          }};
}

/// A sample of a body's track, as formats/tracks.hpp reads it.
struct SampleRow {
  std::string id;
  double t = 0;
  Vec2 at;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.id, plain("id", "Body."));
    visit(self.t, s("t", "Time."));
    visit(self.at, um("", "Position."));
  }
};

navigation::RadarParams published_radar() {
  navigation::RadarParams params;
  params.as_published = true;
  return params;
}

/// Adds this alternative of NavigatorParams if it supports the task; the radar twice.
template <class Params>
void add(const navigation::Task& task, std::vector<Contestant>& out) {
  if (!navigation::unsupported_reason(navigation::NavigatorParams(Params{}), task).empty()) return;
  const std::string name(Params::type_name);
  out.push_back(contestant(name, Params{}));
  if constexpr (std::same_as<Params, navigation::RadarParams>)
    out.push_back(contestant(name + "_as_published", published_radar()));
}

template <std::size_t... I>
void add_all(const navigation::Task& task, std::vector<Contestant>& out,
             std::index_sequence<I...>) {
  (add<std::variant_alternative_t<I, navigation::NavigatorParams>>(task, out), ...);
}

Crossing crossed(const experiment::Scenario& scenario, const World& world, const Stop& stop) {
  experiment::ContactLog log;
  experiment::RunListener* const listeners[] = {&log};
  const experiment::RunResult result = experiment::simulate(scenario, world, {}, listeners, stop);
  Crossing out;
  out.ran = result.status != Status::stopped;
  out.status = result.status;
  const experiment::Metrics& metrics = result.metrics;
  out.arrived = metrics.goal_distance <= scenario.goal_tolerance + 1e-6;
  out.obstacles = scenario.obstacles.size();
  out.time = metrics.time;
  out.straight = (distance(scenario.start->position, *scenario.goal) - scenario.goal_tolerance) /
                 swarm_limits(scenario.swarm).max_speed;
  out.delta = metrics.avoidance.mean_cost;
  out.turning = metrics.turning;
  if (std::isfinite(metrics.avoidance.min_gap)) out.min_gap = metrics.avoidance.min_gap;
  out.hold_time = metrics.hold_time;
  const std::vector<double>& steps = result.timing.steps;
  out.step = std::accumulate(steps.begin(), steps.end(), 0.0) /
             std::max(1.0, static_cast<double>(steps.size()));
  if (out.ran) out.contacts = experiment::judge_contacts(scenario, world, 0, log);
  return out;
}

/// The stored crossing if there is one, otherwise that of a run, which is stored.
Crossing crossed(const experiment::Scenario& scenario, const World& world, CrossingKey key,
                 CrossingStore* store, const Stop& stop) {
  if (!store) return crossed(scenario, world, stop);
  key.input = crossing_input(scenario);
  if (std::optional<Crossing> stored = store->find(key)) return *std::move(stored);
  Crossing crossing = crossed(scenario, world, stop);
  if (crossing.ran) store->add(key, crossing);
  return crossing;
}

}  // namespace

std::vector<Contestant> contestants(const experiment::Scenario& example) {
  std::vector<Contestant> out;
  add_all(experiment::navigation_task(example), out,
          std::make_index_sequence<std::variant_size_v<navigation::NavigatorParams>>{});
  return out;
}

Crossings cross(const Course& course, const std::vector<Contestant>& who,
                const std::vector<int>& counts, CrossingStore* store,
                const std::function<void(double)>& progress, const Stop& stop) {
  Crossings out(who.size());
  for (std::size_t k = 0; k < who.size(); ++k)
    out[k].resize(static_cast<std::size_t>(std::max(0, counts[k])));
  const int most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  const double all = std::max(1.0, std::accumulate(counts.begin(), counts.end(), 0.0));
  int done = 0;
  std::mutex mutex;
  for_each_index(static_cast<std::size_t>(std::max(0, most)), 0, [&](std::size_t seed) {
    if (stop()) return;
    experiment::Scenario scenario = course.scenario(seed);
    const World world = course.world(scenario);
    int crossings = 0;
    for (std::size_t k = 0; k < who.size() && !stop(); ++k) {
      if (seed >= out[k].size()) continue;
      scenario.navigator = who[k].params(scenario, course.passage_gap);
      out[k][seed] = crossed(scenario, world, {course.name, who[k].name, seed, {}}, store, stop);
      ++crossings;
    }
    const std::lock_guard lock(mutex);
    done += crossings;
    progress(done / all);
  });
  return out;
}

void write_scenario(experiment::Scenario scenario, const std::filesystem::path& folder,
                    const std::string& stem) {
  const std::string file = stem + "-tracks.csv";
  std::vector<SampleRow> tracks;
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    Track* track = find_track(scenario.obstacles[i].motion);
    if (!track || !track->samples) continue;
    track->file = file;
    track->id = std::to_string(i + 1);
    const Samples& samples = *track->samples;
    for (std::size_t k = 0; k < samples.times.size(); ++k)
      tracks.push_back({track->id, samples.times[k], samples.points[k]});
  }
  scenario.name = stem;
  if (!tracks.empty()) write_file_atomically(folder / file, io::csv_table(tracks));
  write_file_atomically(folder / (stem + ".yaml"), experiment::scenario_text(scenario));
}

}  // namespace microswarm::reproduce

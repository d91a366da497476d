// SPDX-License-Identifier: Apache-2.0
#include "commands/run_output.hpp"

#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>

#include "microswarm/config/write.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/queries/gather_query.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/results/metrics_json.hpp"
#include "microswarm/experiment/run/progress.hpp"
#include "microswarm/navigation/gathering/aggregation_check.hpp"

namespace microswarm::cli {

nlohmann::ordered_json run_json(const experiment::RunResult& result, const std::string& hash) {
  return {{"status", to_string(result.status)},
          {"state", result.state},
          {"metrics", experiment::metrics_json_with_former_names(result.metrics)},
          {"planning", nlohmann::ordered_json::parse(
                           to_json_text(experiment::summarise(result.timing.planning)))},
          {"record_hash", hash}};
}

namespace {

/// Reason of a hold, by the navigator's state.
std::string reason(std::string_view state) {
  if (state == "stuck") return "it found no path";
  if (state == "wait") return "it waited for a valve";
  if (state == "blind") return "it saw no swarm, or too late";
  if (state == "hold") return "no move was safe";
  if (state == "arrived") return "it saw the swarm at the goal";
  return fmt::format("its state was '{}'", state);
}

}  // namespace

std::string ending(const experiment::RunResult& result) {
  switch (result.status) {
    case Status::solved:
      return "goal reached";
    case Status::time_limit:
      return "time limit";
    case Status::held:
      return fmt::format("held: {},", reason(result.state));
    case Status::collided:
      return "touched a wall or an obstacle";
    case Status::fault:
      return fmt::format("fault: {},", result.state);
    default:
      return std::string(to_string(result.status));
  }
}

namespace {

std::string um(double length) {
  return std::isfinite(length) ? fmt::format("{:.1f} µm", length) : "–";
}

std::string robots_summary(const experiment::RunResult& result,
                           const experiment::Scenario& scenario) {
  const RobotSwarmParams& robots = *scenario.robots;
  const experiment::Metrics& m = result.metrics;
  const bool gathered = result.status == Status::solved && robots.goals.empty();
  const std::string planning =
      robots.goals.empty() ? "" : fmt::format("  planning  {} times\n", m.planning_events);
  return fmt::format("{} after {:.1f} s and {} commands\n  {} {:.1f} µm, of at most {:.4g} µm\n{}",
                     gathered ? "gathered" : ending(result), m.time, result.timing.steps.size(),
                     robots.goals.empty() ? "goal      mean distance"
                                          : "goals     largest distance of a robot from its goal",
                     m.goal_distance, scenario.goal_tolerance, planning);
}

std::string avoidance_text(const experiment::Avoidance& a) {
  if (!std::isfinite(a.min_gap)) return {};
  const std::string mean = a.time > 0 ? fmt::format(", {} on average", um(a.mean_gap)) : "";
  return fmt::format(
      "  avoiding  {:.1f} s, mean avoidance cost {:.3g}; gap to obstacles {} at least{}\n", a.time,
      a.mean_cost, um(a.min_gap), mean);
}

std::string summary(const experiment::RunResult& result) {
  const experiment::Metrics& m = result.metrics;
  const experiment::TimeSummary p = experiment::summarise(result.timing.planning);
  std::string text = fmt::format("{} after {:.1f} s", ending(result), m.time);
  if (result.status != Status::solved)
    text += fmt::format(", {} from the goal", um(m.goal_distance));
  text += fmt::format("\n  path      {:.0f} µm long, turned {:.0f}° in total, held for {:.1f} s\n",
                      m.length, degrees(m.turning), m.hold_time);
  text += fmt::format("  nearest   wall {}, moving obstacle {} (from the swarm's centre)\n",
                      um(m.walls.clearance), um(m.obstacles.clearance));
  text += avoidance_text(m.avoidance);
  if (p.count == 0) return text + fmt::format("  planning  {} times\n", m.planning_events);
  return text + fmt::format("  planning  {} times, {:.3f} ms on average, {:.3f} ms the longest\n",
                            m.planning_events, 1e3 * p.mean, 1e3 * p.max);
}

/// Warns on stderr if a swarm moves far within a tick.
void note_tick(const experiment::Scenario& scenario) {
  if (scenario.robots) return;
  const SwarmLimits swarm = swarm_limits(scenario.swarm);
  const double travel = swarm.max_speed * scenario.tick;
  if (travel <= 2 * swarm.radius) return;
  note(
      "note: tick_s is {:.4g}: between two commands the swarm drives up to {:.4g} µm, more "
      "than it is wide, {:.4g} µm\n",
      scenario.tick, travel, 2 * swarm.radius);
}

/// Line with the time of the hold at the goal; empty without a hold.
std::string hold_text(const experiment::Record& record) {
  if (record.result.status != Status::solved || record.frames.empty()) return {};
  const double held = record.frames.back().t - record.result.metrics.time;
  return held > 1e-3 ? fmt::format("  at goal   held there for {:.1f} s\n", held) : "";
}

std::filesystem::path record_in(const std::filesystem::path& folder) { return folder / "run.h5"; }

void keep(const experiment::Record& record, const RunOutput& o,
          const report::ReportOptions& report) {
  experiment::write_whole_record(record, record_in(o.out));
  if (!o.no_report) report::write_run_report(record, o.out, report);
}

}  // namespace

void note_oddities(const experiment::Session& session) {
  note_tick(session.scenario());
  for (const std::string& unmet : unmet_assumptions(session.scenario(), session.map()))
    note("note: {}\n", unmet);
}

void note_regions(const experiment::Session& session) {
  const auto* params = std::get_if<navigation::AggregationParams>(&session.scenario().navigator);
  if (!params || params->method != navigation::Aggregation::divide_and_conquer) return;
  const auto* aggregation = std::get_if<AggregationDiagnostics>(&session.diagnostics());
  const std::string few =
      aggregation ? navigation::too_few_regions(aggregation->regions.size()) : "";
  if (!few.empty()) note("note: {}\n", few);
}

std::unique_ptr<experiment::GrowingRecord> grow_record(experiment::Session& session,
                                                       const std::string& folder) {
  if (folder.empty()) return nullptr;
  return std::make_unique<experiment::GrowingRecord>(session, record_in(folder));
}

void finish_run(experiment::Session& session, const Stop& stop) {
  note_oddities(session);
  const experiment::Scenario& scenario = session.scenario();
  ProgressBar bar(scenario.name.empty() ? "run" : scenario.name);
  experiment::ProgressListener progress(scenario, [&](const experiment::RunProgress& p) {
    bar.update(std::max(p.distance_done, p.time_spent));
  });
  const std::size_t noted = session.notes().size();
  bool began = false;
  while (const experiment::Tick* tick = session.step(stop)) {
    if (!std::exchange(began, true)) note_regions(session);
    progress.on_tick(*tick);
  }
  for (const std::string& more : std::span(session.notes()).subspan(noted))
    note("note: {}\n", more);
}

int tell_run(const experiment::Session& session, const RunOutput& o,
             const report::ReportOptions& report) {
  const experiment::Record& record = session.record();
  const experiment::RunResult& result = session.result();
  const std::string hash = record.hash();
  // Print a result even if it cannot be saved, and save it even if it cannot be printed.
  std::exception_ptr lost;  // with its type: a disk that is full is another fault than a report
  std::string why_lost;
  try {
    if (!o.out.empty()) keep(record, o, report);
  } catch (const InputError& e) {
    lost = std::current_exception();
    why_lost = e.what();
  }
  if (o.json) {
    nlohmann::ordered_json json = run_json(result, hash);
    json["goal_tolerance_um"] = session.scenario().goal_tolerance;
    json["notes"] = session.notes();
    if (o.rig_timing) json["rig_timing"] = o.rig_timing();
    if (o.commissioning) json["commissioning"] = o.commissioning();
    o.print(json.dump(2) + "\n");
  } else {
    const experiment::Scenario& scenario = session.scenario();
    o.print(fmt::format("{}{}  record    {}\n",
                        scenario.robots ? robots_summary(result, scenario) : summary(result),
                        hold_text(record), hash));
    if (!o.out.empty() && !lost)
      o.print(fmt::format(
          "wrote {}\n",
          (std::filesystem::path(o.out) / (o.no_report ? "run.h5" : "index.html")).string()));
  }
  if (lost && result.status != Status::fault) std::rethrow_exception(lost);
  if (lost) note("microswarm: {}\n", why_lost);  // the other error is more serious
  if (result.status == Status::fault) return hardware;
  return result.status == Status::solved ? ok : not_reached;
}

}  // namespace microswarm::cli

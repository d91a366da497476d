// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/decision_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm::report {
namespace {

constexpr double corner_step = 0.2;  // of the arc around a grown corner [rad]

/// Colour and meaning of a direction that is not taken.
struct FateLook {
  BeamFate fate;
  Colour colour;
  const char* label;
};
constexpr std::array<FateLook, 3> screened{
    {{BeamFate::obstacle, colours::radar_obstacle, "direction screened by an obstacle"},
     {BeamFate::wall, colours::radar_wall, "direction screened by a wall"},
     {BeamFate::turn, colours::radar_turn, "direction that turns too far"}}};

void draw_directions(Picture& picture, const RadarDiagnostics& scan, Vec2 at) {
  const auto ray = [&](double heading, double reach, Colour colour, double width_px) {
    const Vec2 along = unit_vector(heading);
    picture.line(std::array{at + scan.radius * along, at + reach * along}, colour, width_px);
  };
  for (const FateLook& look : screened) {
    bool is_there = false;
    for (const RadarBeam& beam : scan.beams) {
      if (beam.fate != look.fate) continue;
      ray(beam.heading, scan.circles.detection, look.colour, 1);
      is_there = true;
    }
    if (is_there) picture.legend(look.label, look.colour);
  }
  std::optional<double> heading = scan.straight;
  if (!heading && scan.best && *scan.best < scan.beams.size())
    heading = scan.beams[*scan.best].heading;
  if (!heading) return;
  ray(*heading, 1.15 * scan.circles.detection, colours::radar_chosen, 3.5);
  picture.legend("direction that the radar chose", colours::radar_chosen);
}

/// Outline of a predicted body: its convex corners, counterclockwise, turned and grown.
std::vector<Vec2> predicted_outline(const PredictedMoment& moment,
                                    const std::vector<Vec2>& corners) {
  const std::size_t count = corners.size();
  const auto normal = [&](std::size_t k) {
    return heading_along(-perpendicular(corners[(k + 1) % count] - corners[k % count]));
  };
  std::vector<Vec2> outline;
  for (std::size_t k = 0; k < count; ++k) {
    const double from = normal(k + count - 1);
    double sweep = normal(k) - from;
    if (sweep < 0) sweep += 2 * pi;
    const int steps = 1 + static_cast<int>(sweep / corner_step);
    for (int i = 0; i <= steps; ++i) {
      const Vec2 grown = corners[k] + moment.growth * unit_vector(from + sweep * i / steps);
      outline.push_back(moment.centre + rotated(grown, moment.turn));
    }
  }
  outline.push_back(outline.front());
  return outline;
}

void draw_predictions(Picture& picture, const PredictiveDiagnostics& ahead) {
  if (ahead.bodies.empty()) return;
  std::map<std::uint32_t, std::vector<Vec2>> corners;
  for (const PredictedCorner& corner : ahead.corners) corners[corner.body].push_back(corner.offset);
  const double first = ahead.bodies.front().t, last = ahead.bodies.back().t;
  for (const PredictedMoment& moment : ahead.bodies) {
    Colour colour = colours::prediction;
    if (last > first) colour.alpha = 0.9 - 0.75 * (moment.t - first) / (last - first);
    if (const auto found = corners.find(moment.body); found != corners.end())
      picture.line(predicted_outline(moment, found->second), colour, 1);
    else
      picture.circle({moment.centre, moment.radius}, colour, 1, false);
  }
  picture.legend(fmt::format("obstacles as predicted until {:.1f} s, paler with time", last),
                 colours::prediction);
}

void draw_way(Picture& picture, const HierarchicalDiagnostics& decision,
              const experiment::Scenario& scenario) {
  if (decision.towards != scenario.goal)
    picture.mark(decision.towards, "route point", colours::circle);
  if (!decision.wait_at) return;
  picture.mark(*decision.wait_at,
               decision.wait_since
                   ? fmt::format("waits here since t = {:.1f} s", *decision.wait_since)
                   : "waits here",
               colours::path);
}

void draw_team(Picture& picture, const AggregationDiagnostics& plan, std::span<const Vec2> robots) {
  if (plan.team_region && plan.team_branch) {
    for (const AggregationNode& node : plan.nodes)
      if (node.region == *plan.team_region && node.branch == *plan.team_branch &&
          node.next < plan.nodes.size())
        picture.line(std::array{node.position, plan.nodes[node.next].position}, colours::team, 9);
    picture.legend(fmt::format("team: region {}, branch {}", *plan.team_region, *plan.team_branch),
                   colours::team);
  }
  if (plan.leader && *plan.leader < robots.size()) picture.mark(robots[*plan.leader], "leader");
  if (plan.is_livelock) picture.legend("random robots lead, to break a livelock", colours::ink);
  if (plan.moves_left)
    picture.legend(fmt::format("{} moves of the plan left", *plan.moves_left), colours::ink);
}

}  // namespace

Diagnostics decision_at(const experiment::Record& record, double t) {
  const std::size_t frames = record.frames.size();
  const bool is_end = frames > 1 && t >= record.frames.back().t;
  return record.diagnostics.at(is_end ? record.frames[frames - 2].t : t);
}

void draw_decision(Picture& picture, const Diagnostics& shown, const experiment::Scenario& scenario,
                   Vec2 at, std::span<const Vec2> robots) {
  std::visit(
      Overloaded{[](std::monostate) {},
                 [&](const RadarDiagnostics& of) { draw_directions(picture, of, at); },
                 [&](const AggregationDiagnostics& of) { draw_team(picture, of, robots); },
                 [&](const PredictiveDiagnostics& of) { draw_predictions(picture, of); },
                 [&](const HierarchicalDiagnostics& of) { draw_way(picture, of, scenario); }},
      shown);
}

}  // namespace microswarm::report

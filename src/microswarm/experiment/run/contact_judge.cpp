// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/run/contact_judge.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/monitors/contact_monitor.hpp"
#include "microswarm/swarm/body/swarm_body.hpp"

namespace microswarm::experiment {

namespace {

/// First phase of a manoeuvre and its duration [s].
struct Prelude {
  bool holds;
  double time;
};
constexpr std::array<Prelude, 5> preludes{
    {{true, 0.5}, {true, 1}, {false, 0.5}, {false, 1}, {false, 2}}};

/// True state of the swarm at a tick, including commands not yet in effect.
struct State {
  double t;
  SwarmBody body;
  Rng drift;
};

/// Two consecutive commands; the first lasts `until` seconds.
struct Answer {
  Command first;
  Command second;
  double until;
  std::string_view name;
};

std::vector<Answer> answers(double speed, int directions) {
  constexpr Command hold{};
  std::vector<Answer> out{{hold, hold, 0, "hold"}};
  const auto retreat = [&](int k) { return Command{wrap(2 * pi * k / directions), speed}; };
  for (int k = 0; k < directions; ++k) out.push_back({retreat(k), retreat(k), 0, "retreat"});
  for (const Prelude& p : preludes)
    for (int k = 0; k < directions; ++k)
      out.push_back(p.holds ? Answer{hold, retreat(k), p.time, "hold, retreat"}
                            : Answer{retreat(k), hold, p.time, "retreat, hold"});
  return out;
}

/// Whether the swarm is at the logged positions of the contacts in the tick that starts at t.
[[maybe_unused]] bool is_as_logged(const ContactLog& log, double t, double tick,
                                   const SwarmBody& body) {
  return std::all_of(log.contacts().begin(), log.contacts().end(), [&](const RunEvent& contact) {
    if (contact.t < t || contact.t > t + tick) return true;
    return distance(moment_on(body.trajectory(), contact.t - t).pose.position, contact.position) <
           1e-3;
  });
}

/// States at the ticks of a run from which a contact may be judged, sorted by time.
std::vector<State> states(const Scenario& scenario, std::uint32_t trial, const ContactLog& log,
                          double lookback) {
  std::vector<State> out;
  const auto is_asked_for = [&](double t) {
    return std::any_of(log.contacts().begin(), log.contacts().end(), [&](const RunEvent& contact) {
      return t <= contact.t && t >= contact.t - lookback;
    });
  };
  State now{0, SwarmBody(scenario.swarm, *scenario.start),
            Rng(scenario.seed, Purpose::plant, trial)};
  for (const Command& command : log.commands()) {
    if (is_asked_for(now.t)) out.push_back(now);
    now.body.step(command, scenario.tick, now.drift);
    assert(is_as_logged(log, now.t, scenario.tick, now.body));
    now.t += scenario.tick;
  }
  return out;
}

bool touches(const World& world, const State& state) {
  const SwarmPose swarm = state.body.pose();
  return !world.at(state.t).is_free(swarm.pose.position, swarm.radius);
}

/// Top speed of a swarm with what it does beyond its commands [µm/s].
double true_top_speed(const SwarmParams& params) {
  const double commanded = swarm_limits(params).max_speed;
  const auto* ribbon = std::get_if<RibbonParams>(&params);
  return ribbon ? std::max(1.0, ribbon->speed_factor) * commanded + norm(ribbon->drift) : commanded;
}

/// The world without the obstacles that cannot reach a swarm of this radius and top speed between
/// two times for any command.
World within_reach(const World& world, const State& from, double until, double radius,
                   double speed) {
  World near{world.map, {}};
  const double time = until - from.t;
  std::vector<Body> bodies;
  for (const Obstacle& obstacle : world.obstacles) {
    bodies.clear();
    append_bodies(obstacle, 0, from.t, bodies);
    const double reach = radius + time * (speed + top_speed(obstacle)) + 10;
    const bool may_touch = std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
      return depth_in(body, from.body.pose().pose.position) > -reach;
    });
    // An absent obstacle may appear: a track starts, an open valve closes.
    if (may_touch || bodies.empty()) near.obstacles.push_back(obstacle);
  }
  return near;
}

bool stays_free(const ContactMonitor& fresh, const State& from, const Answer& answer, double until,
                double tick) {
  State now = from;
  ContactMonitor watch = fresh;
  while (now.t < until) {
    const bool begins = now.t - from.t < answer.until - 1e-9;
    now.body.step(begins ? answer.first : answer.second, tick, now.drift);
    if (!watch.follow(now.t, now.body.trajectory()).empty()) return false;
    now.t += tick;
  }
  return true;
}

class Judge {
 public:
  Judge(const Scenario& scenario, const World& world, const JudgeParams& params)
      : scenario_(scenario),
        world_(world),
        params_(params),
        limits_(swarm_limits(scenario.swarm)),
        top_speed_(true_top_speed(scenario.swarm)),
        answers_(answers(limits_.max_speed, params.directions)) {}

  ContactVerdict operator()(const RunEvent& contact, const std::vector<State>& states) const {
    ContactVerdict verdict{.contact = contact, .manoeuvre = {}};
    const double latest = contact.t - limits_.response_lag - scenario_.sensing.age() + 1e-9;
    for (auto state = states.rbegin(); state != states.rend() && !verdict.avoidable; ++state) {
      if (state->t > latest || state->t < contact.t - params_.lookback) continue;
      if (!is_seen(contact, state->t) || touches(world_, *state)) continue;
      if (const Answer* answer = find(*state, contact.t + params_.aftermath)) {
        verdict.avoidable = true;
        verdict.decided = state->t;
        verdict.manoeuvre = answer->name;
      }
    }
    return verdict;
  }

 private:
  /// Whether the obstacle was in view at t. Contacts with obstacles that have just appeared cannot
  /// be avoided.
  bool is_seen(const RunEvent& contact, double t) const {
    if (contact.kind != EventKind::contact_obstacle) return true;
    const double seen = t - scenario_.sensing.age();
    return placement(world_.obstacles[contact.body].motion, seen).present;
  }

  const Answer* find(const State& state, double until) const {
    const World near = within_reach(world_, state, until, limits_.radius, top_speed_);
    const ContactMonitor fresh(near);
    const auto answer = std::find_if(answers_.begin(), answers_.end(), [&](const Answer& a) {
      return stays_free(fresh, state, a, until, scenario_.tick);
    });
    return answer != answers_.end() ? &*answer : nullptr;
  }

  const Scenario& scenario_;
  const World& world_;
  JudgeParams params_;
  SwarmLimits limits_;
  double top_speed_;
  std::vector<Answer> answers_;
};

}  // namespace

void ContactLog::on_tick(const Tick& tick) {
  if (!tick.end) commands_.push_back(tick.frame.command);
  for (const RunEvent& event : tick.events)
    if (event.kind == EventKind::contact_wall || event.kind == EventKind::contact_obstacle)
      contacts_.push_back(event);
}

std::vector<ContactVerdict> judge_contacts(const Scenario& scenario, const World& world,
                                           std::uint32_t trial, const ContactLog& log,
                                           const JudgeParams& params) {
  std::vector<ContactVerdict> verdicts;
  if (log.contacts().empty()) return verdicts;
  const std::vector<State> before = states(scenario, trial, log, params.lookback);
  Judge judge(scenario, world, params);
  for (const RunEvent& contact : log.contacts()) verdicts.push_back(judge(contact, before));
  return verdicts;
}

}  // namespace microswarm::experiment

// SPDX-License-Identifier: Apache-2.0
// A navigator of one's own in the loop, with metrics and a record like any other.
#include <cmath>
#include <cstdio>

#include "microswarm/experiment/session/session.hpp"

using namespace microswarm;

/// Heads for the goal and turns aside from what is near, by the inverse of the distance.
class Repelled : public Navigator {
 public:
  explicit Repelled(Vec2 goal) : goal_(goal) {}

  Command step(const Observation& seen, const Stop&) override;
  NavigatorView view() const override {
    return {.state = state_, .local_target = goal_, .path = {}};
  }

 private:
  Vec2 goal_;
  NavigatorState state_ = NavigatorState::hold;
};

Command Repelled::step(const Observation& seen, const Stop&) {
  if (!seen.swarm) {  // never drive on when unsure
    state_ = NavigatorState::blind;
    return {};
  }
  const Vec2 here = seen.swarm->pose.position;
  Vec2 towards = goal_ - here;
  towards = (1 / norm(towards)) * towards;
  for (const Body& body : seen.world->moving().bodies()) {
    const auto* disc = std::get_if<Disc>(&body.shape);
    if (!disc) continue;
    const Vec2 away = here - disc->centre;
    const double gap = norm(away) - disc->radius - seen.swarm->radius;
    if (gap < 200) towards += (100 / (gap + 20) / norm(away)) * away;
  }
  state_ = NavigatorState::follow;
  return {std::atan2(towards.y, towards.x), 60};
}

int main() {
  experiment::Scenario scenario;
  scenario.map = formats::PolygonsMap{.hi = {2000, 1000}};
  scenario.start = Pose2{{200, 500}, 0};
  scenario.goal = Vec2{1800, 500};
  scenario.obstacles = {{DiscShape{80}, HarmonicLine{.centre = {900, 560}, .amplitude = {0, 200}}}};
  experiment::Session session(experiment::open_experiment(scenario, {}),
                              {.navigator = std::make_shared<Repelled>(*scenario.goal)});
  const experiment::RunResult& result = session.finish();
  std::printf("%s after %.1f s, nearest obstacle %.1f µm from the centre, %d contacts\n",
              to_string(result.status).data(), result.metrics.time,
              result.metrics.obstacles.clearance, result.metrics.contacts);
  session.record_to("04_own_navigator.h5");
  return result.status == Status::solved ? 0 : 3;
}

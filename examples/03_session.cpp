// SPDX-License-Identifier: Apache-2.0
// Steps a session, changes it between two ticks, and repeats what was recorded.
#include <cstdio>
#include <cstdlib>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/session/replay.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace {

void change(microswarm::experiment::Session& session, const char* key, const char* value) {
  for (const microswarm::Issue& issue : session.set(key, value))
    std::printf("refused: %s\n", issue.text.c_str());
}

}  // namespace

int main() try {
  using namespace microswarm;
  const char* scenarios = std::getenv("MICROSWARM_SCENARIOS");
  const std::filesystem::path folder = scenarios ? scenarios : "scenarios";
  const auto session = experiment::open_session(folder / "first_flight.yaml");
  while (const experiment::Tick* tick = session->step()) {
    if (tick->frame.t < 5 || session->view().number != 60) continue;
    change(*session, "navigator.speed_um_per_s", "30");
    change(*session, "obstacles.0.shape.radius_um", "20");
    change(*session, "tick_s", "1");  // refused: not while it runs
  }
  const experiment::SessionView end = session->view();
  std::printf("%s at t = %.1f s, %.1f µm from the goal, %zu obstacles\n",
              to_string(session->result().status).data(), end.frame.t, end.frame.goal_distance,
              end.bodies.size());

  const experiment::ReplayResult again = experiment::replay(session->record());  // with the changes
  std::printf("replay: %s\n", again.identical ? "identical" : again.difference.c_str());
  return again.identical ? 0 : 1;
} catch (const microswarm::InputError& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}

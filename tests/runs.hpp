// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/session/session.hpp"

namespace microswarm::test {

/// Runs a plant and a navigator that the test keeps.
inline RunResult run(const Scenario& scenario, Plant& plant, Navigator& navigator,
                     std::span<RunListener* const> listeners = {}, const Stop& stop = {}) {
  return simulate(scenario, {}, {.plant = borrowed(plant), .navigator = borrowed(navigator)},
                  listeners, stop);
}

/// The record of one trial, run to its end.
inline Record record_of(const Scene& scene, SessionParts parts = {}, const Stop& stop = {}) {
  Session session({scene, build_world(scene), {}}, std::move(parts));
  session.finish(stop);
  return session.record();
}

}  // namespace microswarm::test

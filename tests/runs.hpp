// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microswarm/experiment/session/session.hpp"

namespace microswarm::test {

/// Runs a plant and a navigator that the test keeps.
inline experiment::RunResult run(const experiment::Scenario& scenario, Plant& plant,
                                 Navigator& navigator,
                                 std::span<experiment::RunListener* const> listeners = {},
                                 const Stop& stop = {}) {
  return experiment::simulate(
      scenario, {}, {.plant = borrowed(plant), .navigator = borrowed(navigator)}, listeners, stop);
}

/// The record of one trial, run to its end.
inline experiment::Record record_of(const experiment::Scene& scene,
                                    experiment::SessionParts parts = {}, const Stop& stop = {}) {
  experiment::Session session({scene, experiment::build_world(scene), {}}, std::move(parts));
  session.finish(stop);
  return session.record();
}

}  // namespace microswarm::test

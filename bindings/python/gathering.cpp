// SPDX-License-Identifier: Apache-2.0
// Gathering of many robots under one input.
#include "microswarm/core/errors/error.hpp"
#include "microswarm/experiment/queries/gather_query.hpp"
#include "microswarm/formats/write_map.hpp"
#include "named_map.hpp"
#include "session.hpp"

namespace microswarm::python {
namespace {

/// A session that gathers, its tick [s], and notes on the map.
py::tuple gather(const NamedMap& map, const std::array<double, 2>& goal, int robots,
                 const Numbers& starts, std::optional<double> channel_width, int max_steps,
                 const Given& settings, std::uint64_t seed) {
  const experiment::GatherQuery query{.goal = {goal[0], goal[1]},
                                      .robots = robots,
                                      .starts = places(starts, "robots_um"),
                                      .channel_width = channel_width,
                                      .max_steps = max_steps,
                                      .settings = to_settings(settings),
                                      .seed = seed};
  Notes notes;
  std::vector<std::string> unmet;
  double tick = 0;
  auto session = interruptible([&](const Stop&) {
    experiment::GatherExperiment made =
        experiment::open_gathering(formats::to_parts(map.map()), map.spec, query, map.name);
    notes = made.notes;
    tick = made.experiment.scenario().tick;
    unmet = experiment::unmet_assumptions(made.experiment.scenario(), *made.experiment.world.map);
    return std::make_unique<experiment::Session>(std::move(made.experiment));
  });
  warn(notes);
  return py::make_tuple(session_object(std::move(session)), tick, unmet);
}

}  // namespace

void add_gather(py::module_& module) { module.def("gather", gather); }

}  // namespace microswarm::python

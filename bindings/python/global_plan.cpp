// SPDX-License-Identifier: Apache-2.0
// Global inputs that bring each of several robots to its own goal.
#include "calls.hpp"
#include "microswarm/experiment/queries/global_query.hpp"
#include "named_map.hpp"

namespace microswarm::python {
namespace {

py::dict global_plan(const NamedMap& map, const Numbers& starts, const Numbers& goals,
                     const Given& settings, std::uint64_t seed, bool shorten,
                     std::optional<double> time_limit) {
  const experiment::GlobalQuery query{.starts = places(starts, "robots_um"),
                                      .goals = places(goals, "goals_um"),
                                      .settings = to_settings(settings),
                                      .seed = seed,
                                      .shorten = shorten};
  std::optional<Stop::Clock::duration> budget;
  if (time_limit)
    budget = std::chrono::duration_cast<Stop::Clock::duration>(
        std::chrono::duration<double>(*time_limit));
  const experiment::GlobalAnswer made = interruptible(
      [&](const Stop& stop) { return answer(map.map(), query, map.name, stop); }, [] {}, budget);
  warn(made.notes);
  const auto& moments = made.plan.configurations;
  const auto robots = static_cast<py::ssize_t>(query.starts.size());
  py::array_t<double> paths({static_cast<py::ssize_t>(moments.size()), robots, py::ssize_t{2}});
  double* out = paths.mutable_data();
  for (const std::vector<Vec2>& moment : moments)
    for (const Vec2 position : moment) {
      *out++ = position.x;
      *out++ = position.y;
    }
  py::dict answer;
  answer["status"] = std::string(to_string(made.plan.status));
  answer["why_none"] = made.why_none();
  answer["inputs_um"] = to_array(made.plan.inputs);
  answer["paths_um"] = paths;
  answer["worst_um"] = made.plan.worst;
  answer["inputs_found"] = made.inputs_found;
  answer["nodes"] = made.nodes;
  answer["time_s"] = made.seconds;
  return answer;
}

}  // namespace

void add_global_plan(py::module_& module) { module.def("global_plan", global_plan); }

}  // namespace microswarm::python

// SPDX-License-Identifier: Apache-2.0
#include "own_navigator.hpp"

#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/world/snapshot.hpp"

namespace microswarm::python {

py::array_t<double> to_circles(std::span<const Body> bodies) {
  py::array_t<double> array({static_cast<py::ssize_t>(bodies.size()), py::ssize_t{3}});
  double* out = array.mutable_data();
  for (const Body& body : bodies) {
    const Disc disc = enclosing_disc(body);
    for (const double v : {disc.centre.x, disc.centre.y, disc.radius}) *out++ = v;
  }
  return array;
}

OwnNavigator::OwnNavigator(py::handle navigator) : navigator_(navigator) {
  if (!py::hasattr(navigator_, "step"))
    throw InputError("a navigator needs a method step(observation)");
}

void OwnNavigator::prepare(const Snapshot&, const Stop&) {
  const py::gil_scoped_acquire held;
  if (py::hasattr(navigator_, "prepare")) navigator_.attr("prepare")();
}

Command OwnNavigator::step(const Observation& seen, const Stop&) {
  const py::gil_scoped_acquire held;
  py::dict sight;
  sight["now_s"] = seen.now;
  sight["seen_s"] = seen.seen;
  sight["swarm"] = py::none();
  if (seen.swarm) {
    const Pose2& pose = seen.swarm->pose;
    sight["swarm"] =
        py::make_tuple(pose.position.x, pose.position.y, pose.heading, seen.swarm->radius);
  }
  sight["obstacles_um"] = to_circles(seen.world->moving().bodies());
  sight["robots_um"] = to_array(seen.robots);
  const py::object observation = py::module_::import("types").attr("SimpleNamespace")(**sight);
  const py::object answer = navigator_.attr("step")(observation);
  Command command;
  if (!answer.is_none()) {
    try {
      const py::sequence pair = answer;
      if (pair.size() != 2) throw py::cast_error();
      command = {pair[0].cast<double>(), pair[1].cast<double>()};
    } catch (const std::exception&) {
      throw InputError("step of the navigator must return (heading_rad, speed_um_per_s) or None");
    }
  }
  if (!std::isfinite(command.heading) || !(command.speed >= 0) || !std::isfinite(command.speed))
    throw InputError("step of the navigator returned a heading or speed out of range");
  state_ = command.speed > 0 ? NavigatorState::follow : NavigatorState::hold;
  return command;
}

}  // namespace microswarm::python

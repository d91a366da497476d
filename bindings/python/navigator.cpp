// SPDX-License-Identifier: Apache-2.0
// Navigators in the caller's loop. A step takes a few µs, so its arguments are read here instead of
// by converters.
#include "microswarm/experiment/session/standalone_navigator.hpp"

#include "guarded.hpp"
#include "scenario_text.hpp"

namespace microswarm::python {
namespace {

constexpr std::size_t many_obstacles = 200;

class OpenNavigator : public Guarded<experiment::StandaloneNavigator> {
 public:
  explicit OpenNavigator(std::unique_ptr<experiment::StandaloneNavigator> navigator)
      : Guarded(std::move(navigator), "navigator") {}

  QuickCalls steps;
};

constexpr const char* no_numbers =
    "t, seen and unseen must be numbers, obstacles and robots arrays of numbers";

double to_number(py::handle value, const char* why = no_numbers) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (number == -1 && PyErr_Occurred()) {
    PyErr_Clear();
    throw InputError(why);
  }
  return number;
}

/// Converts to an array of doubles; the caller's own if it is one already.
Numbers to_doubles(py::handle value) {
  if (Numbers::check_(value)) return py::reinterpret_borrow<Numbers>(value);
  Numbers made = Numbers::ensure(value);
  if (!made) throw InputError(no_numbers);
  return made;
}

SwarmPose to_swarm(py::handle value) {
  constexpr const char* why = "swarm must be (x_um, y_um, heading_rad, radius_um)";
  const auto items = py::reinterpret_steal<py::object>(PySequence_Fast(value.ptr(), why));
  if (!items) PyErr_Clear();
  if (!items || PySequence_Fast_GET_SIZE(items.ptr()) != 4) throw InputError(why);
  std::array<double, 4> v{};
  for (std::size_t i = 0; i < 4; ++i)
    v[i] = to_number(PySequence_Fast_GET_ITEM(items.ptr(), static_cast<py::ssize_t>(i)), why);
  return {{{v[0], v[1]}, v[2]}, v[3]};
}

/// Obstacles from a caller: rows x, y, radius, or outlines of shape (n, 2).
std::vector<Body> to_bodies(py::handle obstacles) {
  std::vector<Body> bodies;
  if (obstacles.is_none()) return bodies;
  if (py::isinstance<py::array>(obstacles)) {
    const Numbers rows = to_doubles(obstacles);
    if (rows.size() == 0) return bodies;
    if (rows.ndim() != 2 || rows.shape(1) != 3)
      throw InputError("obstacles must have the shape (n, 3): x_um, y_um, radius_um");
    bodies.reserve(static_cast<std::size_t>(rows.shape(0)));
    const double* row = rows.data();
    for (py::ssize_t i = 0; i < rows.shape(0); ++i, row += 3)
      bodies.push_back({.shape = Disc{{row[0], row[1]}, row[2]}});
    return bodies;
  }
  for (const py::handle one : py::reinterpret_borrow<py::object>(obstacles)) {
    const Numbers numbers = to_doubles(one);
    if (numbers.ndim() == 1 && numbers.size() == 3)
      bodies.push_back({.shape = Disc{{numbers.at(0), numbers.at(1)}, numbers.at(2)}});
    else if (numbers.ndim() == 2 && numbers.shape(1) == 2)
      bodies.push_back({.shape = Polygon{places(numbers, "outline"), {}}});
    else
      throw InputError("an obstacle must be (x_um, y_um, radius_um) or an outline of shape (n, 2)");
  }
  return bodies;
}

void number_bodies(std::vector<Body>& bodies, const std::vector<std::int64_t>& numbers) {
  if (numbers.size() != bodies.size())
    throw InputError("there must be as many numbers as obstacles");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < 0 || numbers[i] > INT32_MAX)
      throw InputError("the number of an obstacle must be 0 to 2147483647");
    bodies[i].obstacle = static_cast<std::uint32_t>(numbers[i]);
  }
}

/// Names of the states as Python strings, made once.
class StateNames {
 public:
  StateNames() {
    for (const auto& [state, name] : enum_names(NavigatorState{})) {
      const auto i = static_cast<std::size_t>(state);
      if (names_.size() <= i) names_.resize(i + 1);
      names_[i] = py::str(name.data(), name.size());
    }
  }
  const py::str& operator[](NavigatorState state) const {
    return names_[static_cast<std::size_t>(state)];
  }

 private:
  std::vector<py::str> names_;
};

/// Steps the navigator; returns the members of a Command.
py::tuple step_navigator(OpenNavigator& open, py::handle t, py::handle swarm, py::handle obstacles,
                         py::handle robots, py::handle seen,
                         const std::vector<std::int64_t>* numbers, py::handle unseen,
                         const StateNames& names) {
  experiment::ExternalObservation given{.now = to_number(t)};
  given.seen = seen.is_none() ? given.now : to_number(seen);
  if (!swarm.is_none()) given.swarm = to_swarm(swarm);
  given.obstacles = to_bodies(obstacles);
  if (numbers) {
    given.are_numbered = true;
    number_bodies(given.obstacles, *numbers);
  }
  if (!robots.is_none()) given.robots = places(to_doubles(robots), "robots");
  if (!PyLong_CheckExact(unseen.ptr()) || PyLong_AsLong(unseen.ptr()) != 0)
    given.unseen = unseen.cast<int>();
  return open.use([&](experiment::StandaloneNavigator& navigator) {
    const Command command =
        open.steps.call([&](const Stop& stop) { return navigator.step(given, stop); },
                        given.obstacles.size() > many_obstacles);
    const NavigatorView view = navigator.view();
    py::object target = py::none();
    if (view.local_target) target = py::make_tuple(view.local_target->x, view.local_target->y);
    return py::make_tuple(command.heading, command.speed, names[view.state], target, view.planned);
  });
}

}  // namespace

void add_navigator(py::module_& module) {
  py::class_<OpenNavigator>(module, "Navigator")
      .def(py::init([](const ScenarioText& scenario, std::uint32_t trial) {
        return std::make_unique<OpenNavigator>(interruptible([&](const Stop&) {
          return std::make_unique<experiment::StandaloneNavigator>(scenario.open(), trial);
        }));
      }))
      .def("step",
           [names = StateNames()](OpenNavigator& open, py::handle t, py::handle swarm,
                                  py::handle obstacles, py::handle robots, py::handle seen,
                                  const std::optional<std::vector<std::int64_t>>& numbers,
                                  py::handle unseen) {
             return step_navigator(open, t, swarm, obstacles, robots, seen,
                                   numbers ? &*numbers : nullptr, unseen, names);
           })
      .def("path",
           [](OpenNavigator& open) {
             return open.use(
                 [](experiment::StandaloneNavigator& n) { return to_array(n.view().path); });
           })
      .def("close", &OpenNavigator::close);
}

}  // namespace microswarm::python

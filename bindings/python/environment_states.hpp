// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "calls.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/environments/gathering/gathering_episode.hpp"
#include "microswarm/environments/navigation/navigation_episode.hpp"

namespace microswarm::python {

using ByteArray = py::array_t<std::uint8_t, py::array::c_style>;

/// The state of an environment: two numbers, and its inputs as an array.
inline py::tuple to_tuple(const environments::GatheringState& state) {
  return py::make_tuple(
      state.seed, state.draws,
      ByteArray(static_cast<py::ssize_t>(state.actions.size()), state.actions.data()));
}
inline py::tuple to_tuple(const environments::NavigationState& state) {
  py::array_t<double> inputs({static_cast<py::ssize_t>(state.actions.size()), py::ssize_t{2}});
  double* out = inputs.mutable_data();
  for (const environments::NavigationAction& action : state.actions) {
    *out++ = action.heading;
    *out++ = action.speed;
  }
  return py::make_tuple(state.seed, state.trial, inputs);
}
/// The state of a tuple.
inline void from_tuple(const py::tuple& tuple, environments::GatheringState& state) {
  state.seed = tuple[0].cast<std::uint64_t>();
  state.draws = tuple[1].cast<std::uint64_t>();
  const auto inputs = tuple[2].cast<ByteArray>();
  state.actions.assign(inputs.data(), inputs.data() + inputs.size());
}
inline void from_tuple(const py::tuple& tuple, environments::NavigationState& state) {
  state.seed = tuple[0].cast<std::uint64_t>();
  state.trial = tuple[1].cast<std::uint32_t>();
  const auto inputs = tuple[2].cast<Numbers>();
  for (py::ssize_t i = 0; i + 1 < inputs.size(); i += 2)
    state.actions.push_back({inputs.data()[i], inputs.data()[i + 1]});
}

/// State of each environment.
template <class All>
py::list states(All& all) {
  all.batch.check_whole();
  py::list list;
  for (std::size_t i = 0; i < all.batch.count(); ++i)
    list.append(to_tuple(all.batch.episode(i).state()));
  return list;
}
/// Brings all environments into their states.
template <class All>
void restore(All& all, const std::vector<py::tuple>& given) {
  using State = decltype(all.batch.episode(0).state());
  if (given.size() != all.batch.count())
    throw InputError("there must be a state for each environment");
  std::vector<State> made(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i].size() != 3) throw InputError("a state of an environment must have 3 parts");
    from_tuple(given[i], made[i]);
  }
  interruptible([&](const Stop& stop) {
    all.batch.restore(made, stop);
    return true;
  });
}

}  // namespace microswarm::python

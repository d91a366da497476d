// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "microswarm/config/former_keys.hpp"
#include "microswarm/config/settings.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace pybind11::detail {

/// In Python a setting is a pair of texts, key and value.
template <>
class type_caster<microswarm::Setting> {
 public:
  PYBIND11_TYPE_CASTER(microswarm::Setting, const_name("tuple[str, str]"));

  bool load(handle source, bool convert) {
    make_caster<Pair> pair;
    if (!pair.load(source, convert)) return false;
    std::tie(value.key, value.value) = cast_op<Pair>(std::move(pair));
    return true;
  }
  static handle cast(const microswarm::Setting& setting, return_value_policy policy,
                     handle parent) {
    return make_caster<Pair>::cast(Pair(setting.key, setting.value), policy, parent);
  }

 private:
  using Pair = std::pair<std::string, std::string>;
};

}  // namespace pybind11::detail

namespace microswarm::python {

namespace py = pybind11;

/// Settings from a caller; the place of a mistake in them is the key alone.
using Given = std::vector<Setting>;
inline Settings to_settings(Given given) { return {std::move(given), ""}; }

/// Rows of numbers from a caller, contiguous or not, of any numeric type.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Whether the interpreter is shutting down, and how many threads are about to re-enter it.
struct Ending {
  static std::atomic<bool> begun;
  static std::thread::id ends_it;  ///< the thread that may still call it during shutdown
  static std::atomic<int> returning;
  /// For `atexit`: from then on no other thread re-enters.
  static void begin();
};

/// Releases the GIL. A thread that would re-enter during shutdown blocks permanently instead, since
/// the interpreter would terminate it within a destructor.
class Free {
 public:
  Free() : state_(PyEval_SaveThread()) {}
  ~Free();
  Free(const Free&) = delete;
  Free& operator=(const Free&) = delete;

 private:
  PyThreadState* state_;
};

/// Calls `work(stop)` in another thread, without the GIL, while this one handles signals: Ctrl-C
/// stops the work, and KeyboardInterrupt is raised once it has ended. `look` is called 10 times a
/// second. The work is also stopped after `budget`, which raises nothing, and by setting `flag`.
template <class Work, class Look>
auto interruptible(std::atomic<bool>& flag, Work&& work, Look&& look,
                   std::optional<Stop::Clock::duration> budget = {}) {
  const Stop stop = budget ? Stop(*budget, &flag) : Stop(&flag);
  auto task = std::async(std::launch::async, [&] { return work(stop); });
  std::optional<py::error_already_set> raised;
  const auto is_done = [&] {
    const Free free;
    return task.wait_for(std::chrono::milliseconds(raised ? 1000 : 50)) ==
           std::future_status::ready;
  };
  while (!is_done()) {
    if (raised) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      look();
    } catch (py::error_already_set& error) {
      raised.emplace(std::move(error));
      flag = true;
    }
  }
  if (raised) {
    try {
      task.get();
    } catch (...) {  // the interruption is reported instead
    }
    throw std::move(*raised);
  }
  return task.get();
}
template <class Work, class Look>
auto interruptible(Work&& work, Look&& look, std::optional<Stop::Clock::duration> budget = {}) {
  std::atomic<bool> flag{};
  return interruptible(flag, work, look, budget);
}
template <class Work>
auto interruptible(Work&& work) {
  return interruptible(work, [] {});
}

/// Calls that are usually quick: they stay in this thread, since starting one costs more than most
/// of them. The first call, calls after a slow one and those that the caller expects to be slow are
/// interruptible.
class QuickCalls {
 public:
  template <class Work>
  auto call(Work&& work, bool may_be_slow = false) {
    const auto here = [&] {
      const Free free;
      return work(Stop());
    };
    return call(
        here, [&] { return interruptible(work); }, may_be_slow);
  }
  /// Calls `here()` if the call may stay in this thread, else `interruptibly()`.
  template <class Here, class Interruptibly>
  auto call(Here&& here, Interruptibly&& interruptibly, bool may_be_slow) {
    const bool stays = !was_slow_ && !may_be_slow;
    was_slow_ = true;  // remains set after an exception
    const auto began = Stop::Clock::now();
    const auto made = stays ? here() : interruptibly();
    was_slow_ = Stop::Clock::now() - began > std::chrono::milliseconds(2);
    return made;
  }

 private:
  bool was_slow_ = true;
};

/// Issues a Python warning for each note.
void warn(const Notes& notes);

/// Positions from an array of shape (n, 2). Throws InputError for another shape.
std::vector<Vec2> places(const Numbers& array, const char* name);
/// Array of shape (n, 2) from positions.
py::array_t<double> to_array(std::span<const Vec2> positions);

/// Adds the parts of the module.
void add_coils(py::module_& module);
void add_environments(py::module_& module);
void add_gather(py::module_& module);
void add_global_plan(py::module_& module);
void add_map(py::module_& module);
void add_navigator(py::module_& module);
void add_record(py::module_& module);
void add_session(py::module_& module);
void add_sweep(py::module_& module);
void add_vision(py::module_& module);

}  // namespace microswarm::python

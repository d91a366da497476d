// SPDX-License-Identifier: Apache-2.0
// The module microswarm._core, which the package microswarm wraps.
#include "calls.hpp"

#include <string_view>
#include <thread>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/version.hpp"

namespace microswarm::python {

std::atomic<bool> Ending::begun = false;
std::thread::id Ending::ends_it;
std::atomic<int> Ending::returning = 0;

void Ending::begin() {
  ends_it = std::this_thread::get_id();
  begun = true;
  while (returning > 0) {
    const py::gil_scoped_release free;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

Free::~Free() {
  ++Ending::returning;
  if (Ending::begun && std::this_thread::get_id() != Ending::ends_it) {
    --Ending::returning;
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
  PyEval_RestoreThread(state_);
  --Ending::returning;
}

void warn(const Notes& notes) {
  for (const std::string& note : notes)
    if (PyErr_WarnEx(PyExc_FutureWarning, note.c_str(), 2) != 0) throw py::error_already_set();
}

namespace {

py::object python_text(std::string_view text) {
  const auto size = static_cast<py::ssize_t>(text.size());
  return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(text.data(), size, "replace"));
}

/// Sets the current error of Python, with the issues.
void raise_input_error(const InputError& error) {
  const auto errors = py::module_::import("microswarm.errors");
  py::list issues;
  for (const Issue& one : error.issues())
    issues.append(errors.attr("Issue")(python_text(one.keys.empty() ? "" : one.keys.front()),
                                       python_text(one.location), python_text(one.text),
                                       python_text(one.value), python_text(one.limit)));
  const py::object type = errors.attr("InputError");
  PyErr_SetObject(type.ptr(), type(python_text(error.what()), issues).ptr());
}

}  // namespace

std::vector<Vec2> places(const Numbers& array, const char* name) {
  const bool none = array.size() == 0;
  if (!none && (array.ndim() != 2 || array.shape(1) != 2))
    throw InputError(std::string(name) + " must have the shape (n, 2)");
  std::vector<Vec2> all;
  all.reserve(static_cast<std::size_t>(array.size() / 2));
  const double* numbers = array.data();
  for (py::ssize_t i = 0; i < array.size() / 2; ++i)
    all.push_back({numbers[2 * i], numbers[2 * i + 1]});
  return all;
}

py::array_t<double> to_array(std::span<const Vec2> positions) {
  py::array_t<double> array({static_cast<py::ssize_t>(positions.size()), py::ssize_t{2}});
  double* numbers = array.mutable_data();
  for (const Vec2& position : positions) {
    *numbers++ = position.x;
    *numbers++ = position.y;
  }
  return array;
}

}  // namespace microswarm::python

PYBIND11_MODULE(_core, module) {
  using namespace microswarm;
  namespace py = pybind11;
  module.doc() = "What the package microswarm is made of; use that.";
  module.attr("version") = std::string(version);
  name_inputs([](std::string_view key) { return std::string(key == "times" ? "times_s" : ""); });
  static py::exception<HardwareError> hardware_error(module, "HardwareError", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      python::raise_input_error(error);
    } catch (const HardwareError& error) {
      hardware_error(error.what());
    }
  });
  py::module_::import("atexit").attr("register")(py::cpp_function(python::Ending::begin));
  python::add_coils(module);
  python::add_environments(module);
  python::add_gather(module);
  python::add_global_plan(module);
  python::add_map(module);
  python::add_record(module);
  python::add_session(module);
  python::add_navigator(module);
  python::add_sweep(module);
  python::add_vision(module);
}

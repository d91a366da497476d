// SPDX-License-Identifier: Apache-2.0
// Scenarios and experiments.
#include "session.hpp"

#include "calls.hpp"
#include "drawing.hpp"
#include "guarded.hpp"
#include "microswarm/config/write.hpp"
#include "own_navigator.hpp"
#include "record.hpp"
#include "scenario_text.hpp"

namespace microswarm::python {
namespace {

class OpenSession : public Guarded<experiment::Session> {
 public:
  /// `navigator`: the caller's navigator, or None.
  OpenSession(std::unique_ptr<experiment::Session> session, py::object navigator)
      : Guarded(std::move(session), "session"), navigator_(std::move(navigator)) {}
  /// Destroys the session before the navigator that it uses.
  ~OpenSession() { end(); }

  /// Ends the run; callable from any thread, also while another one steps.
  void stop() {
    is_stopped_ = true;
    stops_ = true;
  }

  /// Calls `work(stop)`, which steps. With the caller's navigator it stays in this thread, where
  /// Ctrl-C reaches the navigator; an exception of the navigator ends the session.
  template <class Work, class Look>
  auto drive(Work&& work, Look&& look) {
    if (has_failed_) throw InputError("the navigator of the session has raised an exception");
    if (is_stopped_) stops_ = true;
    const struct Forget {  // Ctrl-C in this call must not affect the next one
      OpenSession& open;
      ~Forget() { open.stops_ = open.is_stopped_.load(); }
    } forget{*this};
    if (!has_own_navigator()) return interruptible(stops_, work, look);
    has_failed_ = true;
    const auto made = [&] {
      const Free free;
      return work(Stop(&stops_));
    }();
    has_failed_ = false;
    return made;
  }
  bool has_own_navigator() const { return !navigator_.is_none(); }
  /// Stop for a step that is too short to need Ctrl-C.
  Stop when_stopped() const { return Stop(&is_stopped_); }

  /// For the garbage collector: a navigator may refer to the session that uses it.
  int traverse(visitproc visit, void* arg) const {
    Py_VISIT(navigator_.ptr());
    return 0;
  }
  void clear() {
    end();
    navigator_ = py::none();
  }
  void close() {
    Guarded::close();
    navigator_ = py::none();
  }

  QuickCalls steps;

 private:
  py::object navigator_;
  bool has_failed_ = false;
  std::atomic<bool> stops_ = false;
  std::atomic<bool> is_stopped_ = false;
};

/// The session of a Python object; null while it is not constructed.
OpenSession* to_session(PyObject* self) {
  auto* const instance = reinterpret_cast<py::detail::instance*>(self);
  const auto parts = instance->get_value_and_holder();
  return parts.holder_constructed() ? parts.value_ptr<OpenSession>() : nullptr;
}

/// Registers a session's references with the garbage collector.
void collect_garbage(PyHeapTypeObject* heap_type) {
  PyTypeObject& type = heap_type->ht_type;
  type.tp_flags |= Py_TPFLAGS_HAVE_GC;
  type.tp_traverse = [](PyObject* self, visitproc visit, void* arg) {
    Py_VISIT(Py_TYPE(self));
    const OpenSession* const open = to_session(self);
    return open ? open->traverse(visit, arg) : 0;
  };
  type.tp_clear = [](PyObject* self) {
    if (OpenSession* const open = to_session(self)) open->clear();
    return 0;
  };
}

std::unique_ptr<OpenSession> open(const ScenarioText& scenario, std::optional<std::uint64_t> seed,
                                  std::uint32_t trial, const py::object& navigator) {
  std::unique_ptr<Navigator> own;
  if (!navigator.is_none()) own = std::make_unique<OwnNavigator>(navigator);
  auto session = interruptible([&](const Stop&) {
    return std::make_unique<experiment::Session>(
        scenario.open(seed), experiment::SessionParts{.trial = trial, .navigator = std::move(own)});
  });
  return std::make_unique<OpenSession>(std::move(session), navigator);
}

/// The current view as a dictionary of numbers and arrays.
py::dict view_dict(const experiment::Session& session) {
  const experiment::SessionView view = session.view();
  py::dict out;
  const experiment::Frame& frame = view.frame;
  for (const io::Column& column :
       io::to_columns(type_of<experiment::Frame>(), io::ColumnUnits::held)) {
    if (column.kind == io::ColumnKind::word)
      out[py::str(column.key)] = std::string(column.word(&frame));
    else
      out[py::str(column.key)] = column.number(&frame);
  }
  out["number"] = view.number;
  out["holding"] = view.holding;
  out["obstacles_um"] = to_circles(view.bodies);
  out["robots_um"] = to_array(view.robots);
  out["path_um"] = to_array(view.path);
  return out;
}

bool step(OpenSession& open) {
  return open.use([&](experiment::Session& session) {
    const auto made = [&](const Stop& stop) { return session.step(stop) != nullptr; };
    const auto driven = [&] { return open.drive(made, [] {}); };
    if (open.has_own_navigator()) return driven();
    const auto here = [&] {
      const Free free;
      return made(open.when_stopped());
    };
    return open.steps.call(here, driven, false);
  });
}

/// Steps to the end; `report` gets the completed share, 10 times a second.
py::dict finish(OpenSession& open, const py::object& report) {
  return open.use([&](experiment::Session& session) {
    std::atomic<double> done = 0;
    const auto look = [&] {
      if (!report.is_none()) report(done.load());
    };
    const double limit = session.scenario().time_limit;
    double start = 0;
    const auto step = [&](const Stop& stop) {
      const experiment::Tick* tick = session.step(stop);
      if (!tick) return false;
      const double left = tick->frame.goal_distance;
      if (std::isfinite(left)) start = std::max(start, left);
      const double share = start > 0 ? 1 - left / start : 0;
      done = std::clamp(std::max(share, tick->frame.t / limit), 0.0, 1.0);
      return true;
    };
    if (open.has_own_navigator()) {
      constexpr std::chrono::milliseconds period{100};
      for (auto next = Stop::Clock::now() + period; open.drive(step, look);) {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (Stop::Clock::now() < next) continue;
        next = Stop::Clock::now() + period;
        look();
      }
    } else {
      open.drive(
          [&](const Stop& stop) {
            while (step(stop)) {
            }
            return true;
          },
          look);
    }
    return to_dict(session.result());
  });
}

}  // namespace

py::object session_object(std::unique_ptr<experiment::Session> session) {
  return py::cast(std::make_unique<OpenSession>(std::move(session), py::none()));
}

void add_session(py::module_& module) {
  py::class_<ScenarioText>(module, "Scenario")
      .def_static("load", ScenarioText::load)
      .def_static("of",
                  [](std::string text, std::string name, const std::string& base) {
                    return ScenarioText::of(std::move(text), std::move(name), base);
                  })
      .def("set", &ScenarioText::set)
      .def("json", [](const ScenarioText& s) { return to_json_text(s.value); })
      .def("yaml", [](const ScenarioText& s) { return experiment::scenario_text(s.value); })
      .def("copy", [](const ScenarioText& s) { return s; })
      .def("parts",
           [](const ScenarioText& s) {
             return py::make_tuple(s.text, s.name, s.base.string(), s.settings);
           })
      .def_readonly("name", &ScenarioText::name)
      .def_readonly("settings", &ScenarioText::settings);
  module.def("schema", experiment::scenario_schema);

  py::class_<OpenSession>(module, "Session", py::custom_type_setup(collect_garbage))
      .def(py::init(&open))
      .def("step", step)
      .def("finish", finish)
      .def("close", &OpenSession::close)
      .def("stop", &OpenSession::stop)
      .def("set",
           [](OpenSession& open, const std::string& key, const std::string& value) {
             open.use([&](experiment::Session& session) {
               if (const Issues issues = session.set(key, value); !issues.empty())
                 throw InputError(issues);
             });
           })
      .def("view", [](OpenSession& open) { return open.use(view_dict); })
      .def("diagnostics",
           [](OpenSession& open) {
             return open.use(
                 [](experiment::Session& session) { return to_dict(session.diagnostics()); });
           })
      .def(
          "summary",
          [](OpenSession& open) {
            return open.use([](experiment::Session& session) { return to_dict(session.result()); });
          })
      .def("draw",
           [](OpenSession& open, const std::optional<std::string>& file) {
             return open.use([&](experiment::Session& session) {
               return drawn(file, [&] { return report::draw_run(session.record()); });
             });
           })
      .def("record", [](OpenSession& open) {
        return open.use([](experiment::Session& session) {
          return std::make_shared<experiment::Record>(session.record());
        });
      });
}

}  // namespace microswarm::python

// SPDX-License-Identifier: Apache-2.0
// Records as NumPy arrays: a column for every recorded quantity, from its declaration.
#include "record.hpp"

#include <nlohmann/json.hpp>

#include "calls.hpp"
#include "drawing.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/experiment/results/metrics_json.hpp"
#include "microswarm/experiment/session/replay.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/io/tables.hpp"

namespace microswarm::python {
namespace {

py::object to_column(const io::Column& column, const io::ListRef<const void*>& list) {
  const auto size = static_cast<py::ssize_t>(list.size());
  if (column.kind == io::ColumnKind::word) {
    py::list words;
    for (std::size_t i = 0; i < list.size(); ++i)
      words.append(std::string(column.word(list.row(i))));
    return py::module_::import("numpy").attr("array")(words, py::dtype("U16"));
  }
  if (column.kind == io::ColumnKind::integer) {
    py::array_t<std::int64_t> array(size);
    std::int64_t* out = array.mutable_data();
    for (std::size_t i = 0; i < list.size(); ++i) *out++ = column.integer(list.row(i));
    return array;
  }
  py::array_t<double> array(size);
  double* out = array.mutable_data();
  for (std::size_t i = 0; i < list.size(); ++i) *out++ = column.number(list.row(i));
  return array;
}

}  // namespace

py::dict columns_of_list(const io::ListRef<const void*>& list, const Field* positions) {
  const Unit unit = positions ? positions->info.unit : Unit::um;
  py::dict out;
  for (const io::Column& column : io::to_columns(list.row_type(), io::ColumnUnits::held, unit))
    out[py::str(column.key)] = to_column(column, list);
  return out;
}

namespace {

/// Numbers and words of a described value, and a table for each of its lists.
template <HasFields Value>
py::object described(const Value& value) {
  py::dict out;
  out["type"] = std::string(Value::type_name);
  for (const io::Column& column : io::to_columns<Value>()) {
    const py::str key(column.key);
    if (column.kind == io::ColumnKind::word)
      out[key] = std::string(column.word(&value));
    else if (column.kind == io::ColumnKind::integer)
      out[key] = column.integer(&value);
    else
      out[key] = column.number(&value);
  }
  for (const Field& field : type_of<Value>().fields)
    if (field.type->kind == TypeKind::list)
      out[py::str(field.key)] = columns_of_list({field.type, field.in(&value)}, &field);
  return out;
}

/// Tables by name; "plans/tree" is a list with the table of each plan.
struct Tables {
  py::dict out;

  void table(const std::string& group, const io::ListRef<const void*>& list) {
    out[py::str(group.substr(1))] = columns_of_list(list);
  }
  void parts(const std::string& group, const io::ListRef<const void*>& list, const Field& field) {
    py::list parts;
    for (std::size_t i = 0; i < list.size(); ++i)
      parts.append(columns_of_list(list.part(i, field), &field));
    out[py::str(group.substr(1))] = parts;
  }
};

py::dict documented(const experiment::Record&) {
  py::dict out;
  for (const io::Column& column :
       io::to_columns(type_of<experiment::Frame>(), io::ColumnUnits::held))
    out[py::str(column.key)] = column.doc;
  return out;
}

}  // namespace

py::dict to_tables(const experiment::Record& record) {
  Tables tables;
  io::visit_tables(type_of<experiment::Record>(), static_cast<const void*>(&record), tables);
  const void* log = &record.diagnostics;
  for (const Field& field : type_of<experiment::DiagnosticsLog>().fields)
    if (field.type->count(field.in(log)) > 0) io::visit_table(field, log, tables, "/diagnostics");
  return tables.out;
}

py::object to_dict(const Diagnostics& diagnostics) {
  return std::visit(Overloaded{[](std::monostate) -> py::object { return py::none(); },
                               []<HasFields Shown>(const Shown& of) { return described(of); }},
                    diagnostics);
}

py::dict to_dict(const experiment::RunResult& result) {
  py::dict out;
  out["status"] = std::string(to_string(result.status));
  out["metrics"] = experiment::metrics_json(result.metrics).dump();
  out["step_time_s"] = py::array_t<double>(static_cast<py::ssize_t>(result.timing.steps.size()),
                                           result.timing.steps.data());
  return out;
}

void add_record(py::module_& module) {
  py::class_<experiment::Record, std::shared_ptr<experiment::Record>>(module, "Record")
      .def_static("read",
                  [](const std::string& file) {
                    return interruptible([&](const Stop&) {
                      return std::make_shared<experiment::Record>(experiment::read_record(file));
                    });
                  })
      .def("write",
           [](const experiment::Record& record, const std::string& file) {
             interruptible([&](const Stop&) {
               experiment::write_record(record, file);
               return true;
             });
           })
      .def("draw",
           [](const experiment::Record& record, const std::optional<std::string>& file) {
             return drawn(file, [&] { return report::draw_run(record); });
           })
      .def("tables", to_tables)
      .def("summary", [](const experiment::Record& record) { return to_dict(record.result); })
      .def("hash", &experiment::Record::hash)
      .def("documented", documented)
      .def("scenario",
           [](const experiment::Record& record) {
             return experiment::scenario_text(record.scene.scenario);
           })
      .def_readonly("version", &experiment::Record::version)
      .def_readonly("trial", &experiment::Record::trial)
      .def_readonly("rig", &experiment::Record::rig)
      .def_readonly("navigator", &experiment::Record::navigator)
      .def("replay", [](const experiment::Record& record) {
        const experiment::ReplayResult made =
            interruptible([&](const Stop& stop) { return experiment::replay(record, stop); });
        return std::pair(made.identical, made.difference);
      });
}

}  // namespace microswarm::python

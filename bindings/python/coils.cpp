// SPDX-License-Identifier: Apache-2.0
// Coils: their fields, the currents for a field, and calibration from measured fields.
#include <Eigen/Core>
#include <algorithm>

#include "calls.hpp"
#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/coils/calibration.hpp"
#include "microswarm/actuation/coils/currents.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::python {
namespace {

using Row = Eigen::Map<const Eigen::VectorXd>;
using Out = Eigen::Map<Eigen::VectorXd>;

/// Coils, and the content of their file if they were calibrated here.
struct Coils {
  actuation::CoilSystem system;
  std::optional<actuation::CoilSystemParams> calibrated{};
};

/// Whether a file describes a rig, which names the file of its coils.
bool is_rig(const std::string& file) {
  const YamlNode root = parse_yaml(read_file(file, max_yaml_bytes), file);
  for (std::size_t i = 0; root.kind == YamlNode::Kind::map && i + 1 < root.items.size(); i += 2)
    if (root.items[i].text == "coils") return root.items[i + 1].kind == YamlNode::Kind::scalar;
  return false;
}

Coils load_coils(const std::string& file) {
  return interruptible([&](const Stop&) {
    return Coils{is_rig(file) ? rig::read_rig(file).system : actuation::read_coil_system(file)};
  });
}

void check_columns(const Numbers& array, py::ssize_t columns, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != columns)
    throw InputError(std::string(name) + " must have the shape (n, " + std::to_string(columns) +
                     ")");
}

/// Calls `work(i)` for each row; few rows stay in this thread.
template <class Work>
void for_rows(py::ssize_t rows, Work&& work) {
  constexpr py::ssize_t few = 100;
  if (rows <= few) {
    const Free free;
    for (py::ssize_t i = 0; i < rows; ++i) work(i);
    return;
  }
  interruptible([&](const Stop& stop) {
    for (py::ssize_t i = 0; i < rows && !stop(); ++i) work(i);
    return true;
  });
}

/// Calls `work(row, actuation, result)` for each row of `given`, with the actuation at its
/// position: one of the rows of `at`, or its only one. The result has `columns` numbers a row.
template <class Work>
py::array_t<double> each_row(const Coils& coils, const Numbers& given, py::ssize_t width,
                             const char* name, const Numbers& at, py::ssize_t columns,
                             Work&& work) {
  check_columns(given, width, name);
  check_columns(at, 3, "at_um");
  const py::ssize_t rows = given.shape(0);
  if (at.shape(0) != 1 && at.shape(0) != rows)
    throw InputError("at_um has " + std::to_string(at.shape(0)) + " rows, must be 1 or " +
                     std::to_string(rows));
  const bool is_one = at.shape(0) == 1;
  py::array_t<double> made({rows, columns});
  const double* in = given.data();
  const double* position = at.data();
  double* out = made.mutable_data();
  actuation::Actuation actuation;
  for_rows(rows, [&](py::ssize_t i) {
    if (i == 0 || !is_one)
      actuation = coils.system.at({position[3 * i], position[3 * i + 1], position[3 * i + 2]});
    Out result(out + columns * i, columns);
    work(Row(in + width * i, width), actuation, result);
  });
  return made;
}

py::ssize_t row_count(const Coils& coils) { return static_cast<py::ssize_t>(coils.system.size()); }

py::array_t<double> currents_of_fields(const Coils& coils, const Numbers& fields,
                                       const Numbers& at) {
  return each_row(coils, fields, 3, "fields_mt", at, row_count(coils),
                  [](const Row& field, const actuation::Actuation& actuation, Out& out) {
                    out = actuation::currents_for(actuation, field).currents;
                  });
}

py::array_t<double> fields_of_currents(const Coils& coils, const Numbers& currents,
                                       const Numbers& at) {
  return each_row(coils, currents, row_count(coils), "currents_a", at, 3,
                  [](const Row& amperes, const actuation::Actuation& actuation, Out& out) {
                    out = actuation.total_field(amperes);
                  });
}

/// ∂B_i/∂x_j for each row [T/m].
py::array_t<double> gradients_of_currents(const Coils& coils, const Numbers& currents,
                                          const Numbers& at) {
  return each_row(coils, currents, row_count(coils), "currents_a", at, 9,
                  [](const Row& amperes, const actuation::Actuation& actuation, Out& out) {
                    const Eigen::Matrix3d slope =
                        actuation.total_gradient(amperes) / actuation::mt_per_um_of_t_per_m;
                    for (Eigen::Index i = 0; i < 9; ++i) out[i] = slope(i / 3, i % 3);
                  });
}

py::array_t<double> allowed_shares(const Coils& coils, const Numbers& currents) {
  check_columns(currents, row_count(coils), "currents_a");
  py::array_t<double> made(currents.shape(0));
  const double* in = currents.data();
  double* out = made.mutable_data();
  const actuation::Amplifiers amplifiers(coils.system.amplifiers());
  for_rows(currents.shape(0), [&](py::ssize_t i) {
    out[i] = amplifiers.steady(Row(in + row_count(coils) * i, row_count(coils))).scale;
  });
  return made;
}

py::array_t<double> array_of_rows(const Eigen::MatrixXd& matrix) {
  py::array_t<double> array({matrix.rows(), matrix.cols()});
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) array.mutable_at(i, k) = matrix(i, k);
  return array;
}

py::array_t<double> array_of_rows(const std::vector<Eigen::Vector3d>& rows) {
  py::array_t<double> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  double* out = array.mutable_data();
  for (const Eigen::Vector3d& row : rows) out = std::copy(row.begin(), row.end(), out);
  return array;
}

actuation::FieldMeasurements to_measurements(const Numbers& currents, const Numbers& fields,
                                             const Numbers& positions,
                                             const std::vector<std::string>& names) {
  const auto coils = static_cast<py::ssize_t>(names.size());
  check_columns(currents, coils, "currents_a");
  check_columns(fields, 3, "fields_mt");
  check_columns(positions, 3, "positions_um");
  const py::ssize_t rows = currents.shape(0);
  if (rows == 0) throw InputError("measurements: there are none");
  if (fields.shape(0) != rows || positions.shape(0) != rows)
    throw InputError("measurements: currents_a has " + std::to_string(rows) +
                     " rows, fields_mt and positions_um must have as many");
  actuation::FieldMeasurements measured{.file = "measurements", .coils = names, .rows = {}};
  measured.rows.reserve(static_cast<std::size_t>(rows));
  for (py::ssize_t i = 0; i < rows; ++i) {
    const double* field = fields.data() + 3 * i;
    const double* position = positions.data() + 3 * i;
    measured.rows.push_back({.currents = Row(currents.data() + coils * i, coils),
                             .position = {position[0], position[1], position[2]},
                             .field = {field[0], field[1], field[2]},
                             .line = static_cast<int>(i),
                             .planned = {}});
  }
  return measured;
}

/// Calibrated coils, and the quality of the fit.
py::tuple fit(const actuation::FieldMeasurements& measured, const std::string& name, bool offset,
              bool gradients, const std::optional<std::array<double, 3>>& centre) {
  actuation::FitOptions options{.offset = offset, .gradients = gradients};
  if (centre) options.centre = Eigen::Vector3d((*centre)[0], (*centre)[1], (*centre)[2]);
  const actuation::FittedMatrix made = actuation::fit_matrix(measured, options);
  actuation::require_effects(measured, made);
  actuation::CoilSystemParams params{.name = name, .coils = made.coils, .amplifiers = {}};
  py::dict out;
  out["rms_mt"] = std::vector<double>(made.rms.begin(), made.rms.end());
  out["rms_abs_mt"] = made.total_rms;
  out["worst_mt"] = made.worst;
  out["worst_row"] = made.worst_row;
  out["freedom"] = made.freedom;
  out["field_mt_per_a"] = made.coils.field;
  out["offset_mt"] = made.coils.offset;
  out["centre_um"] = made.coils.centre;
  out["field_error_mt_per_a"] = array_of_rows(made.field_errors);
  out["residuals_mt"] = array_of_rows(made.residuals);
  if (gradients) {
    out["gradient_t_per_m_per_a"] = made.coils.gradient;
    out["gradient_error_t_per_m_per_a"] = array_of_rows(made.gradient_errors);
    out["offset_gradient_t_per_m"] = made.coils.offset_gradient;
  }
  actuation::CoilSystem system(params);
  return py::make_tuple(Coils{std::move(system), std::move(params)}, out);
}

using Centre = std::optional<std::array<double, 3>>;

void save_coils(const Coils& coils, const std::string& file) {
  if (!coils.calibrated)
    throw InputError(file, "these coils were read from a file, only calibrated ones are saved");
  write_file_atomically(file, to_yaml(*coils.calibrated));
}

/// The parameters of calibrated coils, for pickle.
std::string state_of_coils(const Coils& coils) {
  if (!coils.calibrated)
    throw py::type_error(
        "these coils were read from a file, only calibrated ones are pickled: load the file in "
        "each process");
  return to_yaml(*coils.calibrated);
}

Coils restored_coils(const std::string& state) {
  auto params = read_yaml_text<actuation::CoilSystemParams>(state, "pickled coils");
  actuation::CoilSystem system(params);
  return {std::move(system), std::move(params)};
}

}  // namespace

void add_coils(py::module_& module) {
  py::class_<Coils>(module, "Coils")
      .def_static("load", load_coils)
      .def_static("of_arrays",
                  [](const Numbers& currents, const Numbers& fields, const Numbers& positions,
                     const std::vector<std::string>& names, const std::string& name, bool offset,
                     bool gradients, const Centre& centre) {
                    return fit(to_measurements(currents, fields, positions, names), name, offset,
                               gradients, centre);
                  })
      .def_static("of_file",
                  [](const std::string& file, bool offset, bool gradients, const Centre& centre) {
                    const actuation::FieldMeasurements measured = interruptible(
                        [&](const Stop&) { return actuation::read_measurements(file); });
                    return fit(measured, std::filesystem::path(file).stem().string(), offset,
                               gradients, centre);
                  })
      .def("save", save_coils)
      .def(py::pickle(&state_of_coils, &restored_coils))
      .def("currents", currents_of_fields)
      .def("fields", fields_of_currents)
      .def("gradients", gradients_of_currents)
      .def("allowed_shares", allowed_shares)
      .def("in_workspace",
           [](const Coils& coils, const std::array<double, 3>& position) {
             return coils.system.in_workspace({position[0], position[1], position[2]});
           })
      .def("matrix",
           [](const Coils& coils, const std::array<double, 3>& position) {
             return array_of_rows(coils.system.at({position[0], position[1], position[2]}).field);
           })
      .def("name", [](const Coils& coils) { return coils.system.name(); })
      .def("names", [](const Coils& coils) { return coils.system.coil_names(); })
      .def("centre", [](const Coils& coils) {
        const Eigen::Vector3d& c = coils.system.centre();
        return std::array<double, 3>{c[0], c[1], c[2]};
      });
}

}  // namespace microswarm::python

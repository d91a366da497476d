// SPDX-License-Identifier: Apache-2.0
// `rig calibrate`: an actuation matrix and its gradients from measured fields.
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "microswarm/actuation/coils/field_comparison.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/rig/runtime/coil_temperatures.hpp"
#include "rig/calibrate/measure.hpp"
#include "rig/commissioner.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CalibrateOptions {
  std::string measured;
  std::string out;
  bool offset = false;
  bool gradients = false;
  std::string centre;
  bool json = false;
  MeasureOptions measure;
};

/// A fit and the fits for comparison.
struct Calibration {
  actuation::FieldMeasurements measured;
  actuation::FittedMatrix fit;
  std::optional<actuation::FittedMatrix> uniform;  ///< fit without gradients, if `fit` has them
  std::optional<double> rms_with_gradients;  ///< [mT], if `fit` has none and they are determined
  std::vector<actuation::FieldComparison> beside_file;  ///< of each coil, if they were driven
};

/// The fitted fields beside those of the rig's coil file, at the fit's centre.
std::vector<actuation::FieldComparison> compare(const actuation::FittedMatrix& fit,
                                                const actuation::CoilSystem& system) {
  const Eigen::Map<const Eigen::Vector3d> centre(fit.coils.centre.data());
  std::vector<actuation::FieldComparison> out;
  if (!system.in_workspace(centre)) return out;
  const actuation::Actuation expected = system.at(centre);
  if (expected.field.colwise().norm().minCoeff() == 0) return out;  // nothing to compare with
  for (std::size_t k = 0; k < fit.coils.names.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    out.push_back(actuation::compare_fields(
        {fit.coils.field[0][k], fit.coils.field[1][k], fit.coils.field[2][k]},
        expected.field.col(column)));
  }
  return out;
}

Json to_rows(const Eigen::MatrixXd& m) {
  Json rows = Json::array();
  for (const auto& row : m.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  return rows;
}

Json to_list(const Eigen::Vector3d& v) { return std::vector<double>(v.begin(), v.end()); }

void tell_json(const Calibration& of) {
  const actuation::FittedMatrix& fit = of.fit;
  const actuation::FieldMeasurement& worst = of.measured.rows[fit.worst_row];
  Json json{{"measurements", of.measured.rows.size()},
            {"coils", fit.coils.names},
            {"field_mt_per_a", fit.coils.field},
            {"offset_mt", fit.coils.offset},
            {"rms_mt", to_list(fit.rms)},
            {"rms_abs_mt", fit.total_rms},
            {"worst_mt", fit.worst},
            {"worst_line", worst.line},
            {"worst_at_um", to_list(worst.position)},
            {"field_error_mt_per_a", to_rows(fit.field_errors)},
            {"largest_error", nullptr}};
  if (const auto error = actuation::largest_error(fit)) json["largest_error"] = error->share;
  for (const actuation::FieldComparison& coil : of.beside_file) {
    json["ratio_to_file"].push_back(coil.ratio);
    json["angle_to_file_deg"].push_back(degrees(coil.angle));
  }
  if (of.uniform) {
    json["centre_um"] = fit.coils.centre;
    json["gradient_t_per_m_per_a"] = fit.coils.gradient;
    json["gradient_error_t_per_m_per_a"] = to_rows(fit.gradient_errors);
    json["offset_gradient_t_per_m"] = fit.coils.offset_gradient;
    json["rms_without_gradients_mt"] = to_list(of.uniform->rms);
  }
  cli::print("{}\n", json.dump(2));
}

void tell_gradients(const Calibration& of) {
  constexpr std::array<const char*, 5> names{"dBx/dx", "dBx/dy", "dBx/dz", "dBy/dy", "dBy/dz"};
  const actuation::FittedMatrix& fit = of.fit;
  cli::print("fields and gradients are those at ({:.6g}) µm\n", fmt::join(fit.coils.centre, ", "));
  for (std::size_t k = 0; k < 5; ++k)
    cli::print("  {} = {:.6g} T/m/A, without current {:.6g} T/m\n", names[k],
               fmt::join(fit.coils.gradient[k], ", "), fit.coils.offset_gradient[k]);
  const Eigen::Vector3d& r = of.uniform->rms;
  cli::print("RMS residuals without gradients ({:.4g}, {:.4g}, {:.4g}) mT\n", r[0], r[1], r[2]);
}

void tell(const Calibration& of) {
  const actuation::FittedMatrix& fit = of.fit;
  const actuation::FieldMeasurement& worst = of.measured.rows[fit.worst_row];
  cli::print("{} measurements of {} coils: {}\n", of.measured.rows.size(), of.measured.coils.size(),
             fmt::join(of.measured.coils, ", "));
  for (std::size_t k = 0; k < 3; ++k)
    cli::print("  B{} = {:.6g} mT/A, without current {:.6g} mT; RMS residual {:.4g} mT\n", "xyz"[k],
               fmt::join(fit.coils.field[k], ", "), fit.coils.offset[k],
               fit.rms[static_cast<Eigen::Index>(k)]);
  for (std::size_t k = 0; k < of.beside_file.size(); ++k)
    cli::print("  coil {}: {:.3g} times the field of the rig's file, {:.2g}° from its direction\n",
               fit.coils.names[k], of.beside_file[k].ratio, degrees(of.beside_file[k].angle));
  if (of.uniform) tell_gradients(of);
  cli::print("RMS residual {:.4g} mT; the worst is {:.4g} mT, line {}, at {} µm\n", fit.total_rms,
             fit.worst, worst.line, triple_text(worst.position));
  if (fit.freedom == 0) return;
  if (const auto error = actuation::largest_error(fit))
    cli::print("standard errors of the fields: at most {:.2g} % of a coil's, that of {}\n",
               100 * error->share, fit.coils.names[error->coil]);
  if (of.uniform)
    cli::print("standard errors of the gradients: at most {:.2g} T/m/A\n",
               fit.gradient_errors.maxCoeff());
}

Calibration fit_file(const std::string& file, const actuation::FitOptions& options) {
  Calibration of{.measured = actuation::read_measurements(file),
                 .fit = {},
                 .uniform = {},
                 .rms_with_gradients = {}};
  of.fit = actuation::fit_matrix(of.measured, options);
  actuation::require_effects(of.measured, of.fit);
  const actuation::FitOptions other{
      .offset = options.offset, .gradients = !options.gradients, .centre = {}};
  if (options.gradients)
    of.uniform = actuation::fit_matrix(of.measured, other);
  else if (actuation::determines_gradients(of.measured, options))
    of.rms_with_gradients = actuation::fit_matrix(of.measured, other).total_rms;
  return of;
}

int fit_and_tell(const CalibrateOptions& o, const actuation::FitOptions& options,
                 actuation::CoilSystemParams system,
                 const std::optional<actuation::CoilSystem>& driven) {
  Calibration of = reading([&] { return fit_file(o.measured, options); });
  if (driven) of.beside_file = compare(of.fit, *driven);
  system.coils = of.fit.coils;
  if (!o.out.empty()) {
    write_file_atomically(o.out, to_yaml(system));
    if (system.amplifiers.empty())
      note("note: {} names no limits of the coils: add its `drives`\n", o.out);
  }
  if (of.fit.freedom == 0)
    note("note: {} measurements are just enough for the unknowns: the residuals mean nothing\n",
         of.measured.rows.size());
  if (of.rms_with_gradients)
    note("note: with --gradients the RMS residual is {:.4g} mT, not {:.4g} mT\n",
         *of.rms_with_gradients, of.fit.total_rms);
  if (o.json)
    tell_json(of);
  else
    tell(of);
  if (!o.json && !o.out.empty()) cli::print("wrote {}\n", o.out);
  if (!o.out.empty() && !o.measure.rig.empty())
    commission(o.measure.rig,
               {rig::commissioning_entry(
                   rig::Quantity::field, fmt::format("RMS residual {:.3g} mT", of.fit.total_rms),
                   commissioner(o.measure.by), rig::key_fingerprint(system))});
  return ok;
}

int calibrate(const CalibrateOptions& o, const Context& context) {
  keep_input(o.out, o.measured);
  actuation::CoilSystemParams system;
  std::optional<actuation::CoilSystem> driven;
  system.name = std::filesystem::path(o.measured).stem().string();
  actuation::FitOptions options{.offset = o.offset, .gradients = o.gradients, .centre = {}};
  if (!o.centre.empty()) options.centre = parse_triple(o.centre);
  if (!o.measure.rig.empty()) {
    const rig::Rig rig = reading([&] {
      return rig::read_rig(o.measure.rig, {o.measure.settings, "--set"});
    });
    keep_input(o.out, o.measure.rig);
    const std::filesystem::path coils = rig.folder / rig.params.coils;
    keep_input(o.out, coils.string());
    options.offset = true;  // the plan measures it
    if (const int code = measure(rig, o.measure, options, o.measured, context); code != ok)
      return code;
    if (!rig.system.name().empty()) system.name = rig.system.name();
    system.id = rig::coil_identity(rig);
    // Drives of the file, since the rig's are limited by the driver's full scale too.
    driven = actuation::read_coil_system(coils);
    system.amplifiers = driven->amplifiers();
  }
  return fit_and_tell(o, options, std::move(system), driven);
}

}  // namespace

void add_rig_calibrate(Command rig, Action& action) {
  auto o = std::make_shared<CalibrateOptions>();
  Command cmd =
      rig.add_command("calibrate", "Measure the coils' fields and fit an actuation matrix to them",
                      "rig calibrate samples/coils/measured.csv --out coils.yaml");
  cmd.add_option("measured", o->measured,
                 "CSV with i_NAME_a per coil, bx_mt, by_mt, bz_mt and optionally x_um, y_um, z_um")
      .required()
      .type_name("FILE")
      .input();
  cmd.add_option("--out", o->out, "Coil system to write (YAML)").type_name("FILE");
  cmd.add_flag("--offset", o->offset, "Also fit the field at zero current; always with --measure");
  const Option gradients =
      cmd.add_flag("--gradients", o->gradients, "Also fit the gradients of the fields");
  cmd.add_option("--centre", o->centre, "Position at which the matrix is fitted, in µm")
      .type_name("X,Y,Z")
      .default_text("the middle of the positions")
      .check(triple("X,Y,Z", 1e8))
      .needs(gradients);
  add_json(cmd, o->json);
  add_measure_options(cmd, o->measure);
  add_by(cmd, o->measure.by);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return calibrate(*o, context); }; });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <limits>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr double min_current = 1e-9;   // [A] smaller currents count as zero
constexpr double min_distance = 1e-6;  // [µm] so do smaller distances
// Currents and positions that differ by less than this relative amount are equal.
constexpr double min_difference = 1e-6;

constexpr std::array<const char*, 5> gradient_names{"dBx/dx", "dBx/dy", "dBx/dz", "dBy/dy",
                                                    "dBy/dz"};

Eigen::Index whole(std::size_t n) { return static_cast<Eigen::Index>(n); }

/// Field at `off` from the centre as a linear function of five gradients.
Eigen::Matrix<double, 3, 5> field_of_gradients(const Eigen::Vector3d& off) {
  Eigen::Matrix<double, 3, 5> m;
  for (int k = 0; k < 5; ++k) m.col(k) = gradient_matrix(FiveGradients::Unit(k)) * off;
  return m;
}

/// Design matrix of the linear fit. Without gradients the axes are independent: a row for each
/// measurement, a column for each source, three right-hand sides. With gradients a measurement has
/// three rows, a source 3 + 5 columns, and there is one right-hand side. A source is a coil or the
/// field at zero current; all columns are scaled to at most about 1.
class Design {
 public:
  Design(const FieldMeasurements& measured, const FitOptions& options)
      : measured_(measured), gradients_(options.gradients), offset_(options.offset) {
    const Eigen::Index n = whole(measured.coils.size());
    max_currents_ = Eigen::VectorXd::Constant(n, 0);
    Eigen::AlignedBox3d box;
    for (const FieldMeasurement& row : measured.rows) {
      max_currents_ = max_currents_.cwiseMax(row.currents.cwiseAbs());
      box.extend(row.position);
    }
    for (double& most : max_currents_)
      if (most < min_current) most = 1;
    centre_ = options.centre.value_or(gradients_ ? Eigen::Vector3d(box.center())
                                                 : Eigen::Vector3d::Zero());
    for (const Eigen::Vector3d& corner : {box.min(), box.max()})
      length_ = std::max(length_, (corner - centre_).cwiseAbs().maxCoeff());
    if (length_ < min_distance) length_ = 1;
  }

  Eigen::Index sources() const { return max_currents_.size() + (offset_ ? 1 : 0); }
  Eigen::Index rows_each() const { return gradients_ ? 3 : 1; }
  Eigen::Index columns_each() const { return gradients_ ? 8 : 1; }
  Eigen::Index columns() const { return sources() * columns_each(); }
  Eigen::Index sides() const { return gradients_ ? 1 : 3; }
  const Eigen::Vector3d& centre() const { return centre_; }
  /// Amount of a source by which its columns were divided [A]; 1 for the field at zero current.
  double most(Eigen::Index source) const {
    return source < max_currents_.size() ? max_currents_[source] : 1;
  }
  double length() const { return length_; }  ///< distance by which gradients were multiplied [µm]

  /// The rows of a measurement, with the right-hand sides behind the columns.
  Eigen::MatrixXd rows(const FieldMeasurement& row) const {
    Eigen::MatrixXd rows(rows_each(), columns() + sides());
    Eigen::Matrix<double, 3, 8> of_one;
    if (gradients_) of_one << Eigen::Matrix3d::Identity(), slopes(row);
    for (Eigen::Index s = 0; s < sources(); ++s) {
      const double amount = s < max_currents_.size() ? row.currents[s] / max_currents_[s] : 1;
      if (gradients_)
        rows.middleCols(8 * s, 8) = amount * of_one;
      else
        rows(0, s) = amount;
    }
    if (gradients_)
      rows.col(columns()) = row.field;
    else
      rows.rightCols(3) = row.field.transpose();
    return rows;
  }

 private:
  Eigen::Matrix<double, 3, 5> slopes(const FieldMeasurement& row) const {
    return field_of_gradients((row.position - centre_) / length_);
  }

  const FieldMeasurements& measured_;
  bool gradients_, offset_;
  Eigen::VectorXd max_currents_;
  Eigen::Vector3d centre_;
  double length_ = 0;
};

/// The triangle R of a QR decomposition of the design, row by row, so that a long file takes the
/// memory of a short one.
Eigen::MatrixXd reduced_triangle(const Design& design, const FieldMeasurements& measured) {
  const Eigen::Index columns = design.columns() + design.sides();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(4 * columns + 3, columns);
  Eigen::Index filled = 0;
  const auto fold = [&] {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows.topRows(filled));
    const Eigen::Index left = std::min(filled, columns);
    const Eigen::MatrixXd R = qr.matrixQR().topRows(left).triangularView<Eigen::Upper>();
    rows.setZero();
    rows.topRows(left) = R;
    filled = left;
  };
  for (const FieldMeasurement& row : measured.rows) {
    if (filled + design.rows_each() > rows.rows()) fold();
    rows.middleRows(filled, design.rows_each()) = design.rows(row);
    filled += design.rows_each();
  }
  fold();
  return rows.topRows(columns);
}

/// A least-squares problem with pivots.
struct Solver {
  explicit Solver(const Design& design, const FieldMeasurements& measured) {
    const Eigen::MatrixXd triangle = reduced_triangle(design, measured);
    sides = triangle.rightCols(design.sides());
    qr.setThreshold(min_difference);
    qr.compute(triangle.leftCols(design.columns()));
  }
  bool is_determined() const { return qr.rank() == qr.cols(); }
  /// Basis of the null space; columns have length 1.
  Eigen::MatrixXd null_space() const {
    const Eigen::Index rank = qr.rank();
    const Eigen::Index left = qr.cols() - rank;
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(qr.cols(), left);
    columns.topRows(rank) = -qr.matrixR()
                                 .topLeftCorner(rank, rank)
                                 .triangularView<Eigen::Upper>()
                                 .solve(qr.matrixR().topRightCorner(rank, left));
    columns.bottomRows(left).setIdentity();
    columns = qr.colsPermutation() * columns;
    columns.colwise().normalize();
    return columns;
  }
  /// Square roots of the diagonal of (XᵀX)⁻¹.
  Eigen::VectorXd spread() const {
    const Eigen::MatrixXd inverse = qr.matrixR()
                                        .topLeftCorner(qr.cols(), qr.cols())
                                        .triangularView<Eigen::Upper>()
                                        .solve(Eigen::MatrixXd::Identity(qr.cols(), qr.cols()));
    return qr.colsPermutation() * inverse.rowwise().norm();
  }

  Eigen::MatrixXd sides;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
};

constexpr double weight_of_unknown = 1e-3;  // smaller entries of the null space are rounding

[[noreturn]] void fail_fields(const Solver& solver, const FieldMeasurements& measured,
                              bool with_offset) {
  std::vector<std::string> open;
  const Eigen::MatrixXd unknown = solver.null_space();
  for (std::size_t i = 0; i < measured.coils.size(); ++i)
    if (unknown.row(whole(i)).norm() > weight_of_unknown) open.push_back(quote(measured.coils[i]));
  throw InputError(measured.file, fmt::format("{} measurements do not determine the fields of {}: "
                                              "currents are missing that change each "
                                              "of them apart from the others{}",
                                              measured.rows.size(), fmt::join(open, ", "),
                                              with_offset ? ", and one without them all" : ""));
}

[[noreturn]] void fail_gradients(const Solver& solver, const FieldMeasurements& measured,
                                 const Design& design) {
  std::vector<std::string> open, sources;
  const Eigen::MatrixXd unknown = solver.null_space();
  std::array<bool, 5> named{};
  for (Eigen::Index s = 0; s < design.sources(); ++s) {
    bool any = false;
    for (std::size_t k = 0; k < 5; ++k)
      if (unknown.row(8 * s + 3 + whole(k)).norm() > weight_of_unknown) any = named[k] = true;
    if (!any) continue;
    const auto i = static_cast<std::size_t>(s);
    sources.push_back(i < measured.coils.size() ? quote(measured.coils[i])
                                                : "the field without current");
  }
  for (std::size_t k = 0; k < 5; ++k)
    if (named[k]) open.emplace_back(gradient_names[k]);
  throw InputError(
      measured.file,
      fmt::format("{} measurements do not determine {} of {}: each needs three positions or more "
                  "that are not on one line",
                  measured.rows.size(), fmt::join(open, ", "), fmt::join(sources, ", ")));
}

/// Writes the solution of a source to the coils, or to the field without current.
void put(const Design& design, const Eigen::MatrixXd& fit, Eigen::Index source, MatrixCoils& to) {
  const auto i = static_cast<std::size_t>(source);
  const bool is_coil = i < to.names.size();
  const double most = design.most(source);
  for (std::size_t k = 0; k < 3; ++k) {
    const double value = design.sides() == 3 ? fit(source, whole(k)) : fit(8 * source + whole(k));
    (is_coil ? to.field[k][i] : to.offset[k]) = value / most + 0.0;  // no -0
  }
  if (design.sides() == 3) return;
  const double slope = 1 / (most * design.length() * mt_per_um_of_t_per_m);
  for (std::size_t k = 0; k < 5; ++k)
    (is_coil ? to.gradient[k][i] : to.offset_gradient[k]) = fit(8 * source + 3 + whole(k)) * slope;
}

void find_errors(const Design& design, const Solver& solver, FittedMatrix& result) {
  const Eigen::Index n = whole(result.coils.names.size());
  const auto measured = static_cast<double>(result.residuals.size());
  const bool apart = design.sides() == 3;
  result.field_errors.resize(3, n);
  if (!apart) result.gradient_errors.resize(5, n);
  const Eigen::VectorXd spread = solver.spread();
  for (int k = 0; k < 8; ++k) {
    if (apart && k >= 3) break;
    // Without gradients each axis has its own noise; with them the axes share their unknowns.
    const double squares =
        measured * (apart ? result.rms[k] * result.rms[k] : result.total_rms * result.total_rms);
    const double freedom = static_cast<double>(result.freedom) / (apart ? 3 : 1);
    const double noise =
        freedom > 0 ? std::sqrt(squares / freedom) : std::numeric_limits<double>::quiet_NaN();
    for (Eigen::Index s = 0; s < n; ++s) {
      const double error = noise * spread[apart ? s : 8 * s + k] / design.most(s);
      if (k < 3)
        result.field_errors(k, s) = error;
      else
        result.gradient_errors(k - 3, s) = error / (design.length() * mt_per_um_of_t_per_m);
    }
  }
}

void find_residuals(const Design& design, const FieldMeasurements& measured,
                    const Eigen::MatrixXd& fit, FittedMatrix& result) {
  for (const FieldMeasurement& row : measured.rows) {
    const Eigen::MatrixXd rows = design.rows(row);
    const Eigen::MatrixXd left =
        rows.rightCols(design.sides()) - rows.leftCols(design.columns()) * fit;
    const Eigen::Vector3d residual = left.reshaped();
    result.rms += residual.cwiseAbs2();
    if (residual.norm() > result.worst) {
      result.worst = residual.norm();
      result.worst_row = result.residuals.size();
    }
    result.residuals.push_back(residual);
  }
  result.rms = (result.rms / static_cast<double>(measured.rows.size())).cwiseSqrt();
  result.total_rms = result.rms.norm();
}

constexpr double rounding_share = 1e-9;  // of the strongest field
constexpr double certain = 3;            // standard errors

/// Whether the values of a coil are more than rounding and errors; NaN errors are unknown.
bool stands_out(const std::vector<std::vector<double>>& values, const Eigen::MatrixXd& errors,
                std::size_t coil, double floor) {
  double squares = 0;
  for (const std::vector<double>& row : values) squares += row[coil] * row[coil];
  if (!(std::sqrt(squares) > floor)) return false;
  return !(std::sqrt(squares) <= certain * errors.col(whole(coil)).norm());
}

void require_fields(const FieldMeasurements& measured, const FitOptions& options) {
  const Solver fields(Design(measured, {.offset = options.offset}), measured);
  if (!fields.is_determined()) fail_fields(fields, measured, options.offset);
}

}  // namespace

bool determines_gradients(const FieldMeasurements& measured, const FitOptions& options) {
  const FitOptions with{.offset = options.offset, .gradients = true, .centre = options.centre};
  return Solver(Design(measured, with), measured).is_determined();
}

FittedMatrix fit_matrix(const FieldMeasurements& measured, const FitOptions& options) {
  const Design design(measured, options);
  const Solver solver(design, measured);
  if (!solver.is_determined()) {
    require_fields(measured, options);
    fail_gradients(solver, measured, design);
  }
  const Eigen::MatrixXd fit = solver.qr.solve(solver.sides);
  FittedMatrix result;
  result.coils.names = measured.coils;
  result.coils.field.assign(3, std::vector<double>(measured.coils.size()));
  if (options.gradients) {
    result.coils.gradient.assign(5, std::vector<double>(measured.coils.size()));
    result.coils.centre = {design.centre()[0], design.centre()[1], design.centre()[2]};
  }
  for (Eigen::Index s = 0; s < design.sources(); ++s) put(design, fit, s, result.coils);
  find_residuals(design, measured, fit, result);
  const auto unknowns = static_cast<std::size_t>(design.columns() * design.sides());
  result.freedom = std::max(3 * measured.rows.size(), unknowns) - unknowns;
  find_errors(design, solver, result);
  return result;
}

std::optional<LargestError> largest_error(const FittedMatrix& fit) {
  std::optional<LargestError> largest;
  if (fit.freedom == 0) return largest;
  for (std::size_t i = 0; i < fit.coils.names.size(); ++i) {
    const Eigen::Vector3d field(fit.coils.field[0][i], fit.coils.field[1][i],
                                fit.coils.field[2][i]);
    if (field.isZero(0)) continue;
    const double share = fit.field_errors.col(whole(i)).maxCoeff() / field.norm();
    if (!largest || share > largest->share) largest = {i, share};
  }
  return largest;
}

void require_effects(const FieldMeasurements& measured, const FittedMatrix& fit) {
  const Eigen::Map<const Eigen::Vector3d> centre(fit.coils.centre.data());
  double strongest = 0, distance = min_distance;
  for (const FieldMeasurement& row : measured.rows) {
    strongest = std::max(strongest, row.field.norm());
    distance = std::max(distance, (row.position - centre).norm());
  }
  std::vector<std::string> without;
  for (std::size_t i = 0; i < measured.coils.size(); ++i) {
    double most = 0;
    for (const FieldMeasurement& row : measured.rows)
      most = std::max(most, std::abs(row.currents[whole(i)]));
    const double floor = rounding_share * strongest / most;
    const double slope_floor = floor / (distance * mt_per_um_of_t_per_m);
    if (!stands_out(fit.coils.field, fit.field_errors, i, floor) &&
        !stands_out(fit.coils.gradient, fit.gradient_errors, i, slope_floor))
      without.push_back(quote(measured.coils[i]));
  }
  if (without.empty()) return;
  throw InputError(
      measured.file,
      fmt::format(
          "the currents of {} do not change the field by more than its errors: are the probe and "
          "these coils connected? Line {} fits worst, by {:.3g} mT",
          fmt::join(without, ", "), measured.rows[fit.worst_row].line, fit.worst));
}

}  // namespace microswarm::actuation

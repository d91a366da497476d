// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "microswarm/actuation/coils/text_rows.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

constexpr std::uint64_t max_bytes = 64ULL << 20;
constexpr double largest = 1e9;       // maximum of any number in the file
constexpr double min_current = 1e-9;  // [A] smaller currents count as zero
// Currents that differ by less than this relative amount are equal.
constexpr double min_difference = 1e-6;

constexpr std::array<std::string_view, 3> field_columns{"bx_mt", "by_mt", "bz_mt"};
constexpr std::array<std::string_view, 3> place_columns{"x_um", "y_um", "z_um"};

/// Column indices in the header.
struct Columns {
  std::size_t count = 0;
  std::vector<std::size_t> currents;
  std::array<std::size_t, 3> field{};
  std::array<std::optional<std::size_t>, 3> place;
};

std::optional<std::size_t> find(const std::vector<std::string_view>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

Columns read_header(const TextRows& rows, std::vector<std::string>& coils) {
  const std::vector<std::string_view> names = rows.pieces(',');
  Columns columns{.count = names.size()};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string_view name = names[i];
    if (std::find(names.begin() + static_cast<std::ptrdiff_t>(i) + 1, names.end(), name) !=
        names.end())
      rows.fail(fmt::format("column {} stands twice", quote(name)));
    if (!name.starts_with("i_") || !name.ends_with("_a") || name.size() < 5) continue;
    columns.currents.push_back(i);
    coils.emplace_back(name.substr(2, name.size() - 4));
  }
  if (coils.empty() || coils.size() > 64)
    rows.fail(fmt::format("{} columns of currents, i_NAME_a, 1..64 expected", coils.size()));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::optional<std::size_t> at = find(names, field_columns[k]);
    if (!at) rows.fail(fmt::format("column '{}' is missing", field_columns[k]));
    columns.field[k] = *at;
    columns.place[k] = find(names, place_columns[k]);
  }
  return columns;
}

}  // namespace

FieldMeasurements parse_measurements(std::string_view text, std::string_view name) {
  TextRows rows(text, name);
  FieldMeasurements measured{.file = std::string(name)};
  if (!rows.next()) rows.fail("a header with the columns i_NAME_a, bx_mt, by_mt, bz_mt is missing");
  const Columns columns = read_header(rows, measured.coils);
  while (rows.next()) {
    const std::vector<std::string_view> pieces = rows.pieces(',');
    if (pieces.size() != columns.count)
      rows.fail(fmt::format("{} fields, the header has {}", pieces.size(), columns.count));
    const auto value = [&](std::size_t column, std::string_view what) {
      const double number = rows.number(pieces[column], what);
      if (!(std::abs(number) <= largest))
        rows.fail(
            fmt::format("{} is {}, at most {}", what, number_text(number), number_text(largest)));
      return number;
    };
    FieldMeasurement row{.currents = Eigen::VectorXd(measured.coils.size()), .line = rows.line()};
    for (std::size_t i = 0; i < measured.coils.size(); ++i)
      row.currents[static_cast<Eigen::Index>(i)] =
          value(columns.currents[i], "current of " + measured.coils[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto d = static_cast<Eigen::Index>(k);
      row.field[d] = value(columns.field[k], field_columns[k]);
      row.place[d] = columns.place[k] ? value(*columns.place[k], place_columns[k]) : 0;
    }
    measured.rows.push_back(std::move(row));
  }
  if (measured.rows.empty()) rows.fail("no measurements follow the header");
  return measured;
}

FieldMeasurements read_measurements(const std::filesystem::path& path) {
  return parse_measurements(read_file(path, max_bytes), path.string());
}

namespace {

/// Basis of the null space; columns have length 1.
Eigen::MatrixXd null_space(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr) {
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

}  // namespace

FittedMatrix fit_matrix(const FieldMeasurements& measured, bool with_offset) {
  const auto n = static_cast<Eigen::Index>(measured.coils.size());
  const auto count = static_cast<Eigen::Index>(measured.rows.size());
  Eigen::MatrixXd inputs(count, n + (with_offset ? 1 : 0));
  Eigen::MatrixXd fields(count, 3);
  for (Eigen::Index r = 0; r < count; ++r) {
    const FieldMeasurement& row = measured.rows[static_cast<std::size_t>(r)];
    inputs.row(r).head(n) = row.currents.transpose();
    fields.row(r) = row.field.transpose();
  }
  // Scale each column by its maximum, so small and large currents count alike.
  Eigen::VectorXd scale = inputs.leftCols(n).cwiseAbs().colwise().maxCoeff().transpose();
  for (double& s : scale)
    if (s < min_current) s = 1;
  inputs.leftCols(n) = inputs.leftCols(n) * scale.cwiseInverse().asDiagonal();
  if (with_offset) inputs.col(n).setOnes();

  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(inputs);
  qr.setThreshold(min_difference);
  if (qr.rank() < inputs.cols()) {
    std::vector<std::string> open;
    const Eigen::MatrixXd unknown = null_space(qr);
    for (Eigen::Index i = 0; i < n; ++i)
      if (unknown.row(i).norm() > 1e-3)
        open.push_back(quote(measured.coils[static_cast<std::size_t>(i)]));
    throw InputError(fmt::format(
        "{}: {} measurements do not tell the fields of {}: currents are missing that change each "
        "of them apart from the others{}",
        measured.file, count, fmt::join(open, ", "),
        with_offset ? ", and one without them all" : ""));
  }
  const Eigen::MatrixXd fit = qr.solve(fields);
  const Eigen::MatrixXd residuals = fields - inputs * fit;

  FittedMatrix result;
  result.coils.names = measured.coils;
  result.coils.field.assign(3, std::vector<double>(measured.coils.size()));
  for (Eigen::Index k = 0; k < 3; ++k) {
    for (Eigen::Index i = 0; i < n; ++i)
      result.coils.field[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] =
          fit(i, k) / scale[i];
    if (with_offset) result.coils.offset[static_cast<std::size_t>(k)] = fit(n, k);
    result.rms[k] = std::sqrt(residuals.col(k).squaredNorm() / static_cast<double>(count));
  }
  result.total_rms = result.rms.norm();
  for (Eigen::Index r = 0; r < count; ++r) {
    result.residuals.emplace_back(residuals.row(r).transpose());
    if (result.residuals.back().norm() > result.worst) {
      result.worst = result.residuals.back().norm();
      result.worst_row = static_cast<std::size_t>(r);
    }
  }
  return result;
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/field_measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "microswarm/actuation/coils/text_rows.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/csv.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr std::uint64_t max_bytes = 64ULL << 20;
constexpr double max_number = 1e9;  // maximum of any number in the file

constexpr std::array<std::string_view, 3> field_columns{"bx_mt", "by_mt", "bz_mt"};
constexpr std::array<std::string_view, 3> place_columns{"x_um", "y_um", "z_um"};

/// Column indices in the header.
struct Columns {
  std::size_t count = 0;
  char separator = ',';
  std::vector<std::size_t> currents;
  std::array<std::size_t, 3> field{};
  std::array<std::optional<std::size_t>, 3> position;
  std::vector<std::size_t> planned;  // empty, or one for each current
};

std::optional<std::size_t> find(const std::vector<std::string_view>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

Columns read_header(const TextRows& rows, std::vector<std::string>& coils) {
  const char separator = csv_separator(rows.row());
  const std::vector<std::string_view> names = csv_cells(rows.row(), separator);
  Columns columns{.count = names.size(), .separator = separator};
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
    columns.position[k] = find(names, place_columns[k]);
  }
  for (const std::string& coil : coils)
    if (const auto at = find(names, fmt::format("planned_{}_a", coil)))
      columns.planned.push_back(*at);
  if (columns.planned.size() != coils.size()) columns.planned.clear();
  return columns;
}

}  // namespace

FieldMeasurements parse_measurements(std::string_view text, std::string_view name) {
  TextRows rows(text, name);
  FieldMeasurements measured{.file = std::string(name)};
  if (!rows.next()) rows.fail("a header with the columns i_NAME_a, bx_mt, by_mt, bz_mt is missing");
  const Columns columns = read_header(rows, measured.coils);
  require_clear_commas(text, name, columns.separator);
  while (rows.next()) {
    const std::vector<std::string_view> pieces = csv_cells(rows.row(), columns.separator);
    if (pieces.size() != columns.count)
      rows.fail(fmt::format("{} fields, the header has {}", pieces.size(), columns.count));
    const auto value = [&](std::size_t column, std::string_view what) {
      const double number = rows.number(csv_number(pieces[column], columns.separator), what);
      if (!(std::abs(number) <= max_number))
        rows.fail(fmt::format("{} is {}, at most {}", what, number_text(number),
                              number_text(max_number)));
      return number;
    };
    FieldMeasurement row{.currents = Eigen::VectorXd(measured.coils.size()), .line = rows.line()};
    for (std::size_t i = 0; i < measured.coils.size(); ++i)
      row.currents[static_cast<Eigen::Index>(i)] =
          value(columns.currents[i], "current of " + measured.coils[i]);
    row.planned.resize(static_cast<Eigen::Index>(columns.planned.size()));
    for (std::size_t i = 0; i < columns.planned.size(); ++i)
      row.planned[static_cast<Eigen::Index>(i)] =
          value(columns.planned[i], "planned current of " + measured.coils[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto d = static_cast<Eigen::Index>(k);
      row.field[d] = value(columns.field[k], field_columns[k]);
      row.position[d] = columns.position[k] ? value(*columns.position[k], place_columns[k]) : 0;
    }
    measured.rows.push_back(std::move(row));
  }
  if (measured.rows.empty()) rows.fail("no measurements follow the header");
  return measured;
}

FieldMeasurements read_measurements(const std::filesystem::path& path) {
  return parse_measurements(read_file(path, max_bytes), path.string());
}

}  // namespace microswarm::actuation

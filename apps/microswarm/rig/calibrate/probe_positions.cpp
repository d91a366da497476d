// SPDX-License-Identifier: Apache-2.0
#include "rig/calibrate/probe_positions.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "microswarm/actuation/coils/text_rows.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

constexpr std::size_t max_positions = 1000;

std::vector<Eigen::Vector3d> positions_in(const std::string& file) {
  const std::string text = read_file(file, 1U << 20);
  actuation::TextRows rows(text, file);
  if (!rows.next() || rows.pieces(',') != std::vector<std::string_view>{"x_um", "y_um", "z_um"})
    rows.fail("the header must be x_um,y_um,z_um");
  std::vector<Eigen::Vector3d> positions;
  while (rows.next()) {
    const std::vector<std::string_view> cells = rows.pieces(',');
    if (cells.size() != 3) rows.fail(fmt::format("{} numbers, 3 expected", cells.size()));
    Eigen::Vector3d position;
    for (std::size_t k = 0; k < 3; ++k)
      position[static_cast<Eigen::Index>(k)] = rows.number(cells[k], "position");
    if (position.cwiseAbs().maxCoeff() > max_place)
      rows.fail(fmt::format("position {} is beyond {:.6g} µm", triple_text(position), max_place));
    positions.push_back(position);
  }
  if (positions.empty()) rows.fail("no positions follow the header");
  return positions;
}

}  // namespace

std::vector<Eigen::Vector3d> probe_positions(const std::string& given,
                                             const actuation::CoilSystem& system) {
  if (given.empty()) return {system.centre()};
  std::vector<Eigen::Vector3d> positions;
  for (const std::string_view one : split(given, ';')) {
    const std::vector<double> v = numbers(one);
    if (v.size() != 3) break;
    positions.emplace_back(v[0], v[1], v[2]);
    if (positions.back().cwiseAbs().maxCoeff() > max_place)
      throw InputError(fmt::format("--positions: {} is beyond {:.6g} µm", quote(one), max_place));
  }
  if (positions.size() != split(given, ';').size()) {
    const bool is_list = given.find_first_of(",;") != std::string::npos;
    if (std::error_code none; is_list && !std::filesystem::exists(given, none))
      throw InputError("--positions: must be X,Y,Z;… of three numbers each, or a CSV file, not " +
                       quote(given));
    positions = positions_in(given);
  }
  if (positions.size() > max_positions)
    throw InputError(
        fmt::format("--positions: {} positions, at most {}", positions.size(), max_positions));
  return positions;
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/measurement_log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr std::uint64_t max_log_bytes = 64ULL << 20;

std::string header_for(const std::vector<std::string>& coils) {
  std::string header;
  for (const std::string& coil : coils) {
    if (coil.find_first_of(",\r\n") != std::string::npos || trimmed(coil) != coil)
      throw InputError(fmt::format("coil {} cannot be the name of a column", quote(coil)));
    header += fmt::format("i_{}_a,", coil);
  }
  header += "x_um,y_um,z_um,bx_mt,by_mt,bz_mt,readings,bx_sd_mt,by_sd_mt,bz_sd_mt";
  for (const std::string& coil : coils) header += fmt::format(",planned_{}_a", coil);
  return header;
}

bool is_row(std::string_view line) {
  const std::string_view text = trimmed(line);
  return !text.empty() && text.front() != '#';
}

std::string row_text(const Eigen::VectorXd& currents, const Eigen::VectorXd& planned,
                     const Eigen::Vector3d& position, const FieldReading& reading) {
  std::vector<std::string> cells;
  for (const double current : currents) cells.push_back(number_text(current + 0.0));  // no -0
  for (const double x : position) cells.push_back(number_text(x));
  for (const double b : reading.mean) cells.push_back(number_text(b));
  cells.push_back(std::to_string(reading.count));
  for (const double sd : reading.spread)
    cells.push_back(reading.count > 1 ? number_text(sd) : std::string());
  for (const double current : planned) cells.push_back(number_text(current + 0.0));
  return fmt::format("{}", fmt::join(cells, ","));
}

}  // namespace

FieldReading mean_reading(const std::vector<Eigen::Vector3d>& readings) {
  assert(!readings.empty());
  const auto n = static_cast<double>(readings.size());
  FieldReading result{.count = static_cast<int>(readings.size())};
  for (const Eigen::Vector3d& b : readings) result.mean += b / n;
  for (const Eigen::Vector3d& b : readings) result.spread += (b - result.mean).cwiseAbs2();
  if (readings.size() > 1) result.spread = (result.spread / (n - 1)).cwiseSqrt();
  return result;
}

MeasurementLog::MeasurementLog(std::filesystem::path file, const std::vector<std::string>& coils)
    : file_(std::move(file)) {
  const std::string header = header_for(coils);
  measured_.file = file_.string();
  measured_.coils = coils;
  if (std::error_code none; !std::filesystem::exists(file_, none)) {
    lines_.push_back(header);
    return;
  }
  const std::string text = read_file(file_, max_log_bytes);
  Lines lines(text, file_.string());
  bool has_header = false;
  int rows = 0;
  while (const auto line = lines.next()) {
    if (is_row(*line) && !has_header) {
      has_header = true;
      if (trimmed(*line) != header)
        lines.fail("the columns are not those of a measurement of these coils, " + header);
    } else {
      rows += is_row(*line);
    }
    lines_.emplace_back(*line);
  }
  if (!has_header) lines_.push_back(header);
  if (rows > 0) measured_ = parse_measurements(text, file_.string());
}

void MeasurementLog::add(const Eigen::VectorXd& currents, const Eigen::VectorXd& planned,
                         const Eigen::Vector3d& position, const FieldReading& reading) {
  lines_.push_back(row_text(currents, planned, position, reading));
  write();
  measured_.rows.push_back(
      {currents, position, reading.mean, static_cast<int>(lines_.size()), planned});
}

void MeasurementLog::remove_last() {
  if (measured_.rows.empty()) return;
  while (!is_row(lines_.back())) lines_.pop_back();
  lines_.pop_back();
  write();
  measured_.rows.pop_back();
}

void MeasurementLog::write() {
  write_file_atomically(file_, fmt::format("{}\n", fmt::join(lines_, "\n")));
}

}  // namespace microswarm::actuation

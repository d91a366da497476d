// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/command_log.hpp"

#include <cmath>
#include <exception>
#include <optional>

#include "microswarm/core/text/text.hpp"
#include "microswarm/io/columns.hpp"

namespace microswarm::rig {
namespace {

/// Columns before the currents.
struct Commanded {
  double t = 0;
  std::optional<double> heading;
  double speed = 0;
  double bx = 0;
  double by = 0;
  double bz = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "Time on the record's clock."));
    visit(self.heading, deg("heading", "Commanded heading."));
    visit(self.speed, um_per_s("speed", "Commanded speed."));
    visit(self.bx, mt("bx", "Commanded field."));
    visit(self.by, mt("by", "Commanded field."));
    visit(self.bz, mt("bz", "Commanded field."));
  }
};

/// Columns after the currents.
struct Driven {
  double scale = 1;
  std::optional<double> device_scale;
  std::string status;
  std::optional<double> late;
  std::optional<double> round_trip;
  std::optional<double> seen;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.scale, plain("scale", "Scale of the command imposed by the limits."));
    visit(self.device_scale,
          plain("device_scale", "By the device's own limits; empty: no answer."));
    visit(self.status, plain("status", "Status of the driver, or dry."));
    visit(self.late, s("late", "Delay after the due time."));
    visit(self.round_trip, s("round_trip", "Round trip of the driver."));
    visit(self.seen, s("seen", "Time of the picture that the command answers."));
  }
};

/// Rounds to multiples of 1 / `per_one`, which keeps the lines short.
double rounded(double value, double per_one) { return std::round(value * per_one) / per_one; }

template <class Row>
const std::vector<io::Column>& columns() {
  static const std::vector<io::Column> all = io::to_columns<Row>(io::ColumnUnits::shown);
  return all;
}

std::string log_line(const Commanded& before, const Eigen::VectorXd& currents,
                     const Driven& after) {
  std::string line = io::csv_line(columns<Commanded>(), &before);
  for (const double i : currents) line += "," + number_text(rounded(i, 1e5));
  return line + "," + io::csv_line(columns<Driven>(), &after) + "\n";
}

std::string log_head(const actuation::CoilSystem& system) {
  std::string head = io::csv_head(columns<Commanded>());
  for (const std::string& coil : system.coil_names()) head += ",i_" + coil + "_a";
  return head + "," + io::csv_head(columns<Driven>()) + "\n";
}

}  // namespace

CommandLog::CommandLog(const std::filesystem::path& folder, const actuation::CoilSystem& system,
                       bool dry, const LogLimits& limits)
    : coils_(system.size()), dry_(dry) {
  if (!folder.empty()) parts_.emplace(folder / "commands.csv", log_head(system), limits);
}

void CommandLog::add(const CoilMoment& m, double start) {
  if (!parts_) return;
  start_ = start;
  const Eigen::Vector3d& b = m.output.wanted;
  std::optional<double> acknowledged;
  if (actuation::is_acknowledged(m.output.status))
    acknowledged = rounded(m.output.device_scale, 1e4);
  parts_->add(log_line({.t = rounded(m.t - start, 1e4),
                        .heading = m.command.heading,
                        .speed = rounded(m.command.speed, 1e3),
                        .bx = rounded(b.x(), 1e5),
                        .by = rounded(b.y(), 1e5),
                        .bz = rounded(b.z(), 1e5)},
                       m.output.currents,
                       {.scale = rounded(m.output.scale, 1e4),
                        .device_scale = acknowledged,
                        .status = std::string(dry_ ? "dry" : to_string(m.output.status)),
                        .late = rounded(m.late, 1e6),
                        .round_trip = rounded(m.round_trip, 1e6),
                        .seen = rounded(m.seen - start, 1e4)}));
}

std::string CommandLog::finish(const actuation::StopReport& zero) noexcept {
  if (!parts_) return {};
  try {
    if (start_)
      parts_->add(log_line({.t = rounded(zero.at - *start_, 1e4)}, Eigen::VectorXd::Zero(coils_),
                           {.status = dry_             ? "dry"
                                      : zero.confirmed ? "zero"
                                                       : "zero_not_confirmed"}));
  } catch (const std::exception&) {  // finish() below reports it
  }
  return parts_->finish();
}

}  // namespace microswarm::rig

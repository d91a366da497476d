// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/rig_log.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "microswarm/io/hdf5_tables.hpp"

namespace microswarm::experiment {
namespace {

void write_column(io::Hdf5Writer& out, const std::string& path, const auto& values,
                  std::string_view unit, std::string_view doc) {
  out.dataset(path, values);
  out.attribute(path, "unit", unit);
  out.attribute(path, "description", doc);
}

/// Entries k, k + stride, k + 2 stride, …
std::vector<double> every_nth(const std::vector<double>& values, std::size_t stride,
                              std::size_t k) {
  std::vector<double> some;
  for (std::size_t i = k; i < values.size(); i += stride) some.push_back(values[i]);
  return some;
}

std::string current_path(std::size_t coil) { return fmt::format("/rig/currents/i_{}_a", coil + 1); }

constexpr std::int64_t max_coils = 64;

/// Column of the table of pictures.
struct PictureColumn {
  const char* name;
  double PictureRow::*value;
  const char* unit;
  const char* doc;
};
constexpr std::array<PictureColumn, 6> picture_columns{
    {{"t_s", &PictureRow::t, "s", "Time of the picture."},
     {"light", &PictureRow::light, "", "Mean grey value over that at the start."},
     {"focus", &PictureRow::focus, "", "Sharpness of walls or details over that at the start."},
     {"shift_px", &PictureRow::shift_px, "px",
      "Displacement of the map at the workspace's worst corner; NaN: not known."},
     {"unseen_share", &PictureRow::unseen_share, "",
      "Share of the pictures of the last seconds in which the swarm was not found."},
     {"follow_share", &PictureRow::follow_share, "",
      "Distance that the swarm moved over that commanded, so far; NaN: not known."}}};

std::string picture_path(const PictureColumn& column) {
  return std::string("/rig/pictures/") + column.name;
}

void write_pictures(io::Hdf5Writer& out, const std::vector<PictureRow>& rows) {
  out.attribute("/rig", "picture_rows", static_cast<std::int64_t>(rows.size()));
  for (const PictureColumn& column : picture_columns) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const PictureRow& row : rows) values.push_back(row.*column.value);
    write_column(out, picture_path(column), values, column.unit, column.doc);
  }
}

std::vector<PictureRow> read_pictures(const io::Hdf5Reader& in) {
  if (!in.has_attribute("/rig", "picture_rows")) return {};  // of an older program
  std::vector<PictureRow> rows(in.length(picture_path(picture_columns.front())));
  for (const PictureColumn& column : picture_columns) {
    const std::vector<double> values = in.numbers(picture_path(column));
    if (values.size() != rows.size()) in.fail("/rig/pictures has columns of different lengths");
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*column.value = values[i];
  }
  return rows;
}

}  // namespace

void RigLog::see(double t, std::int64_t body, Vec2 position, double radius) {
  seen_at.push_back(t);
  bodies.push_back(body);
  positions.push_back(position);
  radii.push_back(radius);
}

void write_rig_log(io::Hdf5Writer& out, const RigLog& log) {
  if (log.empty()) return;
  out.text("/rig/file", log.rig_file);
  out.attribute("/rig/file", "description", "All parameters of the rig, YAML.");
  out.text("/rig/coil_system", log.coils_file);
  out.attribute("/rig/coil_system", "description", "The coil system's file, YAML.");
  if (!log.commissioning.empty()) {
    out.attribute("/rig", "commissioned", std::int64_t{1});
    out.text("/rig/commissioning", log.commissioning);
    out.attribute("/rig/commissioning", "description", "The rig's commissioning record, YAML.");
  }
  if (!log.turning_at.empty()) {
    out.attribute("/rig", "frequency_changes", static_cast<std::int64_t>(log.turning.size()));
    write_column(out, "/rig/turning/t_s", log.turning_at, "s", "Time of the change.");
    write_column(out, "/rig/turning/frequency_hz", log.turning, "Hz",
                 "Frequency of the field from then on.");
  }
  out.attribute("/rig", "began", log.began);
  out.attribute("/rig", "note", log.note);
  out.attribute("/rig", "coils", static_cast<std::int64_t>(log.coils.size()));
  write_column(out, "/rig/currents/t_s", log.driven_at, "s", "Time of the sending.");
  write_column(out, "/rig/currents/driven_s", log.answered_at, "s",
               "When the driver had the currents.");
  write_column(out, "/rig/currents/seen_s", log.pictured_at, "s",
               "Time of the picture that the currents answer.");
  if (log.currents_until) out.attribute("/rig", "currents_until_s", *log.currents_until);
  if (log.seen_until) out.attribute("/rig", "seen_until_s", *log.seen_until);
  if (log.latency) io::write_attributes(out, "/rig", type_of<RigLatency>(), &*log.latency);
  for (std::size_t c = 0; c < log.coils.size(); ++c) {
    const std::string path = current_path(c);
    write_column(out, path, every_nth(log.currents, log.coils.size(), c), "A",
                 "Current that the device last acknowledged.");
    out.attribute(path, "coil", log.coils[c]);
  }
  std::vector<double> x, y;
  for (const Vec2& position : log.positions) {
    x.push_back(position.x);
    y.push_back(position.y);
  }
  write_column(out, "/rig/seen/t_s", log.seen_at, "s", "Time of the picture.");
  write_column(out, "/rig/seen/body", log.bodies, "", "-1: the swarm; else an obstacle's number.");
  write_column(out, "/rig/seen/x_um", x, "µm", "Centre of the body.");
  write_column(out, "/rig/seen/y_um", y, "µm", "Centre of the body.");
  write_column(out, "/rig/seen/radius_um", log.radii, "µm", "Radius of a circle around the body.");
  write_pictures(out, log.pictures);
}

RigLog read_rig_log(const io::Hdf5Reader& in) {
  RigLog log;
  if (!in.has_attribute("/", "rig") || !in.has_attribute("/rig", "began")) return log;
  log.began = in.text_attribute("/rig", "began");
  log.note = in.text_attribute("/rig", "note");
  log.rig_file = in.text("/rig/file");
  log.coils_file = in.text("/rig/coil_system");
  if (in.has_attribute("/rig", "commissioned")) log.commissioning = in.text("/rig/commissioning");
  if (in.has_attribute("/rig", "frequency_changes")) {
    log.turning_at = in.numbers("/rig/turning/t_s");
    log.turning = in.numbers("/rig/turning/frequency_hz");
    if (log.turning.size() != log.turning_at.size())
      in.fail("/rig/turning has columns of different lengths");
  }
  const std::int64_t coils = in.integer_attribute("/rig", "coils");
  if (coils < 0 || coils > max_coils) in.fail("attribute coils of /rig is out of range");
  log.driven_at = in.numbers("/rig/currents/t_s");
  if (in.has_attribute("/rig", "ticks")) {  // not of older programs
    log.answered_at = in.numbers("/rig/currents/driven_s");
    log.pictured_at = in.numbers("/rig/currents/seen_s");
    for (const std::size_t size : {log.answered_at.size(), log.pictured_at.size()})
      if (size != log.driven_at.size()) in.fail("/rig/currents has columns of different lengths");
    io::read_attributes(in, "/rig", type_of<RigLatency>(), &log.latency.emplace());
  }
  const auto until = [&in](const char* name) {
    return in.has_attribute("/rig", name) ? std::optional(in.number_attribute("/rig", name))
                                          : std::nullopt;
  };
  log.currents_until = until("currents_until_s");
  log.seen_until = until("seen_until_s");
  const auto count = static_cast<std::size_t>(coils);
  std::vector<std::vector<double>> columns;
  for (std::size_t c = 0; c < count; ++c) {
    const std::string path = current_path(c);
    if (in.length(path) != log.driven_at.size()) in.fail(path + " is not as long as its table");
    log.coils.push_back(in.text_attribute(path, "coil"));
    columns.push_back(in.numbers(path));
  }
  for (std::size_t i = 0; i < log.driven_at.size(); ++i)
    for (const std::vector<double>& column : columns) log.currents.push_back(column[i]);
  log.seen_at = in.numbers("/rig/seen/t_s");
  log.bodies = in.integers("/rig/seen/body");
  log.radii = in.numbers("/rig/seen/radius_um");
  const std::vector<double> x = in.numbers("/rig/seen/x_um"), y = in.numbers("/rig/seen/y_um");
  for (const std::size_t size : {log.bodies.size(), log.radii.size(), x.size(), y.size()})
    if (size != log.seen_at.size()) in.fail("/rig/seen has columns of different lengths");
  for (std::size_t i = 0; i < x.size(); ++i) log.positions.push_back({x[i], y[i]});
  log.pictures = read_pictures(in);
  return log;
}

}  // namespace microswarm::experiment

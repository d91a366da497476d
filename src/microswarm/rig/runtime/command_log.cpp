// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/command_log.hpp"

#include <fmt/format.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"

namespace microswarm {

CommandLog::CommandLog(const std::filesystem::path& folder, const CoilSystem& system, bool dry)
    : coils_(system.size()), dry_(dry) {
  if (folder.empty()) return;
  file_ = folder / "commands.csv";
  part_ = file_.string() + ".part";
  out_.open(part_);
  std::string head = "t_s,heading_deg,speed_um_per_s,bx_mt,by_mt,bz_mt";
  for (const std::string& coil : system.coil_names()) head += ",i_" + coil + "_a";
  write(head + ",scale,status,late_s,round_trip_s\n");
}

void CommandLog::add(const CoilMoment& m) {
  if (file_.empty()) return;
  if (began_ == 0) began_ = m.t;
  std::string row = fmt::format("{:.4f},{:.3f},{:.3f},{:.5f},{:.5f},{:.5f}", m.t - began_,
                                degrees(m.command.heading), m.command.speed, m.output.wanted.x(),
                                m.output.wanted.y(), m.output.wanted.z());
  for (const double i : m.output.currents) row += fmt::format(",{:.5f}", i);
  row += fmt::format(",{:.4f},{},{:.6f},{:.6f}\n", m.output.scale,
                     dry_ ? "dry" : to_string(m.output.status), m.late, m.round_trip);
  write(row);
}

std::string CommandLog::finish(double zero_at, bool confirmed) noexcept {
  if (file_.empty()) return {};
  if (began_ > 0) {
    out_ << fmt::format("{:.4f},,0,0,0,0", zero_at - began_);
    for (std::size_t i = 0; i < coils_; ++i) out_ << ",0";
    out_ << (dry_ ? ",1,dry,,\n" : confirmed ? ",1,zero,,\n" : ",1,zero_not_confirmed,,\n");
  }
  out_.close();
  std::error_code error;
  if (out_) std::filesystem::rename(part_, file_, error);
  if (out_ && !error) return {};
  return fmt::format("{}: write failed; partial log kept as {}", file_.string(), part_.string());
}

void CommandLog::write(const std::string& text) {
  out_ << text;
  if (!out_) throw InputError(part_.string() + ": cannot write");
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/disk_space.hpp"

#include <fmt/format.h>

#include <system_error>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::rig {
namespace {

constexpr double output_text = 90;  // of a row of commands.csv without its currents [B]
constexpr double current_text = 9;
constexpr double value = 8;  // in a record [B]
constexpr double output_values = 3;
constexpr double tick_values = 60;  // of a frame and its sightings
constexpr double copies = 3;        // of the record

}  // namespace

double needed_space(const Rig& rig, double tick, double seconds, double written) {
  const auto coils = static_cast<double>(rig.system.size());
  const double text = rig.params.drive_rate * (output_text + current_text * coils);  // [B/s]
  const double record =
      value * (rig.params.drive_rate * (output_values + coils) + tick_values / tick);  // [B/s]
  return text * (seconds - written) + record * (copies * seconds - written);
}

std::optional<double> free_space(std::filesystem::path path) {
  std::error_code error;
  path = std::filesystem::absolute(path, error);
  while (!std::filesystem::exists(path, error) && path.has_relative_path())
    path = path.parent_path();
  const auto space = std::filesystem::space(path, error);
  if (error) return std::nullopt;
  return static_cast<double>(space.available);
}

void require_space(const std::filesystem::path& folder, double needed, double free) {
  constexpr double mb = 1e6;
  if (free < needed / 2)
    throw InputError(folder.string(),
                     fmt::format("only {:.0f} MB are free on its disk, a run of its longest time "
                                 "writes about {:.0f} MB",
                                 free / mb, needed / mb));
}

}  // namespace microswarm::rig

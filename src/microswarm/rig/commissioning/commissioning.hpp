// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::rig {

/// A property of a rig that is measured when it is commissioned.
enum class Quantity {
  field,    ///< of the coils, by `rig calibrate`
  current,  ///< full scale of the driver, by a clamp meter
  scale,    ///< of the camera, by `rig scale`
  gain,     ///< speed of the swarm, by `rig identify`, as all below
  angle,    ///< of its motion against the commands
  delay,    ///< from a command to its motion
  step_out  ///< largest frequency that it follows
};
constexpr auto enum_names(Quantity) {
  return std::array<std::pair<Quantity, std::string_view>, 7>{{{Quantity::field, "field"},
                                                               {Quantity::current, "current"},
                                                               {Quantity::scale, "scale"},
                                                               {Quantity::gain, "gain"},
                                                               {Quantity::angle, "angle"},
                                                               {Quantity::delay, "delay"},
                                                               {Quantity::step_out, "step_out"}}};
}

/// One measurement.
struct CommissioningEntry {
  Quantity what = Quantity::field;
  std::string value{};
  std::string date{};
  std::string by{};
  std::string version{};
  std::string valid_for{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.what, plain("what", "Quantity that was measured.").needed());
    visit(self.value, plain("value", "Measured value, with its standard error."));
    visit(self.date, plain("date", "Date and time, UTC, ISO 8601.").needed());
    visit(self.by, plain("by", "Person who measured it."));
    visit(self.version, plain("version", "Version of the program."));
    visit(self.valid_for,
          plain("valid_for", "Fingerprint of the keys for which it holds.").needed());
  }
};

/// Contents of a commissioning record, a file beside the rig's; of each quantity the last entry
/// counts.
struct Commissioning {
  std::vector<CommissioningEntry> entries{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.entries, plain("entries", "Measurements, the newest last."));
  }
};

/// Commissioning record of a rig's file: "vortex.commissioning.yaml" of "vortex.yaml".
std::filesystem::path commissioning_file(const std::filesystem::path& rig_file);

/// Reads the record of a rig's file; empty if there is none. Throws InputError if it is damaged.
Commissioning read_commissioning(const std::filesystem::path& rig_file);

/// An entry of now.
CommissioningEntry commissioning_entry(Quantity what, std::string value, std::string by,
                                       std::string valid_for);

/// Appends entries to the record of a rig's file. Throws InputError if it is damaged or cannot be
/// written; it is never half-written.
void add_to_commissioning(const std::filesystem::path& rig_file,
                          const std::vector<CommissioningEntry>& entries);

/// Fingerprint of the keys for which a measurement of the quantity holds.
std::string key_fingerprint(const Rig& rig, Quantity what);
/// That of `field` for a coil system, and of `scale` for a camera's scale.
std::string key_fingerprint(const actuation::CoilSystemParams& coils);
std::string key_fingerprint(const vision::CameraScale& scale);

/// Whether the rig's quantities were measured.
struct CommissioningState {
  std::vector<CommissioningEntry> valid{};
  std::vector<CommissioningEntry> stale{};  ///< the rig's keys have changed since
  std::vector<Quantity> missing{};          ///< never measured
  std::string text{};                       ///< the whole record

  bool complete() const { return stale.empty() && missing.empty(); }
};

/// Compares the record of a rig's file with the rig. Of a rig without any device nothing is missing
/// unless its file requires it.
CommissioningState commissioning_state(const Rig& rig);

/// The state in one line: what was measured, by whom, how many days ago, what is missing and what
/// is stale; empty if there is nothing to say. `now`: seconds since 1970.
std::string to_text(const CommissioningState& state, std::time_t now);

/// An issue if the rig's file requires a complete record and it is not.
Issues missing_commissioning(const Rig& rig, const CommissioningState& state);

}  // namespace microswarm::rig

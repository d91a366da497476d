// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/commissioning/commissioning.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <system_error>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/version.hpp"

namespace microswarm::rig {
namespace {

constexpr const char* header =
    "# Commissioning record: what was measured at this rig, by whom and when. microswarm appends "
    "to "
    "it.\n";

std::string utc(std::time_t t) {
  std::tm parts{};
  gmtime_r(&t, &parts);
  std::array<char, 32> text{};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return {text.data(), size};
}

/// Seconds since 1970 of such a text; nothing for another.
std::optional<std::time_t> from_utc(const std::string& text) {
  std::tm parts{};
  const char* const end = strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  if (!end || *end != 0) return std::nullopt;
  return timegm(&parts);
}

std::string fingerprint(const std::vector<std::string>& values) {
  Hash hash;
  for (const std::string& value : values) hash.text(value);
  return hash.hex();
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

std::string coils_of(const Rig& rig) {
  return key_fingerprint(
      read_yaml_file<actuation::CoilSystemParams>(rig.folder / rig.params.coils));
}

/// Whether the quantity is to be measured at a rig of such devices.
bool applies(const Rig& rig, Quantity what) {
  const bool currents =
      has_coil_device(rig) && coil_input(rig.params) != actuation::CoilInput::field;
  if (what == Quantity::field || what == Quantity::current) return currents;
  if (what == Quantity::scale) return camera_kind(rig.params) != CameraKind::simulated;
  return true;
}

bool is_simulated(const Rig& rig) {
  return !has_coil_device(rig) && camera_kind(rig.params) == CameraKind::simulated;
}

std::string ago(const std::string& date, std::time_t now) {
  const auto then = from_utc(date);
  if (!then) return fmt::format("at '{}'", date);
  const double days = std::difftime(now, *then) / 86400;
  if (days < -0.01) return "in the future";
  if (days < 1) return "today";
  return fmt::format("{:.0f} day{} ago", std::floor(days), days < 2 ? "" : "s");
}

std::string names(const std::vector<CommissioningEntry>& entries) {
  std::vector<std::string_view> all;
  all.reserve(entries.size());
  for (const CommissioningEntry& entry : entries) all.push_back(enum_name(entry.what));
  return fmt::format("{}", fmt::join(all, ", "));
}

/// "gain 0.6 ± 0.01, delay 120 ± 5 ms by ann today"; entries of one person and day together.
std::string measured_text(const std::vector<CommissioningEntry>& entries, std::time_t now) {
  std::vector<std::pair<std::string, std::string>> groups;  // by whom and when, what
  for (const CommissioningEntry& entry : entries) {
    const std::string who =
        fmt::format("by {} {}", entry.by.empty() ? "somebody" : entry.by, ago(entry.date, now));
    const std::string what = fmt::format("{} {}", enum_name(entry.what), entry.value);
    const auto group = std::ranges::find(groups, who, &decltype(groups)::value_type::first);
    if (group == groups.end())
      groups.emplace_back(who, what);
    else
      group->second += ", " + what;
  }
  std::vector<std::string> texts;
  texts.reserve(groups.size());
  for (const auto& [who, what] : groups) texts.push_back(what + " " + who);
  return fmt::format("{}", fmt::join(texts, "; "));
}

/// The rig's file, locked until it is closed: another program that adds to its record waits. The
/// file may have been replaced while it was waited for.
Descriptor locked(const std::filesystem::path& rig_file) {
  for (;;) {
    Descriptor file = open_descriptor(rig_file, O_RDONLY);
    struct stat held {
    }, now{};
    if (!file || ::flock(file.get(), LOCK_EX) != 0 || ::fstat(file.get(), &held) != 0 ||
        ::stat(rig_file.c_str(), &now) != 0 || held.st_ino == now.st_ino)
      return file;
  }
}

}  // namespace

std::filesystem::path commissioning_file(const std::filesystem::path& rig_file) {
  std::filesystem::path file = rig_file;
  return file.replace_extension("commissioning.yaml");
}

Commissioning read_commissioning(const std::filesystem::path& rig_file) {
  const std::filesystem::path file = commissioning_file(rig_file);
  std::error_code none;
  if (rig_file.empty() || !std::filesystem::exists(file, none)) return {};
  return read_yaml_file<Commissioning>(file);
}

CommissioningEntry commissioning_entry(Quantity what, std::string value, std::string by,
                                       std::string valid_for) {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return {what,          std::move(value),     utc(now),
          std::move(by), std::string(version), std::move(valid_for)};
}

void add_to_commissioning(const std::filesystem::path& rig_file,
                          const std::vector<CommissioningEntry>& entries) {
  const Descriptor lock = locked(rig_file);
  Commissioning all = read_commissioning(rig_file);
  all.entries.insert(all.entries.end(), entries.begin(), entries.end());
  write_file_atomically(commissioning_file(rig_file), header + to_yaml(all));
}

std::string key_fingerprint(const actuation::CoilSystemParams& coils) {
  actuation::CoilSystemParams fields;
  fields.coils = coils.coils;
  return fingerprint({to_yaml(fields)});
}

std::string key_fingerprint(const vision::CameraScale& scale) {
  return fingerprint({number(scale.um_per_px), number(scale.rotation), scale.y_up ? "up" : "down"});
}

std::string key_fingerprint(const Rig& rig, Quantity what) {
  const actuation::FieldGeneratorParams& field = rig.params.field;
  const std::string kind(enum_name(field.kind));
  const std::string scale = rig.params.scale ? key_fingerprint(*rig.params.scale) : "";
  switch (what) {
    case Quantity::field:
      return coils_of(rig);
    case Quantity::current:
      return fingerprint({number(driver_full_scale(rig.params))});
    case Quantity::scale:
      return scale;
    case Quantity::gain:
      return fingerprint(
          {coils_of(rig), scale, kind, number(field.amplitude), number(field.frequency),
           number(field.kind == actuation::FieldKind::rolling ? field.length_per_turn
                                                              : field.speed_per_pitch)});
    case Quantity::angle:
      return fingerprint({coils_of(rig), scale, kind, number(field.heading_offset)});
    case Quantity::delay:
      return fingerprint({kind, number(rig.params.delay)});
    case Quantity::step_out:
      return fingerprint({coils_of(rig), kind, number(field.amplitude),
                          number(field.step_out_frequency.value_or(0))});
  }
  return {};
}

CommissioningState commissioning_state(const Rig& rig) {
  CommissioningState state;
  const Commissioning all = read_commissioning(rig.file);
  if (!all.entries.empty()) state.text = to_yaml(all);
  if (all.entries.empty() && is_simulated(rig) && !rig.params.safety.require_commissioning)
    return state;
  for (const auto& [what, name] : enum_names(Quantity{})) {
    if (!applies(rig, what)) continue;
    const auto last = std::find_if(all.entries.rbegin(), all.entries.rend(),
                                   [what = what](const auto& entry) { return entry.what == what; });
    if (last == all.entries.rend())
      state.missing.push_back(what);
    else
      (last->valid_for == key_fingerprint(rig, what) ? state.valid : state.stale).push_back(*last);
  }
  return state;
}

std::string to_text(const CommissioningState& state, std::time_t now) {
  std::vector<std::string> parts;
  if (!state.valid.empty()) parts.push_back(measured_text(state.valid, now));
  if (!state.stale.empty())
    parts.push_back("stale, keys have changed since: " + names(state.stale));
  if (!state.missing.empty()) {
    std::vector<std::string_view> missing;
    for (const Quantity what : state.missing) missing.push_back(enum_name(what));
    parts.push_back(fmt::format("never measured: {}", fmt::join(missing, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

Issues missing_commissioning(const Rig& rig, const CommissioningState& state) {
  Issues issues;
  if (!rig.params.safety.require_commissioning || state.complete()) return issues;
  CommissioningState lacking = state;
  lacking.valid.clear();
  issues.add("safety.require_commissioning",
             "safety.require_commissioning is set, " + to_text(lacking, 0));
  return issues;
}

}  // namespace microswarm::rig

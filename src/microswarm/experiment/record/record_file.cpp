// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/record/record_scene.hpp"
#include "microswarm/io/hdf5_image.hpp"
#include "microswarm/io/hdf5_tables.hpp"

namespace microswarm::experiment {

namespace {

constexpr std::string_view record_format_name = "microswarm record";
constexpr std::int64_t record_format_version = 4;
constexpr std::int64_t unchanged_format_version = 3;  // of a record without changes
void write_root(io::Hdf5Writer& out, const Record& record) {
  out.attribute("/", "format", record_format_name);
  out.attribute("/", "format_version",
                record.changes.empty() ? unchanged_format_version : record_format_version);
  out.attribute("/", "version", record.version);
  out.attribute("/", "name", record.scene.scenario.name);
  out.attribute("/", "status", to_string(record.result.status));
  out.attribute("/", "seed", record.scene.scenario.seed);
  out.attribute("/", "trial", static_cast<std::int64_t>(record.trial));
  if (!record.rig.empty()) out.attribute("/", "rig", record.rig);
  if (!record.navigator.empty()) out.attribute("/", "navigator", record.navigator);
  out.attribute("/", "input_hash", record.scene.hash());
  out.attribute("/", "record_hash", record.hash());
}

void write_times(io::Hdf5Writer& out, const std::string& path, const std::vector<double>& seconds,
                 std::string_view doc) {
  out.dataset(path, seconds);
  out.attribute(path, "unit", "s");
  out.attribute(path, "description", doc);
}

Status to_status(const io::Hdf5Reader& in, const std::string& word) {
  if (const auto status = enum_value<Status>(word)) return *status;
  in.fail("attribute status is the unknown word '" + word + "'");
}

void write_changes(io::Hdf5Writer& out, const std::vector<Change>& changes) {
  if (changes.empty()) return;
  std::vector<double> times;
  std::vector<std::int64_t> frames;
  std::string settings;
  for (const Change& change : changes) {
    times.push_back(change.t);
    frames.push_back(static_cast<std::int64_t>(change.frame));
    settings += change.setting + "\n";
  }
  out.dataset("/changes/t_s", times);
  out.attribute("/changes/t_s", "unit", "s");
  out.attribute("/changes/t_s", "description", "Time of the frame that the change comes before.");
  out.dataset("/changes/frame", frames);
  out.attribute("/changes/frame", "description", "That frame, counted from 0.");
  out.text("/changes/settings", settings);
  out.attribute("/changes/settings", "description", "KEY=VALUE of the scenario, a line a change.");
}

std::vector<Change> read_changes(const io::Hdf5Reader& in) {
  const std::vector<double> times = in.numbers("/changes/t_s");
  const std::vector<std::int64_t> frames = in.integers("/changes/frame");
  std::istringstream settings(in.text("/changes/settings"));
  if (times.size() != frames.size()) in.fail("/changes/frame is not as long as its table");
  std::vector<Change> changes;
  for (std::size_t i = 0; i < times.size(); ++i) {
    Change change{times[i], static_cast<std::uint64_t>(frames[i]), {}};
    if (frames[i] < 0 || (i > 0 && frames[i] < frames[i - 1]))
      in.fail("/changes/frame does not ascend from 0");
    if (!std::getline(settings, change.setting))
      in.fail("/changes/settings is not as long as its table");
    changes.push_back(std::move(change));
  }
  return changes;
}

/// Part of a record that exists only for an external navigator.
struct ExternalPart {
  std::vector<PhasedGoal> phased_goals;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.phased_goals, plain("phased_goals", "Phased goals of the navigator."));
  }
};

void write_phased_goals(io::Hdf5Writer& out, const std::vector<PhasedGoal>& goals) {
  if (goals.empty()) return;
  const ExternalPart part{goals};
  out.attribute("/", "phased_goals", static_cast<std::int64_t>(goals.size()));
  io::write_tables(out, type_of<ExternalPart>(), &part);
}

std::vector<PhasedGoal> read_phased_goals(const io::Hdf5Reader& in) {
  ExternalPart part;
  if (in.has_attribute("/", "phased_goals")) io::read_tables(in, type_of<ExternalPart>(), &part);
  return std::move(part.phased_goals);
}

std::int64_t check_format(const io::Hdf5Reader& in) {
  if (in.text_attribute("/", "format") != record_format_name) in.fail("is no microswarm record");
  const std::int64_t written = in.integer_attribute("/", "format_version");
  if (written != record_format_version && written != unchanged_format_version)
    in.fail("has record format " + std::to_string(written) + ", this program reads formats " +
            std::to_string(unchanged_format_version) + " and " +
            std::to_string(record_format_version));
  return written;
}

}  // namespace

std::string record_bytes(const Record& record) {
  const auto made = io::write_hdf5();
  io::Hdf5Writer& out = *made;
  write_root(out, record);
  write_scene(out, record.scene);
  io::write_tables(out, type_of<Record>(), &record);
  write_changes(out, record.changes);
  write_phased_goals(out, record.phased_goals);
  write_diagnostics(out, record.diagnostics);
  write_rig_log(out, record.rig_log);
  out.group("/metrics");
  io::write_attributes(out, "/metrics", type_of<Metrics>(), &record.result.metrics);
  write_times(out, "/timing/step_s", record.result.timing.steps,
              "Wall-clock time of the navigator's step, one a tick.");
  write_times(out, "/timing/planning_s", record.result.timing.planning,
              "Wall-clock time of the steps in which it planned.");
  return out.finish();
}

void write_record(const Record& record, const std::filesystem::path& file) {
  const std::string bytes = record_bytes(record);
  // Leftovers of a process that was killed while it wrote here.
  clear_staged(file.has_parent_path() ? file.parent_path() : ".");
  write_file_atomically(file, bytes);
}

Record read_record(const std::filesystem::path& file) {
  std::string bytes = read_file(file);
  if (bytes.starts_with("SQLite format 3"))
    throw InputError(file.string(),
                     "the database of a sweep, no record: `microswarm export` writes its trials as "
                     "a table");
  const auto opened = io::read_hdf5(std::move(bytes), file.string());
  const io::Hdf5Reader& in = *opened;
  const std::int64_t format = check_format(in);
  Record record;
  record.version = in.text_attribute("/", "version");
  const std::int64_t trial = in.integer_attribute("/", "trial");
  if (!std::in_range<std::uint32_t>(trial)) in.fail("attribute trial is out of range");
  record.trial = static_cast<std::uint32_t>(trial);
  if (in.has_attribute("/", "rig")) record.rig = in.text_attribute("/", "rig");
  if (in.has_attribute("/", "navigator")) record.navigator = in.text_attribute("/", "navigator");
  std::string gone;
  record.scene = read_scene(in, gone);
  if (record.navigator.empty()) record.navigator = gone;
  io::read_tables(in, type_of<Record>(), &record);
  record.phased_goals = read_phased_goals(in);
  record.diagnostics = read_diagnostics(in);
  record.rig_log = read_rig_log(in);
  if (format == record_format_version) record.changes = read_changes(in);
  record.result.status = to_status(in, in.text_attribute("/", "status"));
  io::read_attributes(in, "/metrics", type_of<Metrics>(), &record.result.metrics);
  record.stated_hash = in.text_attribute("/", "record_hash");
  record.result.timing = {in.numbers("/timing/step_s"), in.numbers("/timing/planning_s")};
  return record;
}

}  // namespace microswarm::experiment

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/queue/queue_state.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <span>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/io/columns.hpp"

namespace microswarm::rig {

namespace {

/// Attempts that count.
std::span<const QueueAttempt> counted_attempts(const ItemStatus& item) {
  const std::span<const QueueAttempt> all(item.attempts);
  return all.subspan(std::min(all.size(), static_cast<std::size_t>(item.forgiven)));
}

}  // namespace

int ItemStatus::interruptions() const {
  return static_cast<int>(
      std::ranges::count(counted_attempts(*this), AttemptEnd::interrupted, &QueueAttempt::end));
}

int ItemStatus::faults() const {
  return static_cast<int>(
      std::ranges::count_if(counted_attempts(*this), [](const QueueAttempt& attempt) {
        return attempt.end == AttemptEnd::fault && !needs_person(attempt.fault);
      }));
}

int QueueState::count(ItemState state) const {
  return static_cast<int>(std::ranges::count(items, state, &ItemStatus::state));
}

std::filesystem::path queue_state_file(const std::filesystem::path& folder) {
  return folder / "queue-state.yaml";
}

std::optional<QueueState> read_queue_state(const std::filesystem::path& folder) {
  std::error_code none;
  const std::filesystem::path file = queue_state_file(folder);
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, none))) return std::nullopt;
  // A link could point to any file, and a message about it would show its content.
  return read_yaml_text<QueueState>(read_file(file, max_yaml_bytes, LinkAtFile::refused),
                                    file.string());
}

void write_queue_state(const std::filesystem::path& folder, const QueueState& state) {
  write_file_atomically(queue_state_file(folder), to_yaml(state));
}

bool is_in_use(const std::filesystem::path& folder) {
  const Descriptor at = open_descriptor(folder, O_RDONLY | O_DIRECTORY);
  return at && ::flock(at.get(), LOCK_SH | LOCK_NB) != 0;
}

QueueState show_queue_state(const std::filesystem::path& folder) {
  std::optional<QueueState> state = read_queue_state(folder);
  if (!state)
    throw InputError(folder.string(),
                     "has no queue: it must be the folder of the records of `rig queue`");
  state->active = state->active && is_in_use(folder);
  return *state;
}

std::string summary_csv(const QueueState& state) {
  std::string csv =
      "number,name,repetition,attempt,state,end,status,fault,reason,began,ended,duration_s,"
      "start_temperature_degc,max_temperature_degc,folder,scenario,hash\n";
  const auto add = [&](const ItemStatus& item, int number, const QueueAttempt& attempt) {
    const auto optional = [](const std::optional<double>& value) {
      return value ? number_text(*value) : std::string();
    };
    const std::string fields[] = {std::to_string(item.number),
                                  item.name,
                                  std::to_string(item.repetition),
                                  number == 0 ? "" : std::to_string(number),
                                  std::string(enum_name(item.state)),
                                  number == 0 ? "" : std::string(enum_name(attempt.end)),
                                  attempt.status,
                                  std::string(enum_name(attempt.fault)),
                                  attempt.reason.empty() ? item.note : attempt.reason,
                                  attempt.began,
                                  attempt.ended,
                                  number_text(attempt.seconds),
                                  optional(attempt.start_temperature),
                                  optional(attempt.max_temperature),
                                  attempt.folder,
                                  item.scenario,
                                  item.hash};
    std::string line;
    for (const std::string& field : fields)
      line += (line.empty() ? "" : ",") + io::csv_text(one_line(field, 400));
    csv += line + "\n";
  };
  for (const ItemStatus& item : state.items) {
    if (item.attempts.empty()) add(item, 0, {});
    for (std::size_t i = 0; i < item.attempts.size(); ++i)
      add(item, static_cast<int>(i) + 1, item.attempts[i]);
  }
  return csv;
}

}  // namespace microswarm::rig

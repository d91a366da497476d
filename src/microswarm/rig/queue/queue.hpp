// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/config/settings.hpp"
#include "microswarm/rig/params/rig_experiment.hpp"
#include "microswarm/rig/queue/queue_params.hpp"

namespace microswarm::rig {

/// One run of a queue: an entry, and which of its repetitions.
struct QueueItem {
  std::string name{};  ///< of the entry
  int repetition = 1;  ///< from 1
  std::filesystem::path scenario{};
  Settings settings{};
  std::string hash{};                 ///< of the scenario with its files and settings
  double time_budget = 0;             ///< [s]
  double tick = 0;                    ///< of the scenario [s]
  std::vector<double> start_below{};  ///< for each coil [°C]; infinite without a limit
  AfterFault on_fault = AfterFault::skip;
  int retries = 1;
  bool anywhere = true;
  bool video = false;
};

/// A queue whose scenarios fit the rig, one item for each run.
struct Queue {
  QueueParams params{};
  std::string name{};  ///< of its file or folder
  std::vector<QueueItem> items{};
};

/// Largest number of items.
inline constexpr std::size_t max_queue_items = 10'000;

/// Reads a queue file, or a folder whose scenarios (.yaml, sorted by name) are the entries. Throws
/// InputError.
QueueParams read_queue(const std::filesystem::path& queue, KeyLocations& keys);

/// Opens every scenario of a queue on the rig, with the rig's settings. Throws InputError with all
/// mistakes, also for a wait for colder coils that cannot end.
Queue open_queue(const std::filesystem::path& queue, const std::filesystem::path& rig,
                 const Settings& rig_settings);

/// Fingerprint of a rig: the values of its file with its settings and of its coils' file, and the
/// bytes of the calibration or grids that the latter names. Comments in the former do not count.
std::string rig_hash(const Rig& rig);

/// Opens an item on its rig.
RigExperiment open_item(const QueueItem& item, const std::filesystem::path& rig,
                        const Settings& rig_settings);

/// End of a queue that first began at `began`, and for this night at `night` [s since 1970];
/// nothing without a limit.
std::optional<double> queue_end(const QueueParams& params, double began, double night);

}  // namespace microswarm::rig

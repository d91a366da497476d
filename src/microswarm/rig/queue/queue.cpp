// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/queue/queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <utility>

#include "microswarm/config/file_kind.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/input_folder.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::rig {
namespace {

namespace fs = std::filesystem;

/// A folder's scenarios as a queue.
QueueParams list_folder(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error); !error && at != fs::directory_iterator();
       at.increment(error)) {
    const std::string kind = lower_extension(at->path());
    if ((kind == ".yaml" || kind == ".yml") && !at->path().filename().string().starts_with('.'))
      files.push_back(at->path().filename().string());
  }
  if (error) throw InputError(folder.string(), "cannot read: " + error.message());
  if (files.empty()) throw InputError(folder.string(), "has no scenario (.yaml)");
  std::ranges::sort(files);
  QueueParams queue;
  for (std::string& file : files) {
    QueueEntry entry;
    entry.scenario = std::move(file);
    queue.entries.push_back(std::move(entry));
  }
  return queue;
}

/// Hours and minutes of "HH:MM"; nothing for another text.
std::optional<std::pair<int, int>> parse_time(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == 0 || colon > 2 || text.size() != colon + 3) return std::nullopt;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (i != colon && !std::isdigit(static_cast<unsigned char>(text[i]))) return std::nullopt;
  const int hour = std::stoi(std::string(text.substr(0, colon)));
  const int minute = std::stoi(std::string(text.substr(colon + 1)));
  if (hour > 23 || minute > 59) return std::nullopt;
  return std::pair(hour, minute);
}

/// Whether a name can be part of a folder's name.
bool is_plain(const std::string& name) {
  return !name.empty() && name.size() <= 60 && !name.starts_with('.') && !name.starts_with('-') &&
         std::ranges::none_of(name, [](char c) {
           return c == '/' || c == ',' || static_cast<unsigned char>(c) < 0x21 || c == 0x7f;
         });
}

std::string to_name(const QueueEntry& entry) {
  if (!entry.name.empty()) return entry.name;
  std::string name = fs::path(entry.scenario).stem().string();
  std::ranges::replace_if(
      name, [](char c) { return !is_plain(std::string("a") + c); }, '_');
  if (name.size() > 60) name.resize(60);
  return name.empty() ? "scenario" : name;
}

Issues validate(const QueueParams& queue) {
  Issues issues;
  if (queue.entries.empty()) issues.add({"entries"}, "entries is empty");
  if (!queue.until.empty() && !parse_time(queue.until))
    issues.add({"until"}, fmt::format("until is {}, must be HH:MM", quote(queue.until)));
  if (queue.full_disk == FullDisk::pause && !queue.hours && queue.until.empty())
    issues.add({"full_disk"}, "full_disk: pause needs `hours` or `until`, which end the pause");
  std::size_t count = 0;
  for (std::size_t i = 0; i < queue.entries.size(); ++i) {
    const QueueEntry& entry = queue.entries[i];
    if (!entry.name.empty() && !is_plain(entry.name))
      issues.add({fmt::format("entries.{}.name", i)},
                 fmt::format("the name {} cannot be part of a folder's: at most 60 characters, no "
                             "blank, comma or slash",
                             quote(entry.name)));
    count += static_cast<std::size_t>(entry.repeat);
  }
  if (count > max_queue_items)
    issues.add({"entries"}, fmt::format("more than {} runs", max_queue_items));
  return issues;
}

/// Rules of an entry, completed by those of the queue.
QueueRules completed(QueueRules own, const QueueRules& all) {
  const auto complete = [](auto& rule, const auto& common) {
    if (!rule) rule = common;
  };
  complete(own.time_budget, all.time_budget);
  complete(own.start_below, all.start_below);
  complete(own.on_fault, all.on_fault);
  complete(own.retries, all.retries);
  complete(own.anywhere, all.anywhere);
  complete(own.video, all.video);
  return own;
}

/// Temperature below which each coil must be. Throws InputError with the key if it never is.
std::vector<double> start_temperatures(const Rig& rig, const std::optional<double>& start_below,
                                       Issues& issues, const std::string& key) {
  constexpr double margin = 0.1;  // [K] above ambient, which is never quite reached
  std::vector<double> below;
  for (std::size_t k = 0; k < rig.system.size(); ++k) {
    const actuation::AmplifierParams& coil = rig.system.amplifiers()[k];
    const double limit = coil.max_temperature.value_or(infinity);
    below.push_back(start_below.value_or(0.5 * (coil.ambient + limit)));
    const std::string of = fmt::format("start_below_degc is {:.6g}, coil {}", below.back(),
                                       rig.system.coil_names()[k]);
    if (below.back() < coil.ambient + margin && issues.empty())
      issues.add({key},
                 fmt::format("{} never gets colder than ambient, {:.6g} °C", of, coil.ambient));
    else if (start_below && below.back() > limit && issues.empty())
      issues.add({key}, fmt::format("{} is limited to {:.6g} °C", of, limit));
  }
  return below;
}

}  // namespace

QueueParams read_queue(const fs::path& queue, KeyLocations& keys) {
  std::error_code none;
  if (fs::is_directory(queue, none)) {
    keys = KeyLocations(queue.string());
    return list_folder(queue);
  }
  const std::string text = read_file(queue, max_yaml_bytes);
  Issues misread;
  auto params = read_yaml_text<QueueParams>(text, queue.string(), {}, keys, misread);
  if (!misread.empty()) refuse_other_kind(text, queue.string(), "queue");
  if (!misread.empty()) throw InputError(misread);
  keys.require_none(validate(params));
  return params;
}

Queue open_queue(const fs::path& path, const fs::path& rig_file, const Settings& rig_settings) {
  KeyLocations keys;
  Queue queue{.params = read_queue(path, keys), .name = path.string(), .items = {}};
  std::error_code none;
  const fs::path folder = fs::is_directory(path, none) ? path : input_folder(path);
  for (std::size_t i = 0; i < queue.params.entries.size(); ++i) {
    const QueueEntry& entry = queue.params.entries[i];
    const QueueRules rules = completed(entry.rules, queue.params.rules);
    std::vector<std::string> settings = queue.params.set;
    settings.insert(settings.end(), entry.set.begin(), entry.set.end());
    QueueItem item{.name = to_name(entry),
                   .scenario = (folder / entry.scenario).lexically_normal(),
                   .settings = {settings, fmt::format("{}: entries.{}.set", queue.name, i)},
                   .on_fault = rules.on_fault.value_or(AfterFault::skip),
                   .retries = rules.retries.value_or(1),
                   .anywhere = rules.anywhere.value_or(true),
                   .video = rules.video.value_or(false)};
    const RigExperiment on = open_item(item, rig_file, rig_settings);
    item.hash = on.experiment.scene.hash();
    item.tick = on.scenario().tick;
    item.time_budget =
        rules.time_budget.value_or(on.scenario().time_limit + on.scenario().hold_at_goal);
    Issues hot;
    const std::string key = entry.rules.start_below ? fmt::format("entries.{}.start_below_degc", i)
                                                    : "start_below_degc";
    item.start_below = start_temperatures(on.rig, rules.start_below, hot, key);
    keys.require_none(hot);
    for (item.repetition = 1; item.repetition <= entry.repeat; ++item.repetition)
      queue.items.push_back(item);
  }
  return queue;
}

std::string rig_hash(const Rig& rig) {
  const fs::path file = rig.folder / rig.params.coils;
  const auto coils = read_yaml_file<actuation::CoilSystemParams>(file);
  std::vector<std::string> named;
  if (const auto* const mpem = std::get_if<actuation::MpemCoils>(&coils.coils))
    named = {mpem->file};
  if (const auto* const grids = std::get_if<actuation::VfieldCoils>(&coils.coils))
    named = grids->files;
  Hash hash;
  hash.text(to_yaml(rig.params));
  hash.text(to_yaml(coils));
  for (const std::string& name : named) hash.text(read_file(input_folder(file) / name));
  return hash.hex();
}

RigExperiment open_item(const QueueItem& item, const fs::path& rig, const Settings& rig_settings) {
  RigExperiment on = open_rig_experiment(item.scenario, item.settings, rig, rig_settings);
  if (item.anywhere) on.rig.params.perception.start_anywhere = true;
  return on;
}

std::optional<double> queue_end(const QueueParams& params, double began, double night) {
  std::optional<double> end;
  if (params.hours) end = began + 3600 * *params.hours;
  const auto time = parse_time(params.until);
  if (!time) return end;
  const auto now = static_cast<std::time_t>(night);
  std::tm local{};
  localtime_r(&now, &local);
  const auto at = [&](int days) {
    std::tm then = local;
    then.tm_mday += days;
    then.tm_hour = time->first, then.tm_min = time->second, then.tm_sec = 0;
    then.tm_isdst = -1;
    return static_cast<double>(std::mktime(&then));
  };
  const double until = at(0) > night ? at(0) : at(1);
  return std::min(until, end.value_or(infinity));
}

}  // namespace microswarm::rig

namespace microswarm {

template const Type& type_of<rig::QueueParams>();

}  // namespace microswarm

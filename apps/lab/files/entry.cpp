// SPDX-License-Identifier: Apache-2.0
#include "lab/files/entry.hpp"

#include <fmt/chrono.h>

#include <chrono>
#include <ctime>

#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/io/hdf5_image.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_scenario_bytes = 1 << 20;
constexpr std::uint64_t max_read_bytes = 64 << 20;  ///< larger ones are listed without being read
constexpr std::size_t max_read = 5000;

/// First line of a message, which begins with the file's name without its folder.
std::string first_line(std::string text, const fs::path& file) {
  const std::string folder = file.parent_path().string() + "/";
  if (text.starts_with(folder)) text.erase(0, folder.size());
  return text.substr(0, text.find('\n'));
}

/// Text of the key `inner` of `outer`, or of `outer` itself; empty if there is none.
std::string text_of(const YamlNode& root, std::string_view outer, std::string_view inner = {}) {
  for (std::size_t i = 0; i + 1 < root.items.size(); i += 2) {
    if (root.items[i].text != outer) continue;
    return inner.empty() ? printable(root.items[i + 1].text) : text_of(root.items[i + 1], inner);
  }
  return {};
}

bool has_key(const YamlNode& root, std::string_view key) {
  for (std::size_t i = 0; i + 1 < root.items.size(); i += 2)
    if (root.items[i].text == key) return true;
  return false;
}

std::optional<Entry> scenario_entry(const fs::path& file) {
  Entry entry{.file = file.string(), .name = file.stem().string()};
  std::string text;
  try {
    text = read_file(file, max_scenario_bytes);
  } catch (const InputError&) {
    return std::nullopt;
  }
  try {
    const YamlNode root = parse_yaml(text, entry.file);
    if (!has_key(root, "map")) return std::nullopt;
    if (std::string name = text_of(root, "name"); !name.empty()) entry.name = std::move(name);
    entry.description = text_of(root, "description");
    experiment::read_scenario(file);
  } catch (const InputError& error) {
    if (!text.starts_with("map:") && text.find("\nmap:") == std::string::npos) return std::nullopt;
    entry.trouble = first_line(error.what(), file);
  }
  return entry;
}

std::string local_time(fs::file_time_type written) {
  const auto system = std::chrono::file_clock::to_sys(written);
  const std::time_t seconds =
      std::chrono::duration_cast<std::chrono::seconds>(system.time_since_epoch()).count();
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(seconds));
}

Entry record_entry(const fs::path& file) {
  Entry entry{.file = file.string(), .name = file.stem().string(), .record = true};
  entry.written = local_time(fs::last_write_time(file));
  std::error_code unknown;
  if (fs::file_size(file, unknown) > max_read_bytes) {
    entry.description = "A large record.";
    return entry;
  }
  try {
    const auto in = io::read_hdf5(read_file(file, max_read_bytes), entry.file);
    entry.description = printable(in->text_attribute("/", "name"));
    entry.outcome = printable(in->text_attribute("/", "status"));
    const YamlNode root = parse_yaml(in->text("/scenario"), entry.file);
    entry.navigator = in->has_attribute("/", "navigator")
                          ? printable(in->text_attribute("/", "navigator"))
                          : text_of(root, "navigator", "type");
  } catch (const InputError& error) {
    entry.trouble = first_line(error.what(), file);
  }
  return entry;
}

}  // namespace

std::optional<Entry> read_entry(const fs::path& file) {
  if (file.extension() == ".h5") return record_entry(file);
  if (file.extension() == ".yaml" || file.extension() == ".yml") return scenario_entry(file);
  return std::nullopt;
}

const std::optional<Entry>& Entries::of(const fs::path& file) {
  const auto written = fs::last_write_time(file);
  const auto found = read_.find(file);
  if (found != read_.end() && found->second.written == written) return found->second.entry;
  if (read_.size() >= max_read) read_.clear();
  return (read_[file] = {written, read_entry(file)}).entry;
}

}  // namespace microswarm::lab

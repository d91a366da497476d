// SPDX-License-Identifier: Apache-2.0
#include "lab/library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_entries = 2000;
constexpr int max_visited = 50'000;  ///< files and folders
constexpr int deepest_folder = 6;

/// Value of a key at the beginning of a line of a scenario; folded lines are joined.
std::string top_value(std::istream& file, std::string_view key) {
  file.clear();
  file.seekg(0);
  std::string value;
  bool is_in = false;
  for (std::string line; std::getline(file, line);) {
    if (is_in && (line.empty() || line[0] != ' ')) break;
    if (is_in) {
      value += (value.empty() ? "" : " ") +
               line.substr(std::min(line.find_first_not_of(' '), line.size()));
    } else if (line.starts_with(key) && line.size() > key.size() && line[key.size()] == ':') {
      value = line.substr(std::min(line.find_first_not_of(' ', key.size() + 1), line.size()));
      if (value.starts_with('>') || value.starts_with('|')) value.clear();
      is_in = true;
    }
  }
  const bool is_quoted =
      value.size() > 1 && (value[0] == '"' || value[0] == '\'') && value.back() == value[0];
  return printable(is_quoted ? value.substr(1, value.size() - 2) : value);
}

bool is_within(const fs::path& file, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && rest != file.end();
}

}  // namespace

std::vector<std::string*> files_of(Scenario& scenario) {
  std::vector<std::string*> files;
  std::visit(
      [&](auto& map) {
        if constexpr (requires { map.file; }) files.push_back(&map.file);
      },
      scenario.map);
  for (Obstacle& obstacle : scenario.obstacles)
    if (auto* track = std::get_if<Track>(&obstacle.motion)) files.push_back(&track->file);
  if (FollowerParams* follower = follower_of(scenario.navigator)) files.push_back(&follower->model);
  return files;
}

Library::Library(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    std::error_code error;
    fs::path real = fs::canonical(folder, error);
    if (error) throw InputError(fmt::format("{}: {}", folder.string(), error.message()));
    folders_.push_back(std::move(real));
  }
}

std::vector<Entry> Library::entries() const {
  std::vector<Entry> list;
  int visited = 0;
  for (const fs::path& folder : folders_) {
    std::error_code error;
    const auto options = fs::directory_options::skip_permission_denied;
    fs::recursive_directory_iterator it(folder, options, error);
    for (; !error && it != fs::end(it); it.increment(error)) {
      if (list.size() >= max_entries || ++visited > max_visited) break;
      if (it.depth() >= deepest_folder) it.disable_recursion_pending();
      const fs::path& file = it->path();
      std::error_code gone;
      if (!it->is_regular_file(gone)) continue;
      if (file.extension() == ".h5") {
        list.push_back({file.string(), file.stem().string(), "Record."});
      } else if (file.extension() == ".yaml") {
        std::ifstream text(file);
        if (top_value(text, "map").empty()) continue;
        list.push_back({file.string(), top_value(text, "name"), top_value(text, "description")});
      }
    }
  }
  std::ranges::sort(list, {}, &Entry::file);
  const auto is_same = [](const Entry& a, const Entry& b) { return a.file == b.file; };
  list.erase(std::unique(list.begin(), list.end(), is_same), list.end());
  return list;
}

fs::path Library::find(std::string_view file) const {
  std::error_code error;
  const fs::path real = fs::canonical(fs::path(file), error);
  for (const fs::path& folder : folders_)
    if (!error && is_within(real, folder) && fs::is_regular_file(real, error)) return real;
  throw InputError(fmt::format("{}: no such file in the folders of this lab", one_line(file)));
}

void Library::check(const fs::path& scenario, const std::vector<std::string>& settings,
                    const std::vector<std::string>& trusted) const {
  if (settings == trusted || scenario.extension() == ".h5") return;
  Scenario asked = read_scenario(scenario, settings);
  Scenario opened = read_scenario(scenario, trusted);
  const auto known = files_of(opened);
  for (const std::string* file : files_of(asked)) {
    const bool is_known =
        std::ranges::any_of(known, [&](const std::string* one) { return *one == *file; });
    if (!file->empty() && !is_known) find((scenario.parent_path() / *file).string());
  }
}

}  // namespace microswarm::lab

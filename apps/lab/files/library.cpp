// SPDX-License-Identifier: Apache-2.0
#include "lab/files/library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/formats/map_file.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_entries = 2000;
constexpr int max_visited = 50'000;  ///< number of files and folders
constexpr int deepest_folder = 6;

bool is_within(const fs::path& file, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && rest != file.end();
}

}  // namespace

std::vector<std::string*> referenced_files(experiment::Scenario& scenario) {
  std::vector<std::string*> files;
  if (std::string* file = formats::file_name(scenario.map)) files.push_back(file);
  for (Obstacle& obstacle : scenario.obstacles)
    if (Track* track = find_track(obstacle.motion)) files.push_back(&track->file);
  if (navigation::FollowerParams* follower = navigation::find_follower(scenario.navigator))
    files.push_back(&follower->model);
  return files;
}

Library::Library(const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    std::error_code error;
    fs::path real = fs::canonical(folder, error);
    if (error) throw InputError(folder.string(), error.message());
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
      try {
        if (const auto& entry = entries_.of(file)) list.push_back(*entry);
      } catch (const fs::filesystem_error&) {
        // It went meanwhile.
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
  throw InputError(one_line(file), "no such file in the folders of this lab");
}

void Library::check(const fs::path& scenario, const Settings& settings,
                    const Settings& trusted) const {
  if (settings.list == trusted.list || scenario.extension() == ".h5") return;
  experiment::Scenario asked = experiment::read_scenario(scenario, settings);
  experiment::Scenario opened = experiment::read_scenario(scenario, trusted);
  const auto known = referenced_files(opened);
  for (const std::string* file : referenced_files(asked)) {
    const bool is_known =
        std::ranges::any_of(known, [&](const std::string* one) { return *one == *file; });
    if (!file->empty() && !is_known) find((scenario.parent_path() / *file).string());
  }
}

void Library::check_all(const fs::path& scenario) const {
  experiment::Scenario asked = experiment::read_scenario(scenario);
  for (const std::string* file : referenced_files(asked))
    if (!file->empty()) find((scenario.parent_path() / *file).string());
}

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#include "lab/files/download.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>  // mkdtemp
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <utility>

#include "lab/files/library.hpp"
#include "microswarm/sweep/export.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view folder_prefix = "microswarm-";

/// The folder, open and locked; nothing if it is not one of this user or somebody has it locked.
Descriptor locked(const fs::path& folder) {
  Descriptor open = open_descriptor(folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW);
  struct stat about {};
  const bool is_locked = open && ::fstat(open.get(), &about) == 0 && about.st_uid == ::geteuid() &&
                         ::flock(open.get(), LOCK_EX | LOCK_NB) == 0;
  return is_locked ? std::move(open) : Descriptor();
}

Download recorded(const experiment::Session& session) {
  Download made{.file = std::make_unique<TemporaryFile>("record.h5")};
  session.record_to(made.file->path());
  return made;
}

Download scenario(const experiment::Session& session, const fs::path& folder) {
  experiment::Scenario initial = session.record().scene.scenario;
  for (std::string* file : referenced_files(initial))
    if (!file->empty() && !folder.empty()) *file = (folder / *file).lexically_normal().string();
  return {.bytes = experiment::scenario_text(initial)};
}

Download table(const experiment::Session& session, const std::string& name) {
  return {.bytes = sweep::record_csv(session.record(), name)};
}

}  // namespace

TemporaryFile::TemporaryFile(std::string_view name) {
  const std::string pattern = std::string(folder_prefix) + "XXXXXX";
  std::string folder = (fs::temp_directory_path() / pattern).string();
  if (!::mkdtemp(folder.data())) throw InputError(folder, "cannot make the folder");
  path_ = fs::path(folder) / name;
  lock_ = locked(folder);
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  fs::remove_all(path_.parent_path(), ignored);
}

void remove_left_folders() {
  constexpr std::chrono::minutes young(1);  // a new folder may not be locked yet
  const std::size_t length = folder_prefix.size() + 6;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(fs::temp_directory_path(error), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(folder_prefix) || name.size() != length) continue;
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(error);
    if (error || age < young) continue;
    if (const Descriptor lock = locked(entry.path())) fs::remove_all(entry.path(), error);
  }
}

void throw_renamed(const InputError& error, const fs::path& file, std::string_view name) {
  const std::string written = file.string();
  const auto rename = [&](std::string& text) {
    for (std::size_t at = 0; (at = text.find(written, at)) != std::string::npos; at += name.size())
      text.replace(at, written.size(), name);
  };
  Issues renamed;
  for (Issue issue : error.issues()) {
    rename(issue.location);
    rename(issue.text);
    renamed.add(std::move(issue));
  }
  throw InputError(std::move(renamed));
}

std::function<Download(const experiment::Session&)> download(std::string_view name,
                                                             const fs::path& folder) {
  if (name == "record.h5") return recorded;
  if (name == "scenario.yaml")
    return [folder](const experiment::Session& session) { return scenario(session, folder); };
  if (name == "frames.csv")
    return [](const experiment::Session& of) { return table(of, "frames"); };
  if (name == "events.csv")
    return [](const experiment::Session& of) { return table(of, "events"); };
  return {};
}

std::string_view find_media_type(std::string_view name) {
  if (name.ends_with(".h5")) return "application/x-hdf5";
  if (name.ends_with(".mp4")) return "video/mp4";
  if (name.ends_with(".gif")) return "image/gif";
  if (name.ends_with(".svg")) return "image/svg+xml";
  return name.ends_with(".csv") ? "text/csv; charset=utf-8" : "application/yaml";
}

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#include "lab/sessions/record_watch.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <system_error>

#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/experiment/session/growing_record.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

/// Whether a command writes to the folder, so holds its lock.
bool is_written_to(const fs::path& folder) {
  const std::string name = folder.empty() ? "." : folder.string();
  const Descriptor open = open_descriptor(name, O_RDONLY | O_DIRECTORY);
  return open && ::flock(open.get(), LOCK_SH | LOCK_NB) != 0;
}

}  // namespace

fs::path present_record(const fs::path& record) {
  const fs::path part = experiment::part_file(record);
  return record.extension() == ".h5" && !is_there(record) && is_there(part) ? part : record;
}

RecordWatch::RecordWatch(fs::path file)
    : part_(std::move(file)), whole_(experiment::whole_file(part_)) {}

fs::path RecordWatch::file() const {
  return whole_.empty() || is_there(part_) || !is_there(whole_) ? part_ : whole_;
}

bool RecordWatch::is_growing() const {
  return !whole_.empty() && is_there(part_) && is_written_to(part_.parent_path());
}

bool RecordWatch::has_changed() {
  Version now{.file = file()};
  struct stat found {};
  if (::stat(now.file.c_str(), &found) != 0) return false;
  now.number = found.st_ino;
  now.time = found.st_mtim;
  now.size = found.st_size;
  const bool is_same = now.file == last_.file && now.number == last_.number &&
                       now.time.tv_sec == last_.time.tv_sec &&
                       now.time.tv_nsec == last_.time.tv_nsec && now.size == last_.size;
  last_ = now;
  return !is_same;
}

}  // namespace microswarm::lab

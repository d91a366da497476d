// SPDX-License-Identifier: Apache-2.0
// A record with bytes changed, cut or added: it is a record that has a hash,
// or refused in lines that name it. The input is a list of changes, as most bytes of an HDF5
// file that are no HDF5 file say nothing about the reader.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/scenario/scene.hpp"
#include "microswarm/experiment/session/session.hpp"

namespace microswarm::experiment {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

/// A file in memory that has a name.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("record", MFD_CLOEXEC)) {}
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  void fill(const std::string& bytes) const {
    const auto size = static_cast<ssize_t>(bytes.size());
    require(::ftruncate(descriptor_, 0) == 0 &&
            ::pwrite(descriptor_, bytes.data(), bytes.size(), 0) == size);
  }

 private:
  int descriptor_;
};

/// A run of a second, with something in every table.
Record sample() {
  Scenario scenario;
  scenario.name = "sample";
  scenario.map = formats::PolygonsMap{
      .lo = {0, 0}, .hi = {2000, 1000}, .walls = {{{950, 0}, {1050, 0}, {1050, 450}}}, .discs = {}};
  scenario.start = Pose2{{200, 500}, 0};
  scenario.goal = Vec2{1800, 500};
  scenario.obstacles = {{DiscShape{60}, HarmonicLine{.centre = {600, 500}, .amplitude = {0, 250}}}};
  scenario.time_limit = 1;
  Session session(open_experiment(scenario, {}));
  session.finish();
  Record record = session.record();
  record.rig = "bench";
  record.rig_log.began = "2026-01-01T00:00:00";
  record.rig_log.coils = {"x", "y"};
  record.rig_log.driven_at = {0.1, 0.2};
  record.rig_log.currents = {0.5, 0.25, 0, 1};
  record.diagnostics.add(0.1, HierarchicalDiagnostics{});
  record.diagnostics.add(0.2, PredictiveDiagnostics{});
  record.changes = {{0.1, 1, "time_limit_s=2"}};
  return record;
}

/// Changes one place for each line of the input: where (3 bytes), how many bytes, these.
std::string changed(std::string bytes, const std::uint8_t* data, std::size_t size) {
  if (size == 0) return bytes;
  if (*data % 16 == 1) bytes.resize(bytes.size() - 64 * (*data / 16U));
  for (std::size_t i = 1; i + 4 < size;) {
    const std::size_t at = (data[i] | data[i + 1] << 8U | data[i + 2] << 16U) % bytes.size();
    std::size_t count = data[i + 3] % 16 + 1;
    for (i += 4; count > 0 && i < size; --count, ++i)
      if (at + count <= bytes.size()) bytes[at + count - 1] = static_cast<char>(data[i]);
  }
  return bytes;
}

}  // namespace
}  // namespace microswarm::experiment

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  using namespace microswarm::experiment;
  static const MemoryFile file;
  static const std::string whole = [] {
    const std::string file_name = "fuzz_record_" + std::to_string(::getpid()) + ".h5";
    const std::string name = (std::filesystem::temp_directory_path() / file_name).string();
    write_record(sample(), name);
    std::string bytes = read_file(name);
    ::unlink(name.c_str());
    return bytes;
  }();
  file.fill(changed(whole, data, size));
  try {
    const Record record = read_record(file.name());
    require(!record.hash().empty());
  } catch (const InputError& error) {
    std::istringstream lines(error.what());
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) ++count;
    require(count >= 1 && count <= std::max<std::size_t>(1, error.issues().size()));
  }
  return 0;
}

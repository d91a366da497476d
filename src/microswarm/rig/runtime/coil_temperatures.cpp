// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/coil_temperatures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/text/file.hpp"

namespace microswarm::rig {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds between_entries{500};
/// Maximum driving time after the last entry of a killed program, watchdog time included [s].
constexpr double unwritten = 2;

/// Contents of the file.
struct KeptTemperatures {
  std::string coils;
  double clock = 0;
  bool driven = false;
  std::vector<double> temperatures;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.coils, plain("coils", "File of the coil system.").needed());
    visit(self.clock, s("clock", 0, 1e12, "Wall clock, from 1970.").needed());
    visit(self.driven, plain("driven", "A program drove the coils.").needed());
    visit(self.temperatures,
          degc("temperatures", -273, 1e4, "Temperatures of the coils.").needed());
  }
};

double wall_clock() {
  using Clock = std::chrono::system_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

fs::path state_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state == '/')
    return fs::path(state) / "microswarm";
  if (const char* home = std::getenv("HOME"); home && *home)
    return fs::path(home) / ".local/state/microswarm";
  throw InputError("there is no folder for the coils' temperatures: set HOME or XDG_STATE_HOME");
}

/// Name of the file for a coil system: its name and a hash of its path (FNV-1a).
std::string name_for(const fs::path& coils) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (const char c : coils.string()) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return fmt::format("{}-{:016x}.yaml", coils.stem().string(), sum);
}

/// Reads the file. A link could point to any file, so no message repeats its content.
KeptTemperatures read_kept(const fs::path& file, std::size_t coils) {
  const std::string text = read_file(file, max_yaml_bytes, LinkAtFile::refused);
  KeptTemperatures kept;
  try {
    kept = read_yaml_text<KeptTemperatures>(text, file.string());
  } catch (const InputError&) {
    throw InputError(file.string(), "does not hold the temperatures of coils: remove it, or give " +
                                        input_name("coils_cold"));
  }
  if (kept.temperatures.size() != coils)
    throw InputError(file.string(),
                     fmt::format("{} temperatures, the system has {} coils: correct it, or "
                                 "give {}",
                                 kept.temperatures.size(), coils, input_name("coils_cold")));
  return kept;
}

bool is_there(const fs::path& file) { return fs::exists(fs::symlink_status(file)); }

}  // namespace

CoilTemperatures::CoilTemperatures(const Rig& rig, bool cold)
    : coils_(fs::weakly_canonical(rig.folder / rig.params.coils).string()),
      file_(state_folder() / name_for(coils_)) {
  make_folder(file_.parent_path().string());
  const auto& amplifiers = rig.system.amplifiers();
  const auto coils = static_cast<Eigen::Index>(amplifiers.size());
  at_start_.resize(coils);
  for (Eigen::Index i = 0; i < coils; ++i)
    at_start_[i] = amplifiers[static_cast<std::size_t>(i)].ambient;
  if (!cold && !is_there(file_)) {
    known_ = false;
    at_start_ = actuation::hottest(amplifiers);
  } else if (!cold) {
    const KeptTemperatures kept = read_kept(file_, amplifiers.size());
    Eigen::VectorXd then = Eigen::Map<const Eigen::VectorXd>(kept.temperatures.data(), coils)
                               .cwiseMax(at_start_);  // no coil is below ambient temperature
    if (kept.driven) then = actuation::heated(amplifiers, then, unwritten);
    at_start_ = actuation::cooled(amplifiers, then,
                                  wall_clock() - kept.clock - (kept.driven ? unwritten : 0));
  }
  newest_ = at_start_;
  write(newest_, true);
  thread_ = std::thread([this] { run(); });
}

CoilTemperatures::~CoilTemperatures() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  thread_.join();
  try {
    write(newest_, false);
  } catch (const std::exception&) {  // then the last entry remains
    return;
  }
}

std::string CoilTemperatures::why_hot() const {
  return "no temperatures of these coils are known (" + file_.string() +
         "): they are taken at their limit; if they are cold, give " + input_name("coils_cold");
}

void CoilTemperatures::take(const Eigen::VectorXd& temperatures) {
  const std::lock_guard lock(mutex_);
  if (!why_.empty()) throw InputError(why_);
  newest_ = temperatures;
}

void CoilTemperatures::run() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, between_entries, [this] { return over_; })) {
    const Eigen::VectorXd now = newest_;
    lock.unlock();
    std::string why;
    try {
      write(now, true);
    } catch (const std::exception& e) {
      why = e.what();
    }
    lock.lock();
    why_ = why;
  }
}

void CoilTemperatures::write(const Eigen::VectorXd& temperatures, bool driven) const {
  const KeptTemperatures kept{
      coils_, wall_clock(), driven, {temperatures.begin(), temperatures.end()}};
  write_file_atomically(file_, to_yaml(kept), LinkAtFile::refused);
}

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/coil_temperatures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <span>

#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/execution/priority.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::rig {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds between_entries{500};
/// Maximum driving time after the last entry of a killed program, watchdog time included [s].
constexpr double unwritten = 2;
constexpr double cold_margin = 2;      // [K] above ambient at which coils count as cold
constexpr double driven_margin = 0.2;  // [K] above their cooling from which coils were driven

/// Contents of the file.
struct KeptTemperatures {
  std::string coils;
  ClockReading clock;
  bool driven = false;
  bool assumed = false;
  std::vector<double> temperatures;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.coils, plain("coils", "Identity of the coils.").needed());
    visit(self.clock.wall, s("clock", 0, 1e12, "Wall clock, from 1970.").needed());
    visit(self.clock.uptime, s("uptime", 0, 1e12, "Time since the computer started."));
    visit(self.clock.boot, plain("boot", "Id of that start of the computer."));
    visit(self.clock.synchronised, plain("synchronised", "The wall clock followed another one."));
    visit(self.driven, plain("driven", "A program drove the coils.").needed());
    visit(self.assumed, plain("assumed", "Nothing was known, and no current flowed since."));
    visit(self.temperatures,
          degc("temperatures", -273, 1e4, "Temperatures of the coils.").needed());
  }
};

fs::path state_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state == '/')
    return fs::path(state) / "microswarm";
  if (const char* home = std::getenv("HOME"); home && *home)
    return fs::path(home) / ".local/state/microswarm";
  throw InputError("there is no folder for the coils' temperatures: set HOME or XDG_STATE_HOME");
}

/// Name of the file for coils: a name and a hash of their identity.
std::string name_for(const std::string& coils) {
  Hash hash;
  hash.bytes(std::as_bytes(std::span(coils)));
  constexpr std::size_t longest = 100;
  const std::string stem = fs::path(coils).stem().string();
  const bool is_name = stem.size() <= longest && one_line(stem) == stem;
  return fmt::format("{}-{}.yaml", is_name ? stem : "coils", hash.hex());
}

/// Text of the file.
std::string text_of(const fs::path& file) {
  return read_file(file, max_yaml_bytes, LinkAtFile::refused);
}

/// Reads the text of the file. A link could point to any file, so no message repeats its content.
KeptTemperatures read_kept(const std::string& text, const fs::path& file) {
  KeptTemperatures kept;
  try {
    kept = read_yaml_text<KeptTemperatures>(text, file.string());
  } catch (const InputError&) {
    throw InputError(file.string(), "does not hold the temperatures of coils: remove it, or give " +
                                        input_name("coils_cold"));
  }
  return kept;
}

/// Content of the file, by now.
struct Known {
  Eigen::VectorXd temperatures;  ///< [°C]
  bool assumed = false;
  double pause = 0;  ///< since it was written [s]
};

/// The kept temperatures, now. Throws InputError if they are of another number of coils.
Known known_by(const KeptTemperatures& kept, const fs::path& file,
               const std::vector<actuation::AmplifierParams>& amplifiers, const ClockReading& now) {
  if (kept.temperatures.size() != amplifiers.size())
    throw InputError(file.string(),
                     fmt::format("{} temperatures, the system has {} coils: give the coils another "
                                 "id, or remove the file if they are cold",
                                 kept.temperatures.size(), amplifiers.size()));
  const auto coils = static_cast<Eigen::Index>(amplifiers.size());
  Eigen::VectorXd then = Eigen::Map<const Eigen::VectorXd>(kept.temperatures.data(), coils)
                             .cwiseMax(actuation::ambient(amplifiers));
  if (kept.driven) then = actuation::heated(amplifiers, then, unwritten);
  const double pause = certain_pause(kept.clock, now);
  return {actuation::cooled(amplifiers, then, pause - (kept.driven ? unwritten : 0)),
          kept.assumed && !kept.driven, pause};
}

bool is_there(const fs::path& file) { return fs::exists(fs::symlink_status(file)); }

}  // namespace

std::string coil_identity(const Rig& rig) {
  if (!rig.system.id().empty()) return rig.system.id();
  return fs::weakly_canonical(rig.folder / rig.params.coils).string();
}

Eigen::VectorXd kept_temperatures(const Rig& rig, const ClockReading& now) {
  const fs::path file = state_folder() / name_for(coil_identity(rig));
  if (!is_there(file)) return actuation::hottest(rig.system.amplifiers());
  return known_by(read_kept(text_of(file), file), file, rig.system.amplifiers(), now).temperatures;
}

CoilTemperatures::CoilTemperatures(const Rig& rig, bool cold, const ClockReading& now)
    : amplifiers_(rig.system.amplifiers()),
      coils_(coil_identity(rig)),
      file_(state_folder() / name_for(coils_)),
      began_(now.uptime),
      at_start_(actuation::ambient(amplifiers_)) {
  make_folder(file_.parent_path().string());
  if (cold) {
    require_nothing_warmer(now);
  } else if (is_there(file_)) {
    const Known known = known_by(read_kept(text_of(file_), file_), file_, amplifiers_, now);
    at_start_ = known.temperatures;
    assumed_ = known.assumed;
    known_ = !known.assumed;
  } else {
    known_ = false;
    assumed_ = true;
    at_start_ = actuation::hottest(amplifiers_);
  }
  newest_ = at_start_;
  write(newest_, true);
  thread_ = std::thread([this] { run(); });
}

/// Throws InputError if the file knows a coil that is not cold.
void CoilTemperatures::require_nothing_warmer(const ClockReading& now) const {
  if (!is_there(file_) || fs::is_symlink(file_)) return;  // a link is no file of ours
  const std::string text = text_of(file_);
  std::optional<KeptTemperatures> kept;
  try {
    kept = read_kept(text, file_);
  } catch (const InputError&) {  // a damaged file knows nothing
    return;
  }
  const Known known = known_by(*kept, file_, amplifiers_, now);
  if (known.assumed) return;
  Eigen::Index warmest = 0;
  const double warmer = (known.temperatures - actuation::ambient(amplifiers_)).maxCoeff(&warmest);
  if (warmer <= cold_margin) return;
  throw InputError(fmt::format(
      "{}: a coil is at {:.3g} °C by {}, written {:.3g} s ago: leave it out, or remove that file "
      "if you have measured that the coils are cold",
      input_name("coils_cold"), known.temperatures[warmest], file_.string(), known.pause));
}

CoilTemperatures::~CoilTemperatures() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  thread_.join();
  try {
    write(newest_, !at_zero_);
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
  at_zero_ = false;
  const double since = read_clocks().uptime - began_;
  const Eigen::VectorXd undriven = actuation::cooled(amplifiers_, at_start_, since);
  if (assumed_ && (temperatures - undriven).maxCoeff() > driven_margin) assumed_ = false;
}

void CoilTemperatures::take(const actuation::StopReport& stop) {
  const std::lock_guard lock(mutex_);
  at_zero_ = stop.confirmed;
}

void CoilTemperatures::run() {
  lower_priority();
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
      coils_, read_clocks(), driven, assumed_, {temperatures.begin(), temperatures.end()}};
  write_file_atomically(file_, to_yaml(kept), LinkAtFile::refused);
}

}  // namespace microswarm::rig

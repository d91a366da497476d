// SPDX-License-Identifier: Apache-2.0
// `rig flash` builds the firmware of the coil driver and writes it to a board.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/execution/descriptor.hpp"
#include "microswarm/core/execution/spawning.hpp"
#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/text/lines.hpp"
#include "rig/rig.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

namespace fs = std::filesystem;

struct FlashOptions {
  std::string port = "/dev/ttyACM0";
  std::vector<std::string> settings;
  bool build_only = false;
  std::string out;
  double timeout = 60;  // [s]
};

/// Setting of the firmware's Makefile: whole numbers, with commas, or a word if there are none.
struct BuildSetting {
  std::string_view key;
  std::size_t numbers = 1;
  int least = 0, most = 0;
  std::string_view word{};
};

constexpr std::array<BuildSetting, 6> build_settings{
    {{.key = "LIMITS", .numbers = 6, .most = 1000},
     {.key = "SLEW", .least = 4, .most = 255},
     {.key = "EMERGENCY_STOP", .numbers = 0, .word = "none"},
     {.key = "PROBES", .numbers = 6, .most = 1},
     {.key = "PROBE_OHMS", .least = 500, .most = 6000},
     {.key = "MAX_DEGC", .most = 240}}};

/// Source of the firmware, beside the shipped scenarios. Throws InputError if it is not there.
fs::path firmware_folder() {
  const fs::path folder = (scenario_folder() / "../firmware/coil_driver").lexically_normal();
  if (!fs::exists(folder / "Makefile"))
    throw InputError(folder.string(), "the firmware's source is not there: install it again");
  return folder;
}

/// Throws InputError unless all of these programs are in the PATH.
void require_programs(const std::vector<std::string>& programs) {
  const char* const path = std::getenv("PATH");
  std::string missing;
  for (const std::string& program : programs) {
    const auto folders = split(path ? path : "", ':');
    const bool is_there = std::ranges::any_of(folders, [&](std::string_view folder) {
      return ::access((fs::path(folder) / program).c_str(), X_OK) == 0;
    });
    if (!is_there) missing += (missing.empty() ? "" : ", ") + program;
  }
  if (!missing.empty())
    throw InputError("not installed: " + missing +
                     "; in Debian: apt install gcc-avr avr-libc make avrdude");
}

/// Whether it is plain decimal digits: a leading 0 would be octal to the compiler.
bool is_number(std::string_view text, int least, int most) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() &&
         text == std::to_string(number) && number >= least && number <= most;
}

bool fits(std::string_view value, const BuildSetting& setting) {
  if (setting.numbers == 0) return value == setting.word;
  if (value.find_first_of(" \t\n\v\f\r") != value.npos) return false;
  const auto numbers = split(value, ',');
  return numbers.size() == setting.numbers && std::ranges::all_of(numbers, [&](const auto& one) {
           return is_number(one, setting.least, setting.most);
         });
}

std::string values_text(const BuildSetting& setting) {
  if (setting.numbers == 0) return std::string(setting.word);
  return setting.numbers == 1
             ? fmt::format("a whole number of {} to {}", setting.least, setting.most)
             : fmt::format("{} whole numbers of {} to {}, with commas", setting.numbers,
                           setting.least, setting.most);
}

/// Throws InputError for a setting that is unknown, given twice or of another value.
void require_settings(const std::vector<std::string>& given) {
  std::vector<std::string_view> keys;
  for (const std::string& one : given) {
    const std::size_t equals = one.find('=');
    const std::string_view key = std::string_view(one).substr(0, equals);
    const auto* const setting = std::ranges::find(build_settings, key, &BuildSetting::key);
    if (equals == one.npos || setting == build_settings.end()) {
      std::string known;
      for (const BuildSetting& each : build_settings)
        known += fmt::format("{}{}", known.empty() ? "" : ", ", each.key);
      throw InputError(fmt::format("--set {}: must be KEY=VALUE, with a KEY of {}", one, known));
    }
    if (!fits(std::string_view(one).substr(equals + 1), *setting))
      throw InputError(fmt::format("--set {}: must be {}", one, values_text(*setting)));
    if (std::ranges::find(keys, key) != keys.end())
      throw InputError(fmt::format("--set {}: {} is given twice", one, key));
    keys.push_back(key);
  }
}

/// Folder in the temporary one, removed with this object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "microswarm-firmware-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw InputError(name, std::string("cannot make the folder: ") + std::strerror(errno));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Throws HardwareError unless the port is a serial line that no other program has.
void require_port(const std::string& port) {
  const Descriptor file(::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  const int error = errno;
  if (!file && error == EBUSY) throw HardwareError(port + ": another program uses it");
  if (!file) throw HardwareError(fmt::format("{}: cannot open: {}", port, std::strerror(error)));
  if (::isatty(file.get()) == 0) throw HardwareError(port + ": it is not a serial port");
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw HardwareError(port + ": another program uses it");
}

enum class Ended { well, badly, late, stopped };

/// Runs `make` for a goal in a folder. Settings come from the command line alone, none from the
/// environment: there, CFLAGS could turn the emergency stop off.
Ended run_make(const fs::path& folder, std::vector<std::string> arguments, const Stop& stop,
               double timeout) {
  std::vector<std::string> command{"/usr/bin/env", "-i"};
  for (const char* name : {"PATH", "HOME", "TMPDIR", "LANG"})
    if (const char* const value = std::getenv(name))
      command.push_back(fmt::format("{}={}", name, value));
  command.insert(command.end(), {"make", "--silent", "OUT=build"});
  std::ranges::move(arguments, std::back_inserter(command));
  Spawning spawning;
  spawning.files(STDIN_FILENO, STDERR_FILENO, STDERR_FILENO);  // the output is the program's own
  spawning.folder(folder);
  const std::optional<pid_t> process = spawning.start(command);
  if (!process)
    throw InputError(command.front(), std::string("cannot be started: ") + std::strerror(errno));
  constexpr double patience = 2;  // [s] between asking it to end and killing it
  const double began = steady_seconds();
  std::optional<double> asked;
  bool late = false;
  int status = 0;
  while (::waitpid(*process, &status, WNOHANG) == 0) {
    const double now = steady_seconds();
    late = late || now - began > timeout;
    if ((late || stop()) && !asked) {
      asked = now;
      ::kill(-*process, SIGTERM);
    }
    if (asked && now - *asked > patience) ::kill(-*process, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (asked) ::kill(-*process, SIGKILL);  // what outlives make
  if (stop()) return Ended::stopped;
  if (late) return Ended::late;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? Ended::well : Ended::badly;
}

/// Copies a folder's files; throws InputError with the target.
void copy_files(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to, error);
  if (!error)
    fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::overwrite_existing, error);
  if (error) throw InputError(to.string(), "cannot write: " + error.message());
}

int rig_flash(const FlashOptions& o, const Stop& stop) {
  require_settings(o.settings);
  const fs::path source = firmware_folder();
  std::vector<std::string> programs{"make", "avr-gcc"};
  if (!o.build_only) programs.emplace_back("avrdude");
  require_programs(programs);
  if (!o.build_only) require_port(o.port);
  const TemporaryFolder temporary;  // make splits names of folders at blanks
  const fs::path work = temporary.path() / "coil_driver";
  copy_files(source, work);
  std::error_code none;
  fs::remove_all(work / "build", none);  // of a checkout
  const auto make = [&](const std::string& goal, double timeout) {
    std::vector<std::string> arguments = o.settings;
    arguments.insert(arguments.end(), {"PORT=" + o.port, goal});
    return run_make(work, std::move(arguments), stop, timeout);
  };
  const Ended built = make("build/coil_driver.hex", infinity);
  if (built == Ended::stopped) return not_reached;
  if (built != Ended::well) {
    note("microswarm: the firmware was not built\n");
    return bad_input;
  }
  const std::string settings = o.settings.empty()
                                   ? "with the default settings"
                                   : fmt::format("with {}", fmt::join(o.settings, " "));
  if (!o.out.empty()) copy_files(work / "build", o.out);
  if (o.build_only) {
    print("built from {} {}{}\n", source.string(), settings, o.out.empty() ? "" : ": " + o.out);
    return ok;
  }
  const Ended written = make("upload", o.timeout);
  if (written == Ended::stopped) return not_reached;
  if (written != Ended::well) {
    note("microswarm: {}: the firmware was not written{}\n", o.port,
         written == Ended::late ? fmt::format(" within {:.6g} s", o.timeout) : "");
    return hardware;
  }
  print("written to {} from {} {}\n", o.port, source.string(), settings);
  return ok;
}

}  // namespace

void add_rig_flash(Command rig, Action& action) {
  auto o = std::make_shared<FlashOptions>();
  Command cmd = rig.add_command("flash", "Build the Mega's firmware and write it to the board",
                                "rig flash --build-only --set PROBES=1,1,1,0,0,0");
  cmd.add_option("--port", o->port, "Serial port of the board").type_name("PORT");
  cmd.add_option("--set", o->settings,
                 "Setting of the firmware: LIMITS, SLEW, EMERGENCY_STOP, PROBES, PROBE_OHMS or "
                 "MAX_DEGC")
      .type_name("KEY=VALUE");
  cmd.add_flag("--build-only", o->build_only, "Build it without a board");
  cmd.add_option("--out", o->out, "Folder for coil_driver.elf and .hex").type_name("FOLDER");
  cmd.add_option("--timeout", o->timeout, "Longest time for the writing")
      .type_name("SECONDS")
      .check(number(0.1, 3600));
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return rig_flash(*o, context.stop); };
  });
}

}  // namespace microswarm::cli

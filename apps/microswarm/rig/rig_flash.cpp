// SPDX-License-Identifier: Apache-2.0
// `rig flash` builds the firmware of the coil driver and writes it to a board.
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
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/spawning.hpp"
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
  const auto [end, error] = std::from_chars(text.begin(), text.end(), number);
  return error == std::errc() && end == text.end() && text == std::to_string(number) &&
         number >= least && number <= most;
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

/// Runs a command; -1 if it was stopped or ended by a signal, its exit code otherwise.
int exit_code(const std::vector<std::string>& command, const Stop& stop) {
  Spawning spawning;
  spawning.files(STDIN_FILENO, STDERR_FILENO, STDERR_FILENO);  // the output is the program's own
  const std::optional<pid_t> process = spawning.start(command);
  if (!process)
    throw InputError(command.front(), std::string("cannot be started: ") + std::strerror(errno));
  int status = 0;
  for (bool asked = false; ::waitpid(*process, &status, WNOHANG) == 0;) {
    if (stop() && !std::exchange(asked, true)) ::kill(-*process, SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int rig_flash(const FlashOptions& o, const Stop& stop) {
  require_settings(o.settings);
  const fs::path source = firmware_folder();
  std::vector<std::string> programs{"make", "avr-gcc"};
  if (!o.build_only) programs.emplace_back("avrdude");
  require_programs(programs);
  const TemporaryFolder temporary;
  const fs::path out = o.out.empty() ? temporary.path() : fs::absolute(o.out);
  std::vector<std::string> command{
      "make", "--silent", "-C", source.string(), "OUT=" + out.string(), "PORT=" + o.port};
  command.insert(command.end(), o.settings.begin(), o.settings.end());
  command.push_back(o.build_only ? (out / "coil_driver.hex").string() : "upload");
  const int code = exit_code(command, stop);
  if (stop()) return not_reached;
  if (code != 0) {
    note("microswarm: the firmware was not {}\n", o.build_only ? "built" : "written");
    return o.build_only ? bad_input : hardware;
  }
  if (o.build_only)
    print("built from {}{}\n", source.string(), o.out.empty() ? "" : ": " + command.back());
  else
    print("written to {} from {}\n", o.port, source.string());
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
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return rig_flash(*o, context.stop); };
  });
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/version.hpp"

namespace microswarm {
namespace {

namespace fs = std::filesystem;

constexpr const char* modules_variable = "MICROSWARM_MODULES";

/// The function of a module; null, with the reason, if it cannot be loaded.
void* function_of(const fs::path& file, const std::string& name, std::string& why) {
  const std::string symbol = "microswarm_" + name;
  if (void* const module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    const auto* const of = static_cast<const char*>(::dlsym(module, (symbol + "_version").c_str()));
    if (!of || version != of) {
      why = file.string() + ": is of " + (of ? "version " + std::string(of) : "an older version") +
            ", its user of " + std::string(version);
      return nullptr;
    }
    if (void* const function = ::dlsym(module, symbol.c_str())) return function;
  }
  const char* const text = ::dlerror();
  why = text ? text : file.string() + ": has no " + symbol;
  return nullptr;
}

/// Folders seen from the folder of a library or a program.
void add_folders_beside(const fs::path& folder, std::vector<fs::path>& folders) {
  if (!folder.is_absolute()) return;
  folders.push_back(folder);
  folders.push_back(folder / "microswarm");
  for (const char* libraries : {"lib", MICROSWARM_LIBRARIES})
    folders.push_back(folder / ".." / libraries / "microswarm");
}

/// The folders of modules, in the order of search. The empty one stands for the system's own
/// search: LD_LIBRARY_PATH and the run path of the program or library that this is linked into.
std::vector<fs::path> search_folders() {
  std::vector<fs::path> folders;
  // Not of a program with more rights than its caller.
  if (const char* given = ::secure_getenv(modules_variable); given && *given)
    folders.emplace_back(given);
  Dl_info own{};
  if (::dladdr(reinterpret_cast<const void*>(&load_module), &own) && own.dli_fname) {
    const fs::path folder = fs::path(own.dli_fname).parent_path();
    add_folders_beside(folder, folders);
    if (folder.filename() == "microswarm")  // lib/python3/dist-packages/microswarm
      folders.push_back(folder / "../../../microswarm");
  }
  std::error_code error;
  add_folders_beside(fs::read_symlink("/proc/self/exe", error).parent_path(), folders);
  folders.emplace_back();
  for (const char* folder : {MICROSWARM_MODULES, "/usr/lib/microswarm"})
    folders.emplace_back(folder);
  return folders;
}

}  // namespace

void* load_module(const std::string& name, const std::string& users) {
  const std::string file_name = "libmicroswarm_" + name + ".so";
  std::string why;
  std::error_code error;
  for (const fs::path& folder : search_folders()) {
    const fs::path file = folder / file_name;
    const bool is_there = !folder.empty() && fs::exists(file, error);
    if (!folder.empty() && !is_there) continue;
    std::string reason;
    if (void* const function = function_of(file, name, reason)) return function;
    if (why.empty() || is_there) why = reason;
  }
  throw InputError(file_name, "cannot be loaded, and " + users + " need it: " + why + "; " +
                                  modules_variable +
                                  " can name its folder, lib/microswarm of the installation");
}

}  // namespace microswarm

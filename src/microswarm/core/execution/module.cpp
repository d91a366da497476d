// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/execution/module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <vector>

#include "microswarm/core/errors/error.hpp"

namespace microswarm {
namespace {

namespace fs = std::filesystem;

/// Candidate paths of the file, in the order of search.
std::vector<fs::path> search_paths(const std::string& file_name) {
  std::vector<fs::path> all;
  const auto beside = [&](const fs::path& folder) {
    if (!folder.is_absolute()) return;
    for (const fs::path& at : {folder, folder / "microswarm"}) all.push_back(at / file_name);
    for (const char* libraries : {"lib", MICROSWARM_LIBRARIES})
      all.push_back(folder / ".." / libraries / "microswarm" / file_name);
  };
  Dl_info own{};
  if (::dladdr(reinterpret_cast<const void*>(&load_module), &own) && own.dli_fname) {
    const fs::path folder = fs::path(own.dli_fname).parent_path();
    beside(folder);
    if (folder.filename() == "microswarm")  // lib/python3/dist-packages/microswarm
      all.push_back(folder / "../../../microswarm" / file_name);
  }
  std::error_code error;
  beside(fs::read_symlink("/proc/self/exe", error).parent_path());
  for (const char* folder : {MICROSWARM_MODULES, "/usr/lib/microswarm"})
    all.push_back(fs::path(folder) / file_name);
  std::erase_if(all, [&](const fs::path& file) { return !fs::exists(file, error); });
  all.emplace_back(file_name);
  return all;
}

}  // namespace

void* load_module(const std::string& name, const std::string& users) {
  const std::string file_name = "libmicroswarm_" + name + ".so";
  std::string why;
  for (const fs::path& file : search_paths(file_name)) {
    if (void* const module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL))
      if (void* const function = ::dlsym(module, ("microswarm_" + name).c_str())) return function;
    if (const char* text = ::dlerror(); text && why.empty()) why = text;
  }
  throw InputError(file_name + ": cannot be loaded, and " + users + " need it: " + why);
}

}  // namespace microswarm

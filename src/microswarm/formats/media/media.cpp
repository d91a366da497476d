// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/media/media.hpp"

#include <dlfcn.h>

#include <string>
#include <vector>

#include "microswarm/core/errors/error.hpp"

namespace microswarm {
namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "libmicroswarm_media.so";

/// Where the module may be, seen from the program or from the library that this is in; last, where
/// the system looks.
std::vector<fs::path> places() {
  std::vector<fs::path> all;
  const auto beside = [&](const fs::path& folder) {
    if (!folder.is_absolute()) return;
    all.push_back(folder / file_name);
    for (const char* libraries : {"lib", MICROSWARM_LIBRARIES})
      all.push_back(folder / ".." / libraries / "microswarm" / file_name);
  };
  std::error_code error;
  beside(fs::read_symlink("/proc/self/exe", error).parent_path());
  Dl_info own{};
  if (::dladdr(reinterpret_cast<const void*>(&media), &own) && own.dli_fname)
    beside(fs::path(own.dli_fname).parent_path());
  all.push_back(fs::path(MICROSWARM_MEDIA_FOLDER) / file_name);
  std::erase_if(all, [&](const fs::path& file) { return !fs::exists(file, error); });
  all.emplace_back(file_name);
  return all;
}

/// Stays loaded until the program ends.
const Media& load() {
  std::string why;
  for (const fs::path& file : places()) {
    void* const module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module) {
      const auto get = reinterpret_cast<const Media* (*)()>(::dlsym(module, "microswarm_media"));
      if (get) return *get();
    }
    if (const char* text = ::dlerror(); text && why.empty()) why = text;
  }
  throw InputError(std::string(file_name) +
                   ": cannot be loaded, and videos, JPEG and BMP need it: " + why);
}

}  // namespace

const Media& media() {
  static const Media& loaded = load();
  return loaded;
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "lab/net/address_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <utility>

#include "microswarm/core/execution/descriptor.hpp"

namespace microswarm::lab {

AddressFile::AddressFile(const std::string& url) {
  constexpr std::string_view extension = ".html";
  const char* const own = std::getenv("XDG_RUNTIME_DIR");
  std::error_code error;
  const std::filesystem::path folder =
      own && *own == '/' ? own : std::filesystem::temp_directory_path(error);
  std::string name = (folder / "microswarm-lab-XXXXXX").string().append(extension);
  const Descriptor file(::mkostemps(name.data(), extension.size(), O_CLOEXEC));  // rights 0600
  if (!file) return;
  path_ = name;
  const std::string page = fmt::format(
      "<!DOCTYPE html>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"refresh\" content=\"0; "
      "url={0}\">\n<title>microswarm</title>\n<a href=\"{0}\">{0}</a>\n",
      url);
  if (::write(file.get(), page.data(), page.size()) != static_cast<ssize_t>(page.size()))
    std::filesystem::remove(std::exchange(path_, {}), error);
}

AddressFile::~AddressFile() {
  std::error_code gone;
  if (!path_.empty()) std::filesystem::remove(path_, gone);
}

}  // namespace microswarm::lab

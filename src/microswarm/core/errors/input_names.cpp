// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/errors/input_names.hpp"

#include <utility>

namespace microswarm {
namespace {

std::function<std::string(std::string_view)>& namer() {
  static auto* const name =  // never destroyed: errors are shown while a program ends
      new std::function<std::string(std::string_view)>;  // NOLINT(cppcoreguidelines-owning-memory)
  return *name;
}

}  // namespace

std::string input_name(std::string_view key) {
  std::string name = namer() ? namer()(key) : std::string();
  return name.empty() ? std::string(key) : name;
}

void name_inputs(std::function<std::string(std::string_view key)> name) {
  namer() = std::move(name);
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/error.hpp"

#include <fmt/format.h>

namespace microswarm {
namespace {

std::string located(const std::string& file, int line, int column, const std::string& what) {
  if (line <= 0) return fmt::format("{}: {}", file, what);
  if (column <= 0) return fmt::format("{}:{}: {}", file, line, what);
  return fmt::format("{}:{}:{}: {}", file, line, column, what);
}

}  // namespace

InputError::InputError(const std::string& file, int line, int column, const std::string& what)
    : InputError(located(file, line, column, what)) {}

}  // namespace microswarm

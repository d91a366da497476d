// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/errors/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

InputError::InputError(std::vector<std::string> lines)
    : InputError([&] {
        constexpr std::size_t most = 20;
        const std::size_t more = lines.size() > most ? lines.size() - most : 0;
        lines.resize(lines.size() - more);
        if (more > 0) lines.push_back(fmt::format("and {} more", more));
        return fmt::format("{}", fmt::join(lines, "\n"));
      }()) {}

}  // namespace microswarm

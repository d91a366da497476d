// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/errors/error.hpp"

#include <cassert>
#include <utility>

namespace microswarm {
namespace {

std::string place_of(const std::string& file, int line, int column) {
  if (line <= 0) return file;
  const std::string place = file + ":" + std::to_string(line);
  return column <= 0 ? place : place + ":" + std::to_string(column);
}

Issues list_of(Issue issue) {
  Issues issues;
  issues.add(std::move(issue));
  return issues;
}

}  // namespace

InputError::InputError(const std::string& what) : InputError(Issue{.text = what}) {}

InputError::InputError(const std::string& file, int line, int column, const std::string& what)
    : InputError(Issue{.text = what, .place = place_of(file, line, column)}) {}

InputError::InputError(Issue issue) : InputError(list_of(std::move(issue))) {}

InputError::InputError(Issues issues)
    : std::runtime_error(to_string(issues)),
      issues_(std::make_shared<const Issues>(std::move(issues))) {
  assert(!issues_->empty());
}

Issues issues_of(const std::exception& error) {
  if (const auto* input = dynamic_cast<const InputError*>(&error)) return input->issues();
  return list_of(Issue{.text = error.what()});
}

}  // namespace microswarm

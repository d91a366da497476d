// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/errors/error.hpp"

#include <cassert>
#include <utility>

namespace microswarm {
namespace {

std::string location_text(const std::string& file, int line, int column) {
  if (line <= 0) return file;
  const std::string location = file + ":" + std::to_string(line);
  return column <= 0 ? location : location + ":" + std::to_string(column);
}

Issues to_issues(Issue issue) {
  Issues issues;
  issues.add(std::move(issue));
  return issues;
}

}  // namespace

InputError::InputError(const std::string& what) : InputError(Issue{.text = what}) {}

InputError::InputError(const std::string& location, const std::string& what)
    : InputError(Issue{.text = what, .location = location}) {}

InputError::InputError(const std::string& file, int line, int column, const std::string& what)
    : InputError(Issue{.text = what, .location = location_text(file, line, column)}) {}

InputError::InputError(Issue issue) : InputError(to_issues(std::move(issue))) {}

InputError::InputError(Issues issues)
    : std::runtime_error(to_string(issues)),
      issues_(std::make_shared<const Issues>(std::move(issues))) {
  assert(!issues_->empty());
}

Issues to_issues(const std::exception& error) { return to_issues(Issue{.text = error.what()}); }

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
// Folders, messages and real input for tests.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"

namespace microswarm::test {

/// An empty folder for the running test, gone with this object.
class Folder {
 public:
  Folder() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = fmt::format("{}_{}_{}", info->test_suite_name(), info->name(), ::getpid());
    for (char& c : name)
      if (c == '/') c = '_';
    path_ = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  /// Writes a file; its path.
  std::filesystem::path with(std::string_view name, std::string_view bytes) const {
    write_file_atomically(path_ / name, bytes);
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// What the InputError says that `action` throws: a line for each thing wrong, none of them empty.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_FALSE(what.empty() || what.ends_with('\n') || what.find("\n\n") != std::string::npos)
        << what;
    return what;
  }
  return "nothing was thrown";
}

/// The issues of the InputError that `action` throws; none if it throws nothing.
template <class Action>
Issues issues_of(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.issues();
  }
  return {};
}

/// Real input outside the repository: the folder that MICROSWARM_DATA names; empty without one.
inline std::filesystem::path data_folder() {
  const char* given = std::getenv("MICROSWARM_DATA");
  const std::filesystem::path folder = given ? given : "";
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

/// Samples of the same kinds that are part of the repository.
inline std::filesystem::path sample_folder() {
  return std::filesystem::path(MICROSWARM_SOURCE_DIR) / "tests" / "samples";
}

}  // namespace microswarm::test

// SPDX-License-Identifier: Apache-2.0
// Random places, messages and folders for the tests of this floor.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>

#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"

namespace microswarm::test {

/// An empty folder for the running test, gone with this object.
class Folder {
 public:
  Folder() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) /
            (std::string("actuation_") + info->test_suite_name() + "_" + info->name());
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes a file; its path.
  std::filesystem::path with(std::string_view name, std::string_view bytes) const {
    write_file_atomically(path_ / name, bytes);
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// What the InputError says that `action` throws; it must be one line.
template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  }
  return "nothing was thrown";
}

/// Real input outside the repository; empty when it is not there.
inline std::filesystem::path data_folder() {
  const char* given = std::getenv("MICROSWARM_DATA");
  const std::filesystem::path folder = given ? given : MICROSWARM_DEFAULT_DATA;
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

/// Numbers in (-1, 1), the same on every machine.
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double number() { return static_cast<double>(engine_()) * 0x1p-31 - 1; }
  Eigen::Vector3d vector() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
  Eigen::Vector3d direction() {
    for (;;)
      if (const Eigen::Vector3d v = vector(); v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }

 private:
  std::mt19937 engine_;
};

/// ∂B_i/∂x_j of a field by central differences of the fourth order.
template <class Field>
Eigen::Matrix3d difference_gradient(const Field& field, const Eigen::Vector3d& p, double step) {
  Eigen::Matrix3d g;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d h = step * Eigen::Vector3d::Unit(axis);
    g.col(axis) =
        (8 * (field(p + h) - field(p - h)) - (field(p + 2 * h) - field(p - 2 * h))) / (12 * step);
  }
  return g;
}

}  // namespace microswarm::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/camera/raw_pixels.hpp"

namespace microswarm {

/// An open camera whose stream has started, of whatever kind.
class CameraDevice {
 public:
  explicit CameraDevice(std::string name) : name_(std::move(name)) {}
  virtual ~CameraDevice() = default;
  CameraDevice(const CameraDevice&) = delete;
  CameraDevice& operator=(const CameraDevice&) = delete;

  const std::string& name() const { return name_; }
  /// Throws HardwareError "NAME: WHY".
  [[noreturn]] void fail(const std::string& why) const { throw HardwareError(name_ + ": " + why); }

  /// Rate that the camera really has [Hz], if it tells.
  virtual std::optional<double> rate() const = 0;
  /// The next picture's data, or what is wrong with them, after waiting for up to `seconds`;
  /// nothing when none came. They are valid until the next call. Throws HardwareError when the
  /// camera is gone.
  virtual std::optional<RawPicture> take(double seconds) = 0;

 private:
  std::string name_;
};

}  // namespace microswarm

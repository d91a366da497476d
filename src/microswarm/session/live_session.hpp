// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "microswarm/rig/runtime/devices.hpp"
#include "microswarm/rig/runtime/live_rig.hpp"
#include "microswarm/session/session.hpp"

namespace microswarm {

/// A session on a rig in real time: a step takes as long as a tick. The destructor sets the coils
/// to zero.
class LiveSession : public Session {
 public:
  /// Opens the rig's devices. With `dry`, nothing is sent to the coils. The coil outputs are logged
  /// as commands.csv in `folder` unless it is empty. Throws HardwareError if a device fails,
  /// InputError if rig and scenario do not fit.
  static std::unique_ptr<LiveSession> open(const RigExperiment& on, bool dry,
                                           const std::filesystem::path& folder);

  /// Sets the coils to zero for good; callable from any thread.
  void stop(const std::string& why);
  /// Sets the coils to zero after the last tick and finishes the log. Returns the reason of a
  /// failure, or an empty string.
  std::string close();
  /// After stop(): the device confirmed that the coils are at zero.
  bool zero_is_confirmed() const;
  RigTiming timing() const;
  /// How often the coils had switched off by themselves so far.
  int resumed() const;

 private:
  class LivePlant;

  LiveSession(const RigExperiment& on, const std::string& name, std::unique_ptr<Plant> owned,
              LivePlant* plant);

  LivePlant* plant_;  ///< owned by the session
};

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "microswarm/rig/runtime/devices.hpp"
#include "microswarm/rig/runtime/live_rig.hpp"
#include "microswarm/session/session.hpp"

namespace microswarm {

/// A session on a rig in real time: a step takes as long as a tick. Whoever destroys it leaves the
/// coils at zero.
class LiveSession : public Session {
 public:
  /// Opens the rig's devices; with `dry`, nothing goes to the coils. What goes there is logged as
  /// commands.csv in `folder`, if one is given. Throws HardwareError for a device that fails,
  /// InputError when rig and scenario do not go together.
  static std::unique_ptr<LiveSession> open(const RigExperiment& on, bool dry,
                                           const std::filesystem::path& folder);

  /// Coils to zero, for good; from any thread.
  void stop(const std::string& why);
  /// The same after the last tick; brings the log to its place. Why that failed, or nothing.
  std::string close();
  /// After stop(): the device said that the coils are at zero.
  bool zero_is_confirmed() const;
  RigTiming timing() const;

 private:
  class LivePlant;

  LiveSession(const RigExperiment& on, const std::string& name, std::unique_ptr<Plant> owned,
              LivePlant* plant);

  LivePlant* plant_;  ///< the session's
};

}  // namespace microswarm

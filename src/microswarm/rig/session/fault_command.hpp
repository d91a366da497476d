// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <future>
#include <string>
#include <vector>

#include "microswarm/rig/params/rig_params.hpp"

namespace microswarm::rig {

/// Starts the command of a rig's `safety.on_fault`, and ends it after 10 s. Separate threads wait
/// for it, so that it delays nothing.
class FaultCommand {
 public:
  /// `note` gets in one line what failed, from another thread.
  explicit FaultCommand(std::function<void(const std::string&)> note) : note_(std::move(note)) {}
  /// As finish().
  ~FaultCommand() = default;
  FaultCommand(const FaultCommand&) = delete;
  FaultCommand& operator=(const FaultCommand&) = delete;

  /// Starts the rig's command, if any, with the reason and the record's folder in its environment
  /// (MICROSWARM_FAULT and MICROSWARM_RECORD); to be called when the coils are at zero.
  void start(const Rig& rig, const std::string& reason, const std::filesystem::path& record);
  /// Waits until the started commands have ended, 10 s at most.
  void finish() { running_.clear(); }

 private:
  const std::function<void(const std::string&)> note_;
  std::vector<std::future<void>> running_;  // last member, since its threads use the others
};

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "microswarm/actuation/drivers/coil_link.hpp"

namespace microswarm::actuation {

/// Compares a device's acknowledgements and outputs with the commands. A device follows an aim
/// exactly, apart from a remainder that it removes at its slew rate after each change.
class OutputCheck {
 public:
  /// Starts with a device that was just armed, so its outputs are zero.
  void begin(const CoilReply& armed);
  /// Resets after a failed exchange, since it is unknown whether the device obeyed.
  void forget() { known_ = false; }
  /// Whether the reply to `aim` agrees with a device that follows it and followed the previous one.
  bool agrees(const CoilAim& aim, const CoilReply& reply);

 private:
  bool known_ = false;
  CoilAim last_;   // scaled by the device
  int clock_ = 0;  // of the last reply [ms]
  std::array<double, coil_link_channels>
      rest_{};  // upper bounds of the remainder at that time [per mille]
};

}  // namespace microswarm::actuation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "microswarm/actuation/drivers/coil_link.hpp"

namespace microswarm {

/// Compares what a device acknowledges and reports with what it was told. A device follows an aim
/// exactly, but for a rest that it takes away by its slew after each change.
class OutputCheck {
 public:
  /// The device has just been armed: its outputs are zero.
  void begin(const CoilReply& armed);
  /// An exchange failed: whether the device obeyed is not known.
  void forget() { known_ = false; }
  /// Whether the answer to `aim` is that of a device which follows it, and followed the one before.
  bool agrees(const CoilAim& aim, const CoilReply& reply);

 private:
  bool known_ = false;
  CoilAim last_;                                   // as scaled by the device
  int clock_ = 0;                                  // of the last reply [ms]
  std::array<double, coil_link_channels> rest_{};  // upper bounds then [per mille]
};

}  // namespace microswarm

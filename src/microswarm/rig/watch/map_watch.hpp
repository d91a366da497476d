// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "microswarm/rig/watch/picture_registration.hpp"

namespace microswarm::rig {

/// Follows where the map lies over the pictures, look by look. Two looks in a row beyond the limit
/// are a fault, and three in which the walls are gone that were clear at the start.
class MapWatch {
 public:
  /// `max_shift` [px] of the worst corner of the workspace; 0: there is no limit.
  explicit MapWatch(double max_shift) : max_shift_(max_shift) {}

  void take(const PictureFit& fit);
  /// The newest displacement [px]; empty if it is not known.
  std::optional<double> shift_px() const { return shift_; }
  double largest_shift_px() const { return largest_; }  ///< so far
  /// Whether the newest look needs another one at once.
  bool is_in_doubt() const { return beyond_ > 0; }
  /// Why a run must end; empty if it need not.
  const std::string& fault() const { return fault_; }
  /// The next note, each once; empty without one.
  std::string take_note();

 private:
  double max_shift_;
  std::optional<double> shift_;
  double largest_ = 0;
  std::optional<double> first_share_;  // of the edges, in the first look
  int beyond_ = 0;                     // looks in a row
  int unsure_ = 0;
  std::deque<std::string> notes_;
  bool told_shift_ = false, told_unsure_ = false;
  std::string fault_;
};

}  // namespace microswarm::rig

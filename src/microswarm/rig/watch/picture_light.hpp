// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "microswarm/formats/images/image.hpp"

namespace microswarm::rig {

/// Mean grey value of a grey picture.
double mean_grey(const formats::Image& picture);

/// Contrast of a picture's finest details, without its noise, as a share of its mean grey value:
/// less out of focus. It also depends on what the picture shows.
double detail_of(const formats::Image& picture);

/// Limits of a value relative to that at the start.
struct ChangeLimits {
  double note_low = 0, note_high = 1e9;    ///< beyond which a note is made
  double fault_low = 0, fault_high = 1e9;  ///< beyond which it is a fault
};

/// Follows a value of the pictures, light or focus, relative to that at the start. A note is made
/// once, a fault when the limits were exceeded for `patience` seconds.
class RelativeValue {
 public:
  RelativeValue(std::string name, ChangeLimits limits, double patience)
      : name_(std::move(name)), limits_(limits), patience_(patience) {}

  /// Takes the value at `t` [s]; the first one above 0 is the reference.
  void take(double value, double t);
  /// Relative value; empty before the first.
  std::optional<double> share() const { return share_; }
  double lowest() const { return lowest_; }    ///< so far
  double highest() const { return highest_; }  ///< so far
  /// Why a run must end; empty if it need not.
  const std::string& fault() const { return fault_; }
  /// A note, once; empty otherwise.
  std::string take_note();

 private:
  std::string name_;
  ChangeLimits limits_;
  double patience_;
  double reference_ = 0;
  std::optional<double> share_;
  double lowest_ = 1, highest_ = 1;
  std::optional<double> beyond_since_;
  std::optional<double> due_;  // time of the note: extremes are awaited
  double now_ = 0;
  bool told_ = false;
  std::string fault_;
};

}  // namespace microswarm::rig

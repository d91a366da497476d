// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

namespace microswarm {

/// When the ticks of a rig in real time begin. With a camera that gives a picture a tick or more, a
/// tick begins with the first picture within half a period of the camera around its due time, and
/// the due times follow the pictures slowly: no picture waits for its tick. The mean rate of the
/// ticks stays theirs, but for a camera within 5 % of it, whose rate they take. With another camera
/// a tick begins when it is due. All times are of one clock [s].
class TickSchedule {
 public:
  /// `tick` [s]; `camera_rate` [Hz], empty if unknown.
  TickSchedule(double tick, std::optional<double> camera_rate)
      : patience_(camera_rate && 1 <= slower * tick * *camera_rate ? 0.5 / *camera_rate : 0) {}

  /// Sets when the first tick may begin.
  void start(double now) {
    if (!started_) due_ = now + patience_;
    started_ = true;
  }
  /// The next tick begins with the first picture from here on; after start().
  double earliest() const { return due_ - patience_; }
  /// It begins now if there was none.
  double latest() const { return due_ + patience_; }

  /// Begins a tick; `picture` is when its picture came, none if it has no new one.
  void begin(std::optional<double> picture) {
    const bool in_time = patience_ > 0 && picture && earliest() <= *picture;
    begun_ = in_time ? std::min(*picture, latest()) : latest();
    if (in_time) due_ += following * (begun_ - due_);
  }
  /// Ends it, `tick` before the next one is due [s]. Returns false if it missed its deadline, a
  /// tick after its picture or after it had to begin; the next one is due at once then.
  bool end(double now, double tick) {
    const bool met = now <= begun_ + tick;
    due_ += tick;
    if (!met) due_ = std::max(due_, now);
    return met;
  }

 private:
  static constexpr double slower = 1.05;  // than the ticks a camera may be, relative
  static constexpr double following =
      0.1;  // share of a picture's delay that the next tick takes on

  double patience_;  // longest time that a tick begins before or after it is due [s]
  bool started_ = false;
  double due_ = 0;  // [s]
  double begun_ = 0;
};

}  // namespace microswarm

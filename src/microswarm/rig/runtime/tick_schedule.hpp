// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

namespace microswarm::rig {

/// Start times of the ticks of a rig in real time. With a camera that delivers at least one picture
/// a tick, a tick begins with the first picture within half a camera period around its due time,
/// and the due times slowly follow the pictures, so that no picture waits for its tick. The mean
/// rate of the ticks is unchanged, except that ticks take the rate of a camera within 5 % of
/// theirs. With a slower camera a tick begins when it is due. All times are of one clock [s].
class TickSchedule {
 public:
  /// `tick` [s]; `camera_rate` [Hz], empty if unknown.
  TickSchedule(double tick, std::optional<double> camera_rate)
      : patience_(camera_rate && 1 <= slower * tick * *camera_rate ? 0.5 / *camera_rate : 0) {}

  /// Sets the time from which the first tick may begin.
  void start(double now) {
    if (!started_) due_ = now + patience_;
    started_ = true;
  }
  /// Time from which a picture starts the next tick; after start().
  double earliest() const { return due_ - patience_; }
  /// Time at which the next tick begins without a picture.
  double latest() const { return due_ + patience_; }

  /// Begins a tick; `picture` is the arrival of its picture, none without a new one.
  void begin(std::optional<double> picture) {
    const bool in_time = patience_ > 0 && picture && earliest() <= *picture;
    begun_ = in_time ? std::min(*picture, latest()) : latest();
    if (in_time) due_ += following * (begun_ - due_);
  }
  /// Ends the tick; the next one is due `tick` [s] after this one was. Returns false if it missed
  /// its deadline, a tick after its picture or its latest start; then the next one is due at once.
  bool end(double now, double tick) {
    const bool met = now <= begun_ + tick;
    due_ += tick;
    if (!met) due_ = std::max(due_, now);
    return met;
  }

 private:
  static constexpr double slower = 1.05;  // largest ratio of the camera's period to a tick
  static constexpr double following =
      0.1;  // share of a picture's delay by which the next tick is shifted

  double patience_;  // maximum time between a tick's start and its due time [s]
  bool started_ = false;
  double due_ = 0;  // [s]
  double begun_ = 0;
};

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "microswarm/core/execution/durations.hpp"
#include "microswarm/core/execution/inheriting_mutex.hpp"
#include "microswarm/rig/watch/rig_watch.hpp"

namespace microswarm::rig {

/// Looks at the map in pictures, in a thread of low priority, so that ticks do not wait for it.
class MapLooks {
 public:
  /// Fits beyond `max_shift` [px], and uncertain ones, are searched widely.
  MapLooks(std::shared_ptr<const PictureRegistration> registration, double max_shift);
  ~MapLooks();
  MapLooks(const MapLooks&) = delete;
  MapLooks& operator=(const MapLooks&) = delete;

  /// Copies a grey picture of the time `t` [s] to be looked at; false while another one is.
  bool offer(const formats::Image& picture, double t);
  /// A look that was finished since the last call, and its picture's time [s].
  std::optional<std::pair<MapLook, double>> take();
  /// Times of the looks so far [s].
  Durations times() const;

 private:
  void work();

  std::shared_ptr<const PictureRegistration> registration_;
  double max_shift_;
  mutable InheritingMutex mutex_;
  std::condition_variable_any changed_;
  bool ends_ = false;
  bool waits_ = false;  // a picture is to be looked at, or is
  formats::Image picture_;
  double t_ = 0;
  std::optional<std::pair<MapLook, double>> look_;
  Durations times_;
  std::thread thread_;  // last member, since it uses the others
};

}  // namespace microswarm::rig

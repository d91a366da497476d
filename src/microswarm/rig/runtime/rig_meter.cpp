// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/runtime/rig_meter.hpp"

#include <algorithm>

namespace microswarm::rig {

void RigMeter::add_output(const CoilMoment& moment) {
  const actuation::CoilOutput& output = moment.output;
  const bool acknowledged = actuation::is_acknowledged(output.status);
  const std::lock_guard lock(mutex_);
  if (acknowledged && moment.seen != answered_) {
    answered_ = moment.seen;
    timing_.camera_to_current.add(moment.driven - moment.seen);
    timing_.late_currents += moment.driven - moment.seen > tick_;
  }
  timing_.coil_late.add(moment.late);
  timing_.round_trip.add(moment.round_trip);
  timing_.sent_for = moment.t - first_.value_or(moment.t);
  if (!first_) first_ = moment.t;
  timing_.unmade += !output.reached;
  timing_.limited += output.scale < 1 - 1e-9;
  timing_.min_scale = std::min(timing_.min_scale, output.scale);
  timing_.resumed += output.status == actuation::DriveStatus::resumed;
  if (acknowledged && output.device_scale < 1 - 1e-9) {
    ++timing_.scaled;
    device_scale_ = output.device_scale;
  }
  timing_.min_device_scale = std::min(timing_.min_device_scale, output.device_scale);
  load_.take(moment.t, output);
}

void RigMeter::add_picture(double vision, int unseen,
                           const std::optional<FollowDirection>& direction) {
  const std::lock_guard lock(mutex_);
  timing_.vision.add(vision);
  ++timing_.frames;
  timing_.direction = direction;
  timing_.unseen_frames += unseen > 0;
  timing_.max_unseen = std::max(timing_.max_unseen, unseen);
}

void RigMeter::add_frame_age(double age) {
  const std::lock_guard lock(mutex_);
  timing_.frame_age.add(age);
}

void RigMeter::add_tick(double seconds, bool missed) {
  const std::lock_guard lock(mutex_);
  timing_.tick.add(seconds);
  timing_.missed_deadlines += missed;
}

RigTiming RigMeter::timing() const {
  const std::lock_guard lock(mutex_);
  return timing_;
}

DeviceEvents RigMeter::device_events() const {
  const std::lock_guard lock(mutex_);
  return {timing_.resumed, timing_.scaled, device_scale_};
}

CoilLoad RigMeter::load() const {
  const std::lock_guard lock(mutex_);
  return load_.load();
}

}  // namespace microswarm::rig

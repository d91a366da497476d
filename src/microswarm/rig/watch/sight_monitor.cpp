// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/sight_monitor.hpp"

#include <fmt/core.h>

#include <cassert>
#include <utility>

namespace microswarm::rig {
namespace {

constexpr double stretches_of_follow_distance = 6;  // over which a direction is estimated

std::string why_not_found(const Detections& seen) {
  if (!seen.not_found) return {};
  std::string radii;
  for (const double radius : seen.parts)
    radii += fmt::format("{}{:.3g}", radii.empty() ? "" : " and ", radius);
  switch (*seen.not_found) {
    case NotFound::none:
      return {};
    case NotFound::several:
      return " (there are several)";
    case NotFound::far:
      return " (what is seen is too far from where it was)";
    case NotFound::size:
      return " (what is seen is of another size)";
    case NotFound::split:
      return fmt::format(" (it split into parts of {} µm radius)", radii);
    case NotFound::merged:
      return fmt::format(" (it merged with another: they had {} µm radius)", radii);
    case NotFound::robots:
      return fmt::format(" ({} of {} robots are not seen)", seen.unseen, seen.robots.size());
  }
  assert(false);
  return {};
}

}  // namespace

void SightMonitor::take(const formats::Image& picture, const Detections& detections,
                        const CameraView& view, double seen, double follow_distance) {
  seen_ = seen;
  if (detections.swarm) found_ = seen;
  why_not_found_ = why_not_found(detections);
  const double distance = params_.follow_distance.value_or(follow_distance);
  angle_.take(detections.commanded_distance, detections.followed_distance,
              detections.across_distance, distance / stretches_of_follow_distance);
  if (!following_.take(detections.commanded_distance, detections.followed_distance, distance) &&
      does_not_follow_.empty())
    does_not_follow_ = fmt::format(
        "the swarm {}: of {:.3g} µm that were commanded it went {:.3g} µm",
        following_.followed() > following_.commanded() ? "is too fast" : "does not follow",
        following_.commanded(), following_.followed());
  watch_.take(picture, detections, view, seen);
  if (const auto direction = angle_.direction())
    watch_.take_follow_share(direction->share, direction->sd);
}

Fault SightMonitor::fault(double now) const {
  if (!does_not_follow_.empty()) return {does_not_follow_, FaultKind::swarm};
  if (const double age = now - seen_; age > params_.max_frame_age)
    return {
        fmt::format("the newest picture is {:.2f} s old, allowed {} s", age, params_.max_frame_age),
        FaultKind::camera};
  if (now - found_ > params_.lost_swarm)
    return {fmt::format("the swarm was not found for {:.2f} s{}, allowed {} s", now - found_,
                        why_not_found_, params_.lost_swarm),
            FaultKind::swarm};
  if (std::string why = watch_.fault(); !why.empty()) return {std::move(why), FaultKind::camera};
  return {};
}

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/rig_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace microswarm::rig {
namespace {

constexpr double noted_light = 0.2;  // relative change
constexpr double noted_focus = 0.7;
constexpr double light_patience = 0.5;  // [s] beyond the limit
constexpr double focus_patience = 2;    // [s], some looks
constexpr double unseen_window = 5;     // [s], or twice the longest time without the swarm
constexpr double robot_radius = 6;      // [px] around a robot's position
constexpr double swarm_margin = 1.2;    // of its radius
constexpr double low_follow = 0.7, high_follow = 1.4;
constexpr double share_spreads = 2;  // standard deviations

ChangeLimits light_limits(double change) {
  const double low = change > 0 ? 1 - change : 0;
  return {1 - noted_light, 1 + noted_light, low, low > 0 ? 1 / low : 1e9};
}

ChangeLimits focus_limits(double least) { return {.note_low = noted_focus, .fault_low = least}; }

}  // namespace

MapLook look_at_map(const PictureRegistration& registration, const formats::Image& picture,
                    double max_shift) {
  MapLook look{registration.fit(picture, false), detail_of(picture)};
  if (!look.fit.unsure.empty() || look.fit.shift_px > max_shift)
    look.fit = registration.fit(picture, true);
  return look;
}

RigWatch::RigWatch(const SafetyParams& safety, double delay)
    : map_(safety.max_map_shift_px),
      light_("the light", light_limits(safety.max_light_change), light_patience),
      focus_by_walls_("the sharpness of the walls", focus_limits(safety.min_focus), focus_patience),
      focus_by_details_("the sharpness of the picture", focus_limits(safety.min_focus),
                        focus_patience),
      unseen_(safety.max_unseen_share, std::max(unseen_window, 2 * safety.lost_swarm)),
      frozen_(safety.frozen_swarm, delay) {}

void RigWatch::take(const formats::Image& picture, const Detections& seen, const CameraView& view,
                    double t) {
  light_.take(mean_grey(picture), t);
  unseen_.take(seen.swarm.has_value(), t);
  frozen_.take(picture, swarm_rings(seen, view.scale), (1 / view.scale.um_per_px) * seen.commanded,
               t);
}

void RigWatch::take(const MapLook& look, double t) {
  map_.take(look.fit);
  focus_is_by_walls_ = look.fit.unsure.empty() && look.fit.by_walls;
  const double light = light_.share().value_or(1);
  if (focus_is_by_walls_ && light > 0) focus_by_walls_.take(look.fit.contrast / light, t);
  focus_by_details_.take(look.detail, t);
  lowest_focus_ = std::min(lowest_focus_, focus().share().value_or(1));
}

void RigWatch::take_follow_share(double share, double sd) {
  follow_share_ = share;
  const double spread = share_spreads * sd * share;
  if (!follow_note_.empty() || (share + spread >= low_follow && share - spread <= high_follow))
    return;
  follow_note_ = fmt::format(
      "the swarm moves {:.0f} ± {:.0f} % of the commanded distance: is the field as strong as it "
      "is meant to be, and the speed that belongs to it measured?",
      100 * share, 100 * sd * share);
}

std::string RigWatch::fault() const {
  if (!map_.fault().empty()) return map_.fault();
  if (!frozen_.fault().empty()) return frozen_.fault();
  if (!light_.fault().empty()) return light_.fault();
  if (!focus_by_walls_.fault().empty()) return focus_by_walls_.fault();
  if (!focus_is_by_walls_ && !focus_by_details_.fault().empty()) return focus_by_details_.fault();
  return unseen_.fault();
}

std::vector<std::string> RigWatch::take_notes() {
  std::vector<std::string> notes;
  const auto add = [&](std::string note) {
    if (!note.empty()) notes.push_back(std::move(note));
  };
  add(map_.take_note());
  add(light_.take_note());
  add(focus_is_by_walls_ ? focus_by_walls_.take_note() : focus_by_details_.take_note());
  add(unseen_.take_note());
  if (!follow_told_) add(follow_note_);
  follow_told_ = follow_told_ || !follow_note_.empty();
  return notes;
}

PictureState RigWatch::state() const {
  return {.light = light_.share().value_or(1),
          .focus = focus().share(),
          .shift_px = map_.shift_px(),
          .unseen_share = unseen_.share(),
          .follow_share = follow_share_,
          .lowest_light = light_.lowest(),
          .highest_light = light_.highest(),
          .lowest_focus = lowest_focus_,
          .largest_shift_px = map_.largest_shift_px(),
          .highest_unseen_share = unseen_.highest(),
          .unseen = unseen_.unseen()};
}

std::vector<vision::Ring> swarm_rings(const Detections& seen, const vision::CameraScale& scale) {
  std::vector<vision::Ring> rings;
  if (!seen.swarm) return rings;
  for (const Vec2 robot : seen.robots) rings.push_back({scale.to_picture(robot), robot_radius});
  if (rings.empty())
    rings.push_back({scale.to_picture(seen.swarm->pose.position),
                     swarm_margin * seen.swarm->radius / scale.um_per_px});
  return rings;
}

std::vector<vision::Ring> moving_rings(const Detections& seen, const vision::CameraScale& scale) {
  constexpr double margin = 1.5;
  constexpr double further = 10;  // [px]
  std::vector<vision::Ring> rings = swarm_rings(seen, scale);
  for (const Body& body : seen.moving) {
    const Disc disc = enclosing_disc(body);
    rings.push_back({scale.to_picture(disc.centre), disc.radius / scale.um_per_px});
  }
  for (vision::Ring& ring : rings) ring.radius_px = margin * ring.radius_px + further;
  return rings;
}

}  // namespace microswarm::rig

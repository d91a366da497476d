// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/watch/frozen_swarm.hpp"
#include "microswarm/rig/watch/map_watch.hpp"
#include "microswarm/rig/watch/picture_light.hpp"
#include "microswarm/rig/watch/unseen_share.hpp"

namespace microswarm::rig {

/// Look at the map over a picture, taken about once a second.
struct MapLook {
  PictureFit fit{};
  double detail = 0;  ///< of the picture, see detail_of
};

/// Looks at the map in a grey picture; a fit that is uncertain or displaced by more than
/// `max_shift` [px] is searched widely.
MapLook look_at_map(const PictureRegistration& registration, const formats::Image& picture,
                    double max_shift);

/// State of a rig's pictures, relative to the start.
struct PictureState {
  double light = 1;                      ///< mean grey value over that at the start
  std::optional<double> focus{};         ///< contrast of walls or details over that at the start
  std::optional<double> shift_px{};      ///< displacement of the map at its worst corner
  double unseen_share = 0;               ///< of the pictures of the last seconds
  std::optional<double> follow_share{};  ///< distance moved over that commanded
  double lowest_light = 1, highest_light = 1;  ///< so far
  double lowest_focus = 1;                     ///< so far, of what `focus` was at the time
  double largest_shift_px = 0;                 ///< so far
  double highest_unseen_share = 0;             ///< so far
  int unseen = 0;                              ///< pictures without the swarm so far
};

/// Watches the pictures of a run: map, light, focus, unseen and frozen swarms, and the share of the
/// commanded distance that the swarm moves. It has no clock: times are those of the pictures.
class RigWatch {
 public:
  /// `delay`: from a command to the motion that it causes [s].
  RigWatch(const SafetyParams& safety, double delay);

  /// Takes a grey picture of the time `t` [s] and what was detected in it.
  void take(const formats::Image& picture, const Detections& seen, const CameraView& view,
            double t);
  /// Takes a look at the map in a picture of the time `t` [s].
  void take(const MapLook& look, double t);
  /// Takes the share of the commanded distance that the swarm moved, and its relative standard
  /// deviation.
  void take_follow_share(double share, double sd);

  /// Whether the newest look at the map needs another one at once.
  bool is_in_doubt() const { return map_.is_in_doubt(); }
  /// Why a run must end; empty if it need not.
  std::string fault() const;
  /// Notes that came up since the last call, each once, one line each.
  std::vector<std::string> take_notes();
  PictureState state() const;

 private:
  MapWatch map_;
  RelativeValue light_, focus_by_walls_, focus_by_details_;
  UnseenShare unseen_;
  FrozenSwarm frozen_;
  bool focus_is_by_walls_ = true;
  double lowest_focus_ = 1;
  std::optional<double> follow_share_;
  std::string follow_note_;
  bool follow_told_ = false;

  const RelativeValue& focus() const {
    return focus_is_by_walls_ ? focus_by_walls_ : focus_by_details_;
  }
};

/// Discs around the swarm, or around each robot [px].
std::vector<vision::Ring> swarm_rings(const Detections& seen, const vision::CameraScale& scale);

/// Discs around all that moves in a picture [px].
std::vector<vision::Ring> moving_rings(const Detections& seen, const vision::CameraScale& scale);

}  // namespace microswarm::rig

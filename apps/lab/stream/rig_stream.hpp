// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "lab/stream/message.hpp"
#include "lab/stream/stream.hpp"
#include "microswarm/rig/session/live_session.hpp"

namespace microswarm::lab {

/// State of a rig in real time.
enum class RigState {
  dry,      ///< runs without current
  opening,  ///< opening its devices
  armed,    ///< runs and drives the coils
  ended     ///< the coils are at zero
};
constexpr auto enum_names(RigState) {
  return std::array<std::pair<RigState, std::string_view>, 4>{{{RigState::dry, "dry"},
                                                               {RigState::opening, "opening"},
                                                               {RigState::armed, "armed"},
                                                               {RigState::ended, "ended"}}};
}

/// Standing of a rig, for its pages.
struct RigStanding {
  RigState state = RigState::opening;
  std::string why;  ///< reason of zero currents; empty while the coils are driven
  std::optional<actuation::StopReport> zero;  ///< set after a run that drove the coils
  std::string folder;                         ///< folder of the run's files; empty for none
};

/// Hello of a session on a rig in real time, with the rig's properties.
MessagePtr rig_hello_message(const experiment::Session& session, const Source& source,
                             const rig::Rig& rig, const std::vector<std::string>& warnings);
/// Current numbers of the rig; without those of a run if none is open.
MessagePtr rig_message(const RigStanding& standing, const rig::LiveSession* run);
/// Whether a page holds the controls, and whether they are free.
MessagePtr controls_message(bool holds, bool are_free, std::size_t pages);
/// A grey picture, at most 1280 pixels wide, as JPEG with its scale and position.
MessagePtr picture_message(const formats::Image& picture, const vision::CameraScale& scale,
                           double t);

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "lab/message.hpp"
#include "lab/stream.hpp"
#include "microswarm/session/live_session.hpp"

namespace microswarm::lab {

/// What a rig does in real time.
enum class RigState {
  dry,      ///< runs, and nothing goes to the coils
  opening,  ///< its devices are being opened
  armed,    ///< runs and drives the coils
  ended     ///< the coils are at zero
};
constexpr auto enum_names(RigState) {
  return std::array<std::pair<RigState, std::string_view>, 4>{{{RigState::dry, "dry"},
                                                               {RigState::opening, "opening"},
                                                               {RigState::armed, "armed"},
                                                               {RigState::ended, "ended"}}};
}

/// How a rig stands.
struct RigStanding {
  RigState state = RigState::opening;
  std::string why;                        ///< the coils are at zero; empty while they are driven
  std::optional<bool> zero_is_confirmed;  ///< by the device, after a run that drove them
  std::string stop_trouble;               ///< CoilDriver::stop_trouble
  std::string folder;                     ///< of the run's files; empty: none
};

/// The hello of a session on a rig in real time, with what the rig is.
MessagePtr rig_hello_message(const Session& session, const Source& source, const Rig& rig,
                             const std::vector<std::string>& warnings);
/// The rig's present numbers; those of the run are missing while none is open.
MessagePtr rig_message(const RigStanding& standing, const LiveSession* run);
/// Whether a page holds the controls, and whether nobody does.
MessagePtr controls_message(bool holds, bool are_free, std::size_t pages);
/// A grey picture, at most 1280 pixels wide, as JPEG with its place in the world.
MessagePtr picture_message(const Image& picture, const CameraScale& scale, double t);

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace microswarm::lab {

/// What a page asks of a session.
enum class Ask {
  play,       ///< goes on; `number`: until this time [s], unless it is 0
  pause,      ///< stands
  step,       ///< one tick
  speed,      ///< `number`: simulated seconds per second; 0: as fast as possible
  seek,       ///< `number`: frame to look at
  live,       ///< looks at the newest frame again
  set,        ///< `key`, `value`: a scenario value, from the next tick on
  restart,    ///< opens the experiment anew with `settings`
  hold,       ///< `on`: the swarm holds, time goes on
  manual,     ///< `on`: a person steers
  steer,      ///< `heading` [rad], `speed` [µm/s]: by hand
  end,        ///< ends the run in order
  clearance,  ///< sends the map's clearance to this page
  beat,       ///< the page with the controls of a rig is there; not answered
  stop,       ///< sets the coils of a rig to zero
  control,    ///< takes the controls of a rig, if no page has them
  arm,        ///< opens the rig anew and drives its coils
  dry         ///< opens the rig anew and drives nothing
};
constexpr auto enum_names(Ask) {
  return std::array<std::pair<Ask, std::string_view>, 18>{{{Ask::play, "play"},
                                                           {Ask::pause, "pause"},
                                                           {Ask::step, "step"},
                                                           {Ask::speed, "speed"},
                                                           {Ask::seek, "seek"},
                                                           {Ask::live, "live"},
                                                           {Ask::set, "set"},
                                                           {Ask::restart, "restart"},
                                                           {Ask::hold, "hold"},
                                                           {Ask::manual, "manual"},
                                                           {Ask::steer, "steer"},
                                                           {Ask::end, "end"},
                                                           {Ask::clearance, "clearance"},
                                                           {Ask::beat, "beat"},
                                                           {Ask::stop, "stop"},
                                                           {Ask::control, "control"},
                                                           {Ask::arm, "arm"},
                                                           {Ask::dry, "dry"}}};
}

/// One message of a page.
struct Request {
  std::uint64_t id = 0;  ///< given back in the answer
  Ask ask = Ask::pause;
  double number = 0;
  double heading = 0;
  double speed = 0;
  bool on = false;
  std::string key;
  std::string value;
  std::vector<std::string> settings;  ///< KEY=VALUE
};

/// What a page asks to open.
struct OpenRequest {
  std::optional<std::string> file;    ///< of the listing; else what the lab was started with
  std::vector<std::string> settings;  ///< KEY=VALUE
  std::optional<std::string> photo;   ///< beneath the map; of the listing or an upload
  double um_per_px = 0;               ///< of the photo
};

/// What a page asks of a photograph: its vessels, and an experiment in them.
struct PhotoRequest {
  std::string file;                   ///< of an upload
  std::vector<std::string> settings;  ///< KEY=VALUE of the search
  double um_per_px = 0;
  std::optional<std::array<double, 2>> start;  ///< of a swarm [µm]; else robots gather
  std::optional<std::array<double, 2>> goal;   ///< [µm]
  int robots = 0;
};

/// Longest message that is read [bytes].
inline constexpr std::size_t max_request_size = 256 * 1024;

/// Most settings in a message.
inline constexpr std::size_t max_settings = 1000;

/// Reads a JSON object such as {"id": 3, "do": "set", "key": "goal_um", "value": "[1, 2]"}. Throws
/// InputError in one line if it is not one, has another key, or a value of another type.
Request read_request(std::string_view text);
/// The id in a message that read_request refuses, for the answer; 0 if it has none.
std::uint64_t id_in(std::string_view text);

/// Reads a JSON object such as {"file": "scenarios/a.yaml", "settings": ["seed=3"]}, strict as
/// read_request.
OpenRequest read_open_request(std::string_view text);

/// Reads a JSON object such as {"file": "a.png", "um_per_px": 9, "goal": [100, 200], "robots": 64},
/// strict as read_request.
PhotoRequest read_photo_request(std::string_view text);

}  // namespace microswarm::lab

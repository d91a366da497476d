// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::lab {

/// Kind of a page's request to a session.
enum class Ask {
  play,       ///< continues, until the time `number` [s] unless it is 0
  pause,      ///< pauses
  step,       ///< one tick
  speed,      ///< `number`: simulated seconds per second; 0: as fast as possible
  seek,       ///< shows the frame `number`
  live,       ///< shows the newest frame again
  set,        ///< `key`, `value`: a scenario value, from the next tick on
  restart,    ///< restarts the experiment with `settings`
  hold,       ///< `on`: the swarm holds while time continues
  manual,     ///< `on`: manual steering
  steer,      ///< manual command: `heading` [rad], `speed` [µm/s]
  end,        ///< ends the run
  clearance,  ///< sends the map's clearance to this page
  beat,       ///< sign of life of the page with a rig's controls; no answer
  ping,       ///< is answered at once, for the delay of the connection
  stop,       ///< sets the coils of a rig to zero
  control,    ///< takes the controls of a rig, if no page has them
  arm,        ///< reopens the rig and drives its coils
  dry         ///< reopens the rig without driving its coils
};
constexpr auto enum_names(Ask) {
  return std::array<std::pair<Ask, std::string_view>, 19>{{{Ask::play, "play"},
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
                                                           {Ask::ping, "ping"},
                                                           {Ask::stop, "stop"},
                                                           {Ask::control, "control"},
                                                           {Ask::arm, "arm"},
                                                           {Ask::dry, "dry"}}};
}

/// One message of a page.
struct Request {
  std::uint64_t id = 0;  ///< repeated in the answer
  Ask ask = Ask::pause;
  double number = 0;
  double heading = 0;
  double speed = 0;
  bool on = false;
  std::string key;
  std::string value;
  std::vector<std::string> settings;  ///< KEY=VALUE

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.id, plain("id", "Repeated in the answer."));
    visit(self.ask, plain("do", "Kind of the request.").needed());
    visit(self.number, plain("number", "Time, speed or frame."));
    visit(self.heading, plain("heading", "Manual heading in rad."));
    visit(self.speed, plain("speed", "Manual speed in µm/s."));
    visit(self.on, plain("on", "Whether it begins or ends."));
    visit(self.key, plain("key", "Key of the scenario."));
    visit(self.value, plain("value", "Value of that key."));
    visit(self.settings, plain("settings", "KEY=VALUE of the scenario."));
  }
};

/// A page's request to open a session.
struct OpenRequest {
  std::optional<std::string> file;    ///< in the listing; default: the command line's experiment
  std::vector<std::string> settings;  ///< KEY=VALUE
  std::optional<std::uint64_t> branch{};  ///< session whose run is repeated up to `frame`
  std::uint64_t frame = 0;
  std::vector<std::string> changes;  ///< KEY=VALUE, of a branch from that frame on
  std::optional<std::string> photo;  ///< background of the map, in the listing or uploaded
  double um_per_px = 0;              ///< of the photo

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "Scenario or record in the listing."));
    visit(self.settings, plain("settings", "KEY=VALUE of the scenario."));
    visit(self.branch, plain("branch", "Session whose run is repeated."));
    visit(self.frame, plain("frame", "Frame up to which it is repeated."));
    visit(self.changes, plain("changes", "KEY=VALUE of a branch from then on."));
    visit(self.photo, plain("photo", "Background of the map."));
    visit(self.um_per_px, plain("um_per_px", 1e-6, 1e6, "Scale of the photo."));
  }
};

/// A page's request for the vessels of a photograph and an experiment in them.
struct PhotoRequest {
  std::string file;                   ///< uploaded photograph
  std::vector<std::string> settings;  ///< KEY=VALUE of the search
  double um_per_px = 0;
  std::optional<Vec2> start;  ///< start of a swarm [µm]; without it robots gather
  std::optional<Vec2> goal;   ///< [µm]
  int robots = 0;

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.file, plain("file", "Uploaded photograph."));
    visit(self.settings, plain("settings", "KEY=VALUE of the search."));
    visit(self.um_per_px, plain("um_per_px", 1e-6, 1e6, "Scale of the photo."));
    visit(self.start, plain("start", "Start of a swarm in µm."));
    visit(self.goal, plain("goal", "Goal in µm."));
    visit(self.robots, plain("robots", 1, 10'000, "Number of robots."));
  }
};

/// Maximum size of a message [B].
inline constexpr std::size_t max_request_size = 256 * 1024;

/// Maximum number of settings in a message.
inline constexpr std::size_t max_settings = 1000;

/// Reads a JSON object such as {"id": 3, "do": "set", "key": "goal_um", "value": "[1, 2]"}. Throws
/// a one-line InputError for another text, an unknown key, or a value of another type.
Request read_request(std::string_view text);
/// Id in a message that read_request refuses, for the answer; 0 without one.
std::uint64_t id_in(std::string_view text);

/// Reads a JSON object such as {"file": "scenarios/a.yaml", "settings": ["seed=3"]}, strict as
/// read_request.
OpenRequest read_open_request(std::string_view text);

/// Reads a JSON object such as {"file": "a.png", "um_per_px": 9, "goal": [100, 200], "robots": 64},
/// strict as read_request.
PhotoRequest read_photo_request(std::string_view text);

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#include "rig/run/rig_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace microswarm::cli {
namespace {

/// A part of the line; the part with the highest rank is omitted first.
struct Part {
  int rank = 0;
  std::string text;
};

std::string state_text(const rig::LiveStatus& s) {
  const std::string state(enum_name(s.state));
  if (s.state == NavigatorState::manual)
    return s.command_speed > 0 ? fmt::format("manual {:.0f} µm/s", s.command_speed) : state;
  if (!s.holding || s.state == NavigatorState::paused) return state;
  return s.state == NavigatorState::arrived ? "at goal" : "at goal, " + state;
}

std::string swarm_text(const rig::LiveStatus& s) {
  if (s.unseen > 0) return fmt::format("{} of {} unseen", s.unseen, s.robots);
  if (!s.not_found) return "seen";
  switch (*s.not_found) {
    case rig::NotFound::several:
      return "unseen: several";
    case rig::NotFound::far:
      return "unseen: too far";
    case rig::NotFound::size:
      return "unseen: other size";
    case rig::NotFound::none:
    case rig::NotFound::split:
    case rig::NotFound::merged:
    case rig::NotFound::robots:
      break;
  }
  return "unseen";
}

std::string gap_text(double gap) {
  return gap > 0 ? fmt::format("gap {:.0f} µm", gap) : std::string("touches");
}

std::string of_limit(double value, const std::optional<double>& limit, const char* unit) {
  if (!limit) return fmt::format("{:.3g} {}", value, unit);
  return fmt::format("{:.3g}/{:.3g} {}", value, *limit, unit);
}

std::string joined(const std::vector<Part>& parts, std::string_view between) {
  std::string line;
  for (const Part& part : parts) line += (line.empty() ? "" : std::string(between)) + part.text;
  return line;
}

std::vector<Part> status_parts(const rig::LiveStatus& s) {
  std::vector<Part> parts{{1, fmt::format("{:.1f} s", s.t)}, {0, state_text(s)}};
  if (std::isfinite(s.goal_distance))
    parts.push_back({4, fmt::format("goal {:.0f} µm", s.goal_distance)});
  parts.push_back({2, swarm_text(s)});
  if (s.gap < s.radius) parts.push_back({3, gap_text(s.gap)});
  parts.push_back({6, of_limit(s.coils.current, s.coils.max_current, "A")});
  parts.push_back({7, of_limit(std::round(s.coils.temperature), s.coils.max_temperature, "°C")});
  if (s.coils.scale < 0.995)
    parts.push_back({3, fmt::format("field {:.0f} %", 100 * s.coils.scale)});
  if (s.missed_deadlines > 0) parts.push_back({5, fmt::format("{} late", s.missed_deadlines)});
  parts.push_back({8, fmt::format("{:.0f} ms old", 1e3 * s.frame_age)});
  parts.push_back({9, fmt::format("p95 {:.0f} ms", 1e3 * s.tick_p95)});
  return parts;
}

}  // namespace

std::string status_text(const rig::LiveStatus& status, std::size_t columns) {
  std::vector<Part> parts = status_parts(status);
  while (true) {
    for (const std::string_view between : {"  ", " "}) {
      std::string line = joined(parts, between);
      if (to_columns(line) <= columns || parts.size() == 1) return line;
    }
    parts.erase(std::ranges::max_element(parts, {}, &Part::rank));
  }
}

void RigStatusLine::update() {
  constexpr auto period = std::chrono::milliseconds(200);
  const auto now = Stop::Clock::now();
  if (!line_.is_there() || now < next_) return;
  next_ = now + period;
  line_.show(status_text(session_.status(), line_.columns()));
}

}  // namespace microswarm::cli

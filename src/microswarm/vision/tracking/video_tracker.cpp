// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/video_tracker.hpp"

#include <algorithm>
#include <cassert>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::vision {
namespace {

double picture_scale(const TrackSettings& settings) {
  if (!settings.um_per_px) throw InputError("um_per_px: is missing");
  return *settings.um_per_px;
}

}  // namespace

FrameOptions frame_options(const TrackSettings& settings, const std::filesystem::path& times) {
  return {.rate = settings.rate,
          .depth = settings.depth,
          .times = times,
          .stack_channel = settings.stack_channel,
          .slice = settings.slice};
}

VideoTracker::VideoTracker(const TrackSettings& settings, double frame_time)
    : channel_(settings.channel),
      um_per_px_(picture_scale(settings)),
      finder_(settings.find),
      tracker_(settings.track, settings.find.diameter * um_per_px_, frame_time) {}

const std::vector<TrackRow>& VideoTracker::step(const VideoFrame& frame) {
  take_channel(frame.picture, channel_, grey_);
  const std::vector<Particle>& found = finder_.find(grey_);
  places_.clear();
  for (const Particle& particle : found)
    places_.push_back(place_in_world(particle.at_px, grey_.height, um_per_px_));
  std::optional<double> elapsed;
  if (last_ && frame.t > *last_) elapsed = frame.t - *last_;
  last_ = frame.t;
  const std::vector<SeenRobot>& sightings = tracker_.step(frame.index, places_, elapsed);
  rows_.clear();
  for (std::size_t i = 0; i < found.size(); ++i)
    rows_.push_back({.frame = frame.index,
                     .t = frame.t,
                     .id = sightings[i].id,
                     .position = places_[i],
                     .velocity = sightings[i].velocity,
                     .radius = um_per_px_ * found[i].radius_px,
                     .mass = found[i].mass,
                     .signal = found[i].signal,
                     .eccentricity = found[i].eccentricity,
                     .at_px = found[i].at_px});
  return rows_;
}

bool looks_like_noise(const TrackSummary& s) {
  constexpr int min_frames = 5;  // fewer are not significant
  return s.frames >= min_frames && s.tracks > 10 && 2 * s.single_tracks > s.tracks;
}

TrackSummary summarise(const std::vector<TrackRow>& rows, int frames) {
  TrackSummary summary{.frames = frames, .features = static_cast<int>(rows.size())};
  int ids = 0;
  for (const TrackRow& row : rows) ids = std::max(ids, row.id + 1);
  std::vector<int> length(static_cast<std::size_t>(ids), 0);
  for (const TrackRow& row : rows) ++length[row.id];
  for (const int n : length) {
    summary.tracks += n > 0;
    summary.single_tracks += n == 1;
    summary.long_tracks += n >= TrackSummary::long_track;
  }

  std::vector<const TrackRow*> last(static_cast<std::size_t>(ids), nullptr);
  double travelled = 0;
  double time = 0;
  Vec2 moved;  // in this frame, summed over `movers`
  int movers = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TrackRow& row = rows[i];
    if (const TrackRow* before = last[row.id];
        before && before->frame + 1 == row.frame && length[row.id] >= TrackSummary::long_track) {
      moved += row.position - before->position;
      ++movers;
      travelled += distance(before->position, row.position);
      time += row.t - before->t;
    }
    last[row.id] = &row;
    if (movers > 0 && (i + 1 == rows.size() || rows[i + 1].frame != row.frame)) {
      summary.drift = summary.drift.value_or(Vec2{}) + moved / movers;
      moved = {};
      movers = 0;
    }
  }
  if (time > 0) summary.mean_speed = travelled / time;
  return summary;
}

}  // namespace microswarm::vision

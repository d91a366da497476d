// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/video_tracker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <span>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/tracking/particle_suggestion.hpp"
#include "microswarm/vision/tracking/robot_width.hpp"

namespace microswarm::vision {
namespace {

constexpr double enough_mass = 0.02;     // of wide robots, for a note if a larger diameter fits
constexpr double surely_mass = 0.5;      // of them, for a note in any case
constexpr double enough_crowded = 0.25;  // of the robots kept

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

double search_range(const TrackSettings& settings) {
  return search_range(settings.track, settings.find.diameter * picture_scale(settings));
}

VideoTracker::VideoTracker(const TrackSettings& settings, double frame_time)
    : channel_(settings.channel),
      find_(settings.find),
      um_per_px_(picture_scale(settings)),
      finder_(settings.find),
      tracker_(settings.track, settings.find.diameter * um_per_px_, frame_time),
      area_(settings.region, settings.mask, 2 * finder_.radius_px() + 2) {}

const std::vector<TrackRow>& VideoTracker::step(const VideoFrame& frame) {
  take_channel(frame.picture, channel_, grey_);
  found_ = finder_.find(area_.crop(grey_));
  for (Particle& particle : found_) particle.at_px += area_.offset();
  std::erase_if(found_, [&](const Particle& p) { return !area_.contains(p.at_px); });
  unsettled_ += finder_.unsettled();
  crowded_ += finder_.crowded();
  note_widths();
  places_.clear();
  for (const Particle& particle : found_)
    places_.push_back(place_in_world(particle.at_px, grey_.height, um_per_px_));
  std::optional<double> elapsed;
  if (last_ && frame.t > *last_) elapsed = frame.t - *last_;
  last_ = frame.t;
  const std::vector<SeenRobot>& sightings = tracker_.step(frame.index, places_, elapsed);
  rows_.clear();
  for (std::size_t i = 0; i < found_.size(); ++i)
    rows_.push_back({.frame = frame.index,
                     .t = frame.t,
                     .id = sightings[i].id,
                     .position = places_[i],
                     .velocity = sightings[i].velocity,
                     .radius = um_per_px_ * found_[i].radius_px,
                     .mass = found_[i].mass,
                     .signal = found_[i].signal,
                     .eccentricity = found_[i].eccentricity,
                     .at_px = found_[i].at_px});
  return rows_;
}

void VideoTracker::note_widths() {
  const std::vector<bool> wider = wider_than_mask(grey_, found_, finder_.radius_px(), find_.tone);
  const int before = wider_;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    mass_ += found_[i].mass;
    if (!wider[i]) continue;
    ++wider_;
    wider_mass_ += found_[i].mass;
  }
  seen_ += static_cast<int>(found_.size());
  if (before == 0 && wider_ > 0) wide_picture_ = grey_;
}

// Features of noise are many and light, so the share of the mass counts.
std::vector<std::string> VideoTracker::doubts(const TrackSummary& tracks) const {
  std::vector<std::string> lines;
  const int fits = wider_mass_ > enough_mass * mass_
                       ? suggest_particles(std::span(&wide_picture_, 1), find_).params.diameter
                       : 0;
  if (fits > (find_.diameter | 1) || wider_mass_ > surely_mass * mass_) {
    lines.push_back(fmt::format(
        "{} of {} features are wider than find.diameter_px={}, their centres are wrong by up to "
        "their radius: {}",
        wider_, seen_, find_.diameter,
        fits > find_.diameter ? fmt::format("find.diameter_px={} fits", fits)
                              : "a larger diameter is needed"));
  } else if (crowded_ > enough_crowded * seen_ && !looks_like_noise(tracks)) {
    lines.push_back(fmt::format(
        "{} features are left out, {} are kept: another is nearer than their least distance of {} "
        "px; see find.separation_px",
        crowded_, seen_, find_.separation > 0 ? find_.separation : 2 * finder_.radius_px() + 2));
  }
  return lines;
}

bool looks_like_noise(const TrackSummary& s) {
  constexpr int enough = 5;  // frames and tracks; fewer are not significant
  return s.frames >= enough && s.single_tracks >= enough && 2 * s.single_tracks > s.tracks;
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

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/video_tracks.hpp"

#include <map>

namespace microswarm::vision {

void take_velocities(std::vector<TrackRow>& rows) {
  std::map<int, std::vector<TrackRow*>> tracks;
  for (TrackRow& row : rows) tracks[row.id].push_back(&row);
  for (const auto& [id, track] : tracks)
    for (std::size_t k = 0; k < track.size(); ++k) {
      const TrackRow& before = *track[k > 0 ? k - 1 : 0];
      const TrackRow& after = *track[k + 1 < track.size() ? k + 1 : k];
      const double elapsed = after.t - before.t;
      track[k]->velocity = elapsed > 0 ? (after.position - before.position) / elapsed : Vec2{};
    }
}

TrackResult track_video(FrameSource& frames, const std::string& source,
                        const TrackSettings& settings, const OnTracked& on_tracked,
                        const Stop& stop) {
  TrackResult result{.source = source,
                     .settings = settings,
                     .frame_time = 1 / frames.rate().value_or(1),
                     .promised = frames.count(),
                     .times = {},
                     .notes = {},
                     .rows = {},
                     .events = {}};
  if (!settings.um_per_px) result.settings.um_per_px = frames.um_per_px();
  VideoTracker tracker(result.settings, result.frame_time);
  VideoFrame frame;
  while (!stop() && frames.next(frame)) {
    const std::vector<TrackRow>& rows = tracker.step(frame);
    result.rows.insert(result.rows.end(), rows.begin(), rows.end());
    result.frames = frame.index + 1;
    result.times.push_back(frame.t);
    if (on_tracked) on_tracked(frame, rows);
  }
  tracker.finish();
  take_velocities(result.rows);
  result.unsettled = tracker.unsettled();
  result.wider = tracker.wider();
  result.crowded = tracker.crowded();
  result.events = tracker.events();
  result.notes = frames.notes();
  for (const std::string& doubt : tracker.doubts(summarise(result.rows, result.frames)))
    result.notes.push_back(source + ": " + doubt);
  result.promised = frames.count();  // which is corrected at the end of some videos
  return result;
}

}  // namespace microswarm::vision

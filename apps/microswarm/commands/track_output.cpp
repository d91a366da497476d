// SPDX-License-Identifier: Apache-2.0
#include "commands/track_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "commands/track_motion.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/io/hdf5_image.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

/// A row of events.csv.
struct EventRow {
  int frame = 0;
  double t = 0;
  vision::TrackChange event = vision::TrackChange::birth;
  int id = 0;
  std::optional<int> other;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.frame, plain("frame", "Picture, from 0."));
    visit(self.t, s("t", "Time since the first picture, or as given."));
    visit(self.event, plain("event", "Kind of the event."));
    visit(self.id, plain("id", "Robot."));
    visit(self.other, plain("other", "Robot it merged with or split from."));
  }
};

std::string events_csv(const vision::TrackResult& result) {
  std::vector<EventRow> rows;
  for (const vision::TrackEvent& e : result.events)
    rows.push_back(
        {e.frame, result.times.at(static_cast<std::size_t>(e.frame)), e.change, e.id, e.other});
  return io::csv_table(rows);
}

std::ptrdiff_t count_changes(const vision::TrackResult& result, vision::TrackChange change) {
  return std::count_if(result.events.begin(), result.events.end(),
                       [&](const vision::TrackEvent& e) { return e.change == change; });
}

void put_integers(io::Hdf5Writer& file, const std::string& path,
                  const std::vector<std::int64_t>& values, const char* doc) {
  file.dataset(path, values);
  file.attribute(path, "unit", "");
  file.attribute(path, "description", doc);
}

std::string tracks_h5(const vision::TrackResult& result) {
  const auto made = io::write_hdf5();
  io::Hdf5Writer& file = *made;
  file.attribute("/", "format", "microswarm tracks");
  file.attribute("/", "format_version", std::int64_t{1});
  file.attribute("/", "version", version);
  file.attribute("/", "source", result.source);
  file.attribute("/", "frames", std::int64_t{result.frames});
  file.attribute("/", "unsettled", std::int64_t{result.unsettled});
  file.attribute("/", "wider", std::int64_t{result.wider});
  file.attribute("/", "crowded", std::int64_t{result.crowded});
  file.attribute("/", "um_per_px", result.settings.um_per_px.value_or(0));
  file.attribute("/", "frame_time_s", result.frame_time);
  file.text("/settings", to_yaml(result.settings));
  file.text("/notes", fmt::format("{}", fmt::join(result.notes, "\n")));
  file.dataset("/times_s", result.times);
  file.attribute("/times_s", "unit", "s");
  file.attribute("/times_s", "description", "Time of each picture.");
  for (const io::Column& column : io::to_columns<vision::TrackRow>(io::ColumnUnits::shown)) {
    const std::string path = "/tracks/" + column.key;
    if (column.kind == io::ColumnKind::integer) {
      std::vector<std::int64_t> values;
      for (const vision::TrackRow& row : result.rows)
        values.push_back(static_cast<std::int64_t>(column.number(&row)));
      put_integers(file, path, values, column.doc.c_str());
      continue;
    }
    std::vector<double> values;
    for (const vision::TrackRow& row : result.rows) values.push_back(column.number(&row));
    file.dataset(path, values);
    file.attribute(path, "unit", std::string(unit_symbol(column.unit)));
    file.attribute(path, "description", column.doc);
  }
  std::vector<std::int64_t> event_frames;
  std::vector<std::int64_t> changes;
  std::vector<std::int64_t> event_ids;
  std::vector<std::int64_t> others;
  for (const vision::TrackEvent& e : result.events) {
    event_frames.push_back(e.frame);
    changes.push_back(static_cast<std::int64_t>(e.change));
    event_ids.push_back(e.id);
    others.push_back(e.other.value_or(-1));
  }
  put_integers(file, "/events/frame", event_frames, "Picture, from 0.");
  put_integers(file, "/events/event", changes, "What happened, an index into words.");
  file.attribute("/events/event", "words", "birth death merge split");
  put_integers(file, "/events/id", event_ids, "Robot.");
  put_integers(file, "/events/other", others, "The robot it merged with or split from, or -1.");
  return file.finish();
}

}  // namespace

void VideoRow::take(const vision::TrackResult& result) {
  frames = result.frames;
  summary = vision::summarise(result.rows, result.frames);
  unsettled = result.unsettled;
}

std::string summary_csv(const std::vector<VideoRow>& rows) {
  std::string text =
      "video,folder,frames,features,tracks,tracks_10_frames,tracks_1_frame,unsettled,drift_x_um,"
      "drift_y_um,mean_speed_um_per_s,error\n";
  for (const VideoRow& row : rows) {
    const vision::TrackSummary& s = row.summary;
    const auto drift = [&](double v) { return s.drift ? fmt::format("{}", v) : ""; };
    text += fmt::format("{},{},", io::csv_text(row.video), io::csv_text(row.folder));
    if (row.error.empty())
      text += fmt::format("{},{},{},{},{},{},{},{},{},\n", row.frames, s.features, s.tracks,
                          s.long_tracks, s.single_tracks, row.unsettled,
                          drift(s.drift.value_or(Vec2{}).x), drift(s.drift.value_or(Vec2{}).y),
                          s.mean_speed ? fmt::format("{}", *s.mean_speed) : "");
    else
      text += ",,,,,,,,," + io::csv_text(row.error) + "\n";
  }
  return text;
}

void keep_track_input(const std::filesystem::path& folder, const std::string& input) {
  for (const char* name :
       {"tracks.csv", "events.csv", "tracks.h5", "overlay.mp4", "overlay", "masses.png"})
    keep_input((folder / name).string(), input);
  for (const char* name : motion_files) keep_input((folder / name).string(), input);
}

void write_tracks(const vision::TrackResult& result, const std::filesystem::path& folder) {
  write_file_atomically(folder / "tracks.csv", io::csv_table(result.rows));
  write_file_atomically(folder / "events.csv", events_csv(result));
  write_file_atomically(folder / "tracks.h5", tracks_h5(result));
}

nlohmann::ordered_json tracks_json(const vision::TrackResult& result) {
  const vision::TrackSummary s = vision::summarise(result.rows, result.frames);
  const double scale = result.settings.um_per_px.value_or(1);
  using Json = nlohmann::ordered_json;
  const auto pair = [&](double by_x, double by_y) {
    return s.drift ? Json{by_x * s.drift->x, by_y * s.drift->y} : Json(nullptr);
  };
  return {{"frames", s.frames},
          {"frames_promised", result.promised ? Json(*result.promised) : Json(nullptr)},
          {"features", s.features},
          {"tracks", s.tracks},
          {"tracks_10_frames", s.long_tracks},
          {"drift_um", pair(1, 1)},
          {"drift_px", pair(1 / scale, -1 / scale)},
          {"mean_speed_um_per_s", s.mean_speed ? Json(*s.mean_speed) : Json(nullptr)},
          {"merges", count_changes(result, vision::TrackChange::merge)},
          {"splits", count_changes(result, vision::TrackChange::split)},
          {"tracks_1_frame", s.single_tracks},
          {"search_range_um", search_range(result.settings)},
          {"unsettled", result.unsettled},
          {"wider", result.wider},
          {"crowded", result.crowded},
          {"um_per_px", scale},
          {"notes", result.notes}};
}

std::string track_summary(const vision::TrackResult& result) {
  const vision::TrackSummary s = vision::summarise(result.rows, result.frames);
  std::string text = fmt::format(
      "{} frames, {:.1f} robots in each\n"
      "  tracks    {}, of which {} have {} frames or more\n",
      s.frames, s.frames > 0 ? static_cast<double>(s.features) / s.frames : 0, s.tracks,
      s.long_tracks, vision::TrackSummary::long_track);
  text += fmt::format("  events    {} merges, {} splits\n",
                      count_changes(result, vision::TrackChange::merge),
                      count_changes(result, vision::TrackChange::split));
  if (!s.drift || !s.mean_speed) return text + "  drift     –, speed –: no track is long enough\n";
  return text + fmt::format(
                    "  drift     ({:.3f}, {:.3f}) µm from the first frame to the last\n"
                    "  speed     {:.3g} µm/s on average from frame to frame\n",
                    s.drift->x, s.drift->y, *s.mean_speed);
}

}  // namespace microswarm::cli

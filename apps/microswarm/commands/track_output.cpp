// SPDX-License-Identifier: Apache-2.0
#include "commands/track_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>

#include "microswarm/config/write.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/io/hdf5_image.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

struct Column {
  const char* key;
  const char* unit;
  const char* doc;
  double (*value)(const TrackRow&);
};

constexpr std::array<Column, 9> columns{{
    {"t_s", "s", "Time since the first picture.", [](const TrackRow& r) { return r.t; }},
    {"x_um", "µm", "Centre, to the right from the picture's left border.",
     [](const TrackRow& r) { return r.place.x; }},
    {"y_um", "µm", "Centre, up from the picture's lower border.",
     [](const TrackRow& r) { return r.place.y; }},
    {"vx_um_per_s", "µm/s", "Velocity by the filter.",
     [](const TrackRow& r) { return r.velocity.x; }},
    {"vy_um_per_s", "µm/s", "Velocity by the filter.",
     [](const TrackRow& r) { return r.velocity.y; }},
    {"radius_um", "µm", "Radius of the ring, or of the even disc with the same gyration.",
     [](const TrackRow& r) { return r.radius; }},
    {"mass", "", "Sum of greys above the ground.", [](const TrackRow& r) { return r.mass; }},
    {"signal", "", "Highest grey above the ground.", [](const TrackRow& r) { return r.signal; }},
    {"eccentricity", "", "0 for a round one, towards 1 for a line.",
     [](const TrackRow& r) { return r.eccentricity; }},
}};

std::string tracks_csv(const TrackResult& result) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "frame,id");
  for (const Column& column : columns) fmt::format_to(out, ",{}", column.key);
  fmt::format_to(out, "\n");
  for (const TrackRow& row : result.rows) {
    fmt::format_to(out, "{},{}", row.frame, row.id);
    for (const Column& column : columns) fmt::format_to(out, ",{:.8g}", column.value(row));
    fmt::format_to(out, "\n");
  }
  return fmt::to_string(text);
}

std::string events_csv(const TrackResult& result) {
  std::string text = "frame,t_s,event,id,other\n";
  for (const TrackEvent& e : result.events)
    text += fmt::format("{},{:.8g},{},{},{}\n", e.frame, e.frame * result.frame_time,
                        enum_name(e.change), e.id, e.other ? fmt::format("{}", *e.other) : "");
  return text;
}

void put_integers(Hdf5Writer& file, const std::string& path,
                  const std::vector<std::int64_t>& values, const char* doc) {
  file.dataset(path, values);
  file.attribute(path, "unit", "");
  file.attribute(path, "description", doc);
}

std::string tracks_h5(const TrackResult& result) {
  Hdf5Writer file;
  file.attribute("/", "format", "microswarm tracks");
  file.attribute("/", "format_version", std::int64_t{1});
  file.attribute("/", "version", version);
  file.attribute("/", "source", result.source);
  file.attribute("/", "frames", std::int64_t{result.frames});
  file.attribute("/", "um_per_px", result.settings.um_per_px.value_or(0));
  file.attribute("/", "frame_time_s", result.frame_time);
  file.text("/settings", to_yaml(result.settings));
  std::vector<std::int64_t> frames;
  std::vector<std::int64_t> ids;
  for (const TrackRow& row : result.rows) {
    frames.push_back(row.frame);
    ids.push_back(row.id);
  }
  put_integers(file, "/tracks/frame", frames, "Picture, from 0.");
  put_integers(file, "/tracks/id", ids, "Robot, from 0 in the order of birth.");
  std::vector<double> values(result.rows.size());
  for (const Column& column : columns) {
    std::transform(result.rows.begin(), result.rows.end(), values.begin(), column.value);
    const std::string path = std::string("/tracks/") + column.key;
    file.dataset(path, values);
    file.attribute(path, "unit", column.unit);
    file.attribute(path, "description", column.doc);
  }
  std::vector<std::int64_t> event_frames;
  std::vector<std::int64_t> changes;
  std::vector<std::int64_t> event_ids;
  std::vector<std::int64_t> others;
  for (const TrackEvent& e : result.events) {
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

void keep_track_input(const std::filesystem::path& folder, const std::string& input) {
  for (const char* name : {"tracks.csv", "events.csv", "tracks.h5", "overlay.mp4", "overlay"})
    keep_input((folder / name).string(), input);
}

void write_tracks(const TrackResult& result, const std::filesystem::path& folder) {
  write_file_atomically(folder / "tracks.csv", tracks_csv(result));
  write_file_atomically(folder / "events.csv", events_csv(result));
  write_file_atomically(folder / "tracks.h5", tracks_h5(result));
}

nlohmann::ordered_json to_json(const TrackResult& result) {
  const TrackSummary s = summarise(result.rows, result.frames);
  const double scale = result.settings.um_per_px.value_or(1);
  const auto count = [&](TrackChange change) {
    return std::count_if(result.events.begin(), result.events.end(),
                         [&](const TrackEvent& e) { return e.change == change; });
  };
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
          {"merges", count(TrackChange::merge)},
          {"splits", count(TrackChange::split)}};
}

std::string track_summary(const TrackResult& result) {
  const TrackSummary s = summarise(result.rows, result.frames);
  std::string text = fmt::format(
      "{} frames, {:.1f} robots in each\n"
      "  tracks    {}, of which {} have {} frames or more\n",
      s.frames, s.frames > 0 ? static_cast<double>(s.features) / s.frames : 0, s.tracks,
      s.long_tracks, TrackSummary::long_track);
  if (!s.drift || !s.mean_speed) return text + "  drift     –, speed –: no track is long enough\n";
  return text + fmt::format(
                    "  drift     ({:.3f}, {:.3f}) µm from the first frame to the last\n"
                    "  speed     {:.3g} µm/s on average from frame to frame\n",
                    s.drift->x, s.drift->y, *s.mean_speed);
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/track_motion.hpp"
#include "commands/track_output.hpp"
#include "commands/track_suggest.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/vision/camera/video_file_writer.hpp"
#include "microswarm/vision/tracking/track_overlay.hpp"
#include "microswarm/vision/tracking/track_table.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

struct TrackOptions {
  std::vector<std::string> videos;
  std::string out;
  std::string config;
  std::string times;
  std::optional<double> um_per_px;
  std::optional<double> rate;
  std::string region;
  std::string mask;
  std::vector<std::string> settings;
  bool no_overlay = false;
  bool motion = false;
  bool remove_drift = false;
  bool suggest = false;
  bool json = false;
};

vision::PictureRegion to_region(const std::string& text) {
  const std::vector<double> values = numbers(text);
  const auto is_count = [](double v) { return v == std::floor(v) && v >= 0 && v <= 100000; };
  if (values.size() != 4 || !std::all_of(values.begin(), values.end(), is_count) || values[2] < 1 ||
      values[3] < 1)
    throw InputError("--region: is '" + text +
                     "', must be X,Y,WIDTH,HEIGHT in whole pixels, at most 100000");
  return {static_cast<int>(values[0]), static_cast<int>(values[1]), static_cast<int>(values[2]),
          static_cast<int>(values[3])};
}

vision::TrackSettings to_settings(const TrackOptions& o) {
  vision::TrackSettings settings;
  if (o.config.empty()) {
    note_each(set_values(settings, {o.settings, "--set"}));
  } else {
    KeyLocations keys;
    settings = read_yaml_file<vision::TrackSettings>(o.config, {o.settings, "--set"}, keys);
    note_each(keys.notes());
  }
  if (o.um_per_px) settings.um_per_px = o.um_per_px;
  if (o.rate) settings.rate = o.rate;
  if (settings.rate && !o.times.empty())
    throw InputError(o.times, "times and a rate are both given");
  if (!o.region.empty()) settings.region = to_region(o.region);
  if (!o.mask.empty()) {
    constexpr int light = 128;  // as everywhere
    settings.mask = formats::threshold(read_photo(o.mask), light, false);
  }
  return settings;
}

[[noreturn]] void fail_without_scale(const std::string& name) {
  throw InputError(name, "µm per px is missing: give --um-per-px");
}

/// Takes the scale of the source where none is given.
void find_scale(vision::TrackSettings& settings, const vision::FrameSource& source,
                const std::string& name) {
  if (settings.um_per_px) return;
  settings.um_per_px = source.um_per_px();
  if (!settings.um_per_px) fail_without_scale(name);
  note("note: {}: a pixel is {:.6g} µm, as the file says\n", name, *settings.um_per_px);
}

/// Tracks the video with a progress bar; `overlay` may be null.
vision::TrackResult follow(vision::FrameSource& source, const std::string& name,
                           const vision::TrackSettings& settings, vision::VideoFileWriter* overlay,
                           formats::Image& first, const Stop& stop) {
  vision::TrackOverlay drawing(*settings.um_per_px);
  ProgressBar bar("track");
  const double all = source.count().value_or(0);
  const auto show = [&](const vision::VideoFrame& frame,
                        const std::vector<vision::TrackRow>& rows) {
    if (frame.index == 0) first = frame.picture;
    if (overlay) {
      const formats::Image& shown = drawing.draw(frame, rows);
      if (frame.index == 0 && shown.width != frame.picture.width)
        note("note: overlay.mp4 is shrunk to {}x{} pixels: more than {} take gigabytes to encode\n",
             shown.width, shown.height, vision::TrackOverlay::max_pixels);
      overlay->add(shown);
    }
    bar.update(all > 0 ? (frame.index + 1) / all : 0, fmt::format("{} robots", rows.size()));
  };
  return vision::track_video(source, name, settings, show, stop);
}

/// Notes on stderr what makes tracks doubtful.
void note_doubts(const vision::TrackResult& result) {
  const vision::TrackSummary s = summarise(result.rows, result.frames);
  if (s.features == 0)
    note("note: no robot is found in {} pictures: see `microswarm track {} --suggest`\n",
         result.frames, result.source);
  if (vision::looks_like_noise(s))
    note(
        "note: {} of {} tracks are a frame long: robots that move more than the search range of "
        "{:.4g} µm a frame need a larger track.search_range_um; if noise is taken for robots, see "
        "`microswarm track {} --suggest`\n",
        s.single_tracks, s.tracks, search_range(result.settings), result.source);
  if (result.unsettled > 0)
    note(
        "note: {} of {} features did not settle on their centroids, their centres are uncertain: "
        "find.max_moves={} ended them or they have none\n",
        result.unsettled, s.features, result.settings.find.max_moves);
}

/// Tracks one video into a folder. Returns the result and its figures for --json.
struct Tracked {
  vision::TrackResult result;
  nlohmann::ordered_json json;
};

/// A video that is being read, and its overlay if there is one.
vision::TrackResult track_pictures(const TrackOptions& o, const std::string& video,
                                   vision::TrackSettings settings,
                                   std::optional<vision::VideoFileWriter>& overlay,
                                   const std::filesystem::path& folder, formats::Image& first,
                                   const Stop& stop) {
  const std::unique_ptr<vision::FrameSource> source =
      vision::open_frames(video, vision::frame_options(settings, o.times));
  find_scale(settings, *source, video);
  if (!source->rate())
    note("note: {} has no times, one picture a second is assumed: give --rate or --times\n", video);
  if (!o.no_overlay) overlay.emplace(folder / "overlay.mp4", source->rate().value_or(1));
  vision::TrackResult result =
      follow(*source, video, settings, overlay ? &*overlay : nullptr, first, stop);
  note_each(result.notes);
  if (const std::string why = source->why_ended(); !why.empty())
    note("note: the tracks end at picture {}: {}\n", result.frames, why);
  else if (!stop.requested() && result.frames < result.promised.value_or(0))
    note("note: {} should have {} pictures, only {} could be read\n", video, *result.promised,
         result.frames);
  return result;
}

/// Takes the scale and the rate of a table where none is given.
void take_units(vision::TrackSettings& settings, const vision::TrackTable& table,
                const std::string& file) {
  if (!settings.um_per_px && table.um_per_px) {
    settings.um_per_px = table.um_per_px;
    note("note: {}: a pixel is {:.6g} µm, as the file says\n", file, *table.um_per_px);
  }
  if (!settings.um_per_px) fail_without_scale(file);
  if (settings.rate) return;
  if (table.rows.front().t)
    note("note: {}: the times are those in the table\n", file);
  else if (table.interval)
    note("note: {}: {:.6g} s from frame to frame, as the file says\n", file, *table.interval);
  else
    note("note: {} has no times, one picture a second is assumed: give --rate\n", file);
}

/// Tracks of a table of another program; `first` is a white picture of their size.
vision::TrackResult take_table(const std::string& file, vision::TrackSettings settings,
                               formats::Image& first) {
  constexpr double max_side = 10000;  // [px]
  if (settings.region || !settings.mask.cells.empty())
    throw InputError(file, "is a table, --region and --mask need pictures");
  const vision::TrackTable table = vision::read_track_table(file, settings.um_per_px);
  take_units(settings, table, file);
  if (!table.rows.front().id)
    note("note: {} has no tracks: its positions are linked with the settings of `track`\n", file);
  if (table.untracked > 0)
    note("note: {}: {} positions in no track are left out\n", file, table.untracked);
  Vec2 corner{1, 1};
  for (const vision::TableRow& row : table.rows)
    corner = {std::max(corner.x, row.at_px.x + 10), std::max(corner.y, row.at_px.y + 10)};
  if (corner.x <= max_side && corner.y <= max_side) {
    first = {static_cast<int>(corner.x), static_cast<int>(corner.y), 1, {}};
    first.pixels.assign(first.index(0, first.height), 255);
  } else {
    note("note: {} has positions beyond {:g} px: no trajectories.png\n", file, max_side);
  }
  vision::TrackResult result = vision::tracks_of_table(table, file, settings);
  note_each(result.notes);
  return result;
}

Tracked track_one(const TrackOptions& o, const std::string& video,
                  const std::filesystem::path& folder, const vision::TrackSettings& settings,
                  const Stop& stop) {
  for (const std::string& input : {video, o.config, o.mask, o.times})
    keep_track_input(folder, input);
  formats::Image first;
  std::optional<vision::VideoFileWriter> overlay;
  const OutFolder hold(folder.string());
  vision::TrackResult result =
      vision::is_track_table(video)
          ? take_table(video, settings, first)
          : track_pictures(o, video, settings, overlay, folder, first, stop);
  note_doubts(result);
  write_tracks(result, folder);
  nlohmann::ordered_json json = tracks_json(result);
  if (o.motion) json["motion"] = write_motion(result, first, o.remove_drift, folder);
  const auto shown = overlay ? overlay->commit() : std::nullopt;
  std::error_code none;  // remove an outdated overlay
  if (!shown || shown->extension() != ".mp4") std::filesystem::remove(folder / "overlay.mp4", none);
  if (!o.json)
    print("{}{}{}wrote {}{}{}\n", stop.requested() ? "stopped after " : "", track_summary(result),
          o.motion ? motion_summary(json["motion"]) : "", (folder / "tracks.csv").string(),
          shown ? ", tracks.h5, events.csv and " + shown->filename().string()
                : ", tracks.h5 and events.csv",
          o.motion ? "; drift.csv, msd.csv, robots.csv, trajectories.png and motion.png" : "");
  return {std::move(result), std::move(json)};
}

/// Names of folders for videos, unlike each other: that of the file without its extension.
std::vector<std::string> folder_names(const std::vector<std::string>& videos) {
  std::vector<std::string> names;
  for (const std::string& video : videos) {
    const std::filesystem::path path = std::filesystem::weakly_canonical(video);
    const std::string stem =
        std::filesystem::is_directory(path) ? path.filename().string() : path.stem().string();
    std::string name = stem;
    for (int k = 2; std::find(names.begin(), names.end(), name) != names.end(); ++k)
      name = fmt::format("{}-{}", stem, k);
    names.push_back(name);
  }
  return names;
}

/// Tracks each video into its own folder. What cannot be read is noted and does not stop the rest.
int track_all(const TrackOptions& o, const vision::TrackSettings& settings, const Stop& stop) {
  const std::vector<std::string> names = folder_names(o.videos);
  const std::filesystem::path folder = o.out;
  const OutFolder hold(o.out);
  for (const std::string& video : o.videos) keep_input((folder / "summary.csv").string(), video);
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  std::vector<VideoRow> rows;
  int wrong = 0;
  for (std::size_t i = 0; i < o.videos.size() && !stop.requested(); ++i) {
    const std::string& video = o.videos[i];
    nlohmann::ordered_json entry{{"video", video}, {"folder", (folder / names[i]).string()}};
    VideoRow row{.video = video, .folder = names[i]};
    try {
      if (!o.json) print("{}\n", video);
      const Tracked one = track_one(o, video, folder / names[i], settings, stop);
      row.take(one.result);
      entry.update(one.json);
    } catch (const InputError& e) {
      note("microswarm: {}\n", e.what());
      entry["error"] = row.error = e.what();
      ++wrong;
    }
    rows.push_back(row);
    all.push_back(entry);
  }
  write_file_atomically(folder / "summary.csv", summary_csv(rows));
  if (wrong > 0) note("note: {} of {} videos could not be tracked\n", wrong, o.videos.size());
  if (stop.requested()) note("note: stopped after {} of {} videos\n", rows.size(), o.videos.size());
  if (o.json)
    print("{}\n", all.dump(2));
  else
    print("wrote {}\n", (folder / "summary.csv").string());
  return stop.requested() ? not_reached : wrong > 0 ? bad_input : ok;
}

int track(const TrackOptions& o, const Context& context) {
  const vision::TrackSettings settings = to_settings(o);
  if (o.suggest) {
    if (o.videos.size() > 1) throw InputError("track: --suggest takes one video");
    return suggest_tracking(o.videos.front(), settings, o.out, o.json, context.stop);
  }
  if (o.out.empty()) throw InputError("track: --out is missing");
  if (o.remove_drift && !o.motion) throw InputError("track: --remove-drift needs --motion");
  const bool are_several = o.videos.size() > 1;
  if (!o.times.empty() && (are_several || vision::is_track_table(o.videos.front())))
    throw InputError("track: --times is for one video");
  if (are_several) return track_all(o, settings, context.stop);
  const Tracked one = track_one(o, o.videos.front(), o.out, settings, context.stop);
  if (o.json) print("{}\n", one.json.dump(2));
  return context.stop.requested() ? not_reached : ok;
}

}  // namespace

void add_track(Command app, Action& action) {
  auto o = std::make_shared<TrackOptions>();
  Command cmd = app.add_command("track", "Detect and track the robots in a video",
                                "track samples/video --um-per-px 0.35 --rate 20 "
                                "--set find.diameter_px=11 --out out/tracks");
  cmd.add_option(
         "video", o->videos,
         "Video file, folder of pictures (PNG, JPEG, BMP, PGM, PPM) or TIFF; or a table of trackpy "
         "(CSV) or TrackMate (CSV, XML). Of several, each gets a folder in --out")
      .required()
      .type_name("VIDEO")
      .input();
  cmd.add_option("--out", o->out,
                 "Folder for tracks.csv, tracks.h5, events.csv and overlay.mp4; with --suggest for "
                 "masses.png")
      .type_name("FOLDER");
  add_um_per_px(cmd, o->um_per_px, "µm per pixel of the video, 1e-6..1e6");
  cmd.add_option("--rate", o->rate, "Frames per second; overrides the value in the video")
      .type_name("NUMBER")
      .check(number(1e-6, 1e6));
  cmd.add_option("--times", o->times, "Times of the pictures: seconds, one a line, or column t_s")
      .type_name("FILE")
      .input();
  cmd.add_option("--config", o->config, "Settings file (YAML); other options override it")
      .type_name("FILE")
      .input();
  cmd.add_option("--region", o->region, "Rectangle of the pictures to track in, in px")
      .type_name("X,Y,WIDTH,HEIGHT");
  cmd.add_option("--mask", o->mask, "Picture whose light pixels are the area to track in")
      .type_name("FILE")
      .input();
  add_settings(cmd, o->settings, "Override a value, e.g. find.tone=bright",
               type_of<vision::TrackSettings>);
  cmd.add_flag("--suggest", o->suggest,
               "Suggest find.min_mass, find.diameter_px and find.tone for a video or picture");
  cmd.add_flag("--no-overlay", o->no_overlay, "Do not write overlay.mp4");
  cmd.add_flag("--motion", o->motion, "Also write MSD, drift, speeds and trajectories");
  cmd.add_flag("--remove-drift", o->remove_drift,
               "Take the common drift out of what --motion writes");
  add_json(cmd, o->json);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return track(*o, context); }; });
}

}  // namespace microswarm::cli

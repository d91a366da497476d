// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands/track_output.hpp"
#include "commands/track_suggest.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/vision/camera/video_file_writer.hpp"
#include "microswarm/vision/tracking/track_overlay.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

struct TrackOptions {
  std::string video;
  std::string out;
  std::string config;
  std::string times;
  std::optional<double> um_per_px;
  std::optional<double> rate;
  std::vector<std::string> settings;
  bool no_overlay = false;
  bool suggest = false;
  bool json = false;
};

vision::TrackSettings to_settings(const TrackOptions& o) {
  vision::TrackSettings settings;
  if (o.config.empty()) {
    note_each(set_values(settings, o.settings));
  } else {
    KeyLocations keys;
    settings = read_yaml_file<vision::TrackSettings>(o.config, o.settings, keys);
    note_each(keys.notes());
  }
  if (o.um_per_px) settings.um_per_px = o.um_per_px;
  if (o.rate) settings.rate = o.rate;
  if (settings.rate && !o.times.empty())
    throw InputError(o.times + ": times and a rate are both given");
  return settings;
}

/// Takes the scale of the source where none is given.
void find_scale(vision::TrackSettings& settings, const vision::FrameSource& source,
                const std::string& name) {
  if (settings.um_per_px) return;
  settings.um_per_px = source.um_per_px();
  if (!settings.um_per_px) throw InputError(name + ": µm per px is missing: give --um-per-px");
  note("note: {}: a pixel is {:.6g} µm, as the file tells\n", name, *settings.um_per_px);
}

/// Tracks the video with a progress bar; `overlay` may be null.
vision::TrackResult follow(vision::FrameSource& source, const std::string& name,
                           const vision::TrackSettings& settings, vision::VideoFileWriter* overlay,
                           const Stop& stop) {
  vision::TrackOverlay drawing(*settings.um_per_px);
  ProgressBar bar("track");
  const double all = source.count().value_or(0);
  const auto show = [&](const vision::VideoFrame& frame,
                        const std::vector<vision::TrackRow>& rows) {
    if (overlay) overlay->add(drawing.draw(frame, rows));
    bar.update(all > 0 ? (frame.index + 1) / all : 0, fmt::format("{} robots", rows.size()));
  };
  return vision::track_video(source, name, settings, show, stop);
}

/// Notes on stderr if the features look like noise rather than robots.
void note_noise(const vision::TrackResult& result) {
  const vision::TrackSummary s = summarise(result.rows, result.frames);
  if (vision::looks_like_noise(s))
    note(
        "note: {} of {} tracks are a frame long: noise may be taken for robots; see `microswarm "
        "track {} --suggest`\n",
        s.single_tracks, s.tracks, result.source);
}

int track(const TrackOptions& o, const Context& context) {
  if (o.suggest) return suggest_tracking(o.video, to_settings(o), o.out, o.json, context.stop);
  if (o.out.empty()) throw InputError("track: --out is missing");
  vision::TrackSettings settings = to_settings(o);
  const std::unique_ptr<vision::FrameSource> source =
      vision::open_frames(o.video, vision::frame_options(settings, o.times));
  find_scale(settings, *source, o.video);
  if (!source->rate())
    note("note: {} has no times, one picture a second is assumed: give --rate or --times\n",
         o.video);
  const OutFolder hold(o.out);
  const std::filesystem::path folder = o.out;
  keep_track_input(folder, o.video);
  keep_track_input(folder, o.config);
  keep_track_input(folder, o.times);
  std::optional<vision::VideoFileWriter> overlay;
  if (!o.no_overlay) overlay.emplace(folder / "overlay.mp4", source->rate().value_or(1));
  const vision::TrackResult result =
      follow(*source, o.video, settings, overlay ? &*overlay : nullptr, context.stop);
  note_each(result.notes);
  if (const std::string why = source->why_ended(); !why.empty())
    note("note: the tracks end at picture {}: {}\n", result.frames, why);
  else if (!context.stop.requested() && result.frames + 1 < result.promised.value_or(0))
    note("note: {} should have {} pictures, only {} could be read\n", o.video, *result.promised,
         result.frames);

  note_noise(result);
  write_tracks(result, folder);
  const auto shown = overlay ? overlay->commit() : std::nullopt;
  std::error_code none;  // remove an outdated overlay
  if (!shown || shown->extension() != ".mp4") std::filesystem::remove(folder / "overlay.mp4", none);
  if (o.json)
    print("{}\n", tracks_json(result).dump(2));
  else
    print("{}{}wrote {}{}\n", context.stop.requested() ? "stopped after " : "",
          track_summary(result), (folder / "tracks.csv").string(),
          shown ? ", tracks.h5, events.csv and " + shown->filename().string()
                : ", tracks.h5 and events.csv");
  return context.stop.requested() ? not_reached : ok;
}

}  // namespace

void add_track(Command app, Action& action) {
  auto o = std::make_shared<TrackOptions>();
  Command cmd = app.add_command("track", "Detect and track the robots in a video",
                                "track samples/video --um-per-px 0.35 --rate 20 "
                                "--set find.diameter_px=11 --out out/tracks");
  cmd.add_option("video", o->video,
                 "Video file, folder of pictures (PNG, JPEG, BMP, PGM, PPM) or multi-page TIFF")
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
      .type_name("FILE");
  cmd.add_option("--config", o->config, "Settings file (YAML); other options override it")
      .type_name("FILE");
  add_settings(cmd, o->settings, "Override a value, e.g. find.tone=bright",
               type_of<vision::TrackSettings>);
  cmd.add_flag("--suggest", o->suggest,
               "Suggest find.min_mass, find.diameter_px and find.tone for a video or picture");
  cmd.add_flag("--no-overlay", o->no_overlay, "Do not write overlay.mp4");
  add_json(cmd, o->json);
  cmd.callback(
      [o, &action] { action = [o](const Context& context) { return track(*o, context); }; });
}

}  // namespace microswarm::cli

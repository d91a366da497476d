// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#ifdef MICROSWARM_HAS_LAB
#include "lab/files/photograph.hpp"
#include "lab/player/run_page.hpp"
#endif
#include "microswarm/experiment/session/replay.hpp"
#include "microswarm/report/run_video.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

int replay_command(const std::string& file, bool json, const Context& context) {
  const experiment::Record record = experiment::read_record(file);
  const experiment::ReplayResult result = experiment::replay(record, context.stop);
  if (json)
    print("{}\n", nlohmann::ordered_json{{"identical", result.identical},
                                         {"stopped", result.stopped},
                                         {"difference", result.difference},
                                         {"record_hash", record.hash()}}
                      .dump(2));
  else if (result.identical)
    print("identical: record {}\n", record.hash());
  else
    print("{}\n", result.stopped ? "stopped" : "differs: " + result.difference);
  return result.identical ? ok : not_reached;
}

struct ReportCommand {
  std::string file;
  std::string out;
  std::string video;
  std::string page;
  double from = 0;
  std::optional<double> to;
  double speed = 1;
  double fps = 30;
  int width = 1280;
  PhotoOptions photo;
};

int write_video(const ReportCommand& o, const experiment::Record& record,
                const report::ReportOptions& options, const Context& context) {
  const report::RunVideo video = report::write_run_video(record, o.video,
                                                         {.from = o.from,
                                                          .to = o.to.value_or(infinity),
                                                          .speed = o.speed,
                                                          .rate = o.fps,
                                                          .width = o.width,
                                                          .report = options,
                                                          .progress = progress_bars()},
                                                         context.stop);
  if (video.pictures > 0) print("wrote {}: {} pictures\n", video.file.string(), video.pictures);
  return video.stopped ? ok : complete;
}

#ifdef MICROSWARM_HAS_LAB
int write_page(const ReportCommand& o, const experiment::Record& record,
               const report::ReportOptions& options, const Context& context) {
  lab::RunPageOptions page{.name = std::filesystem::path(o.file).filename().string(),
                           .um_per_px = options.um_per_px,
                           .progress = progress_bars()};
  if (options.photo) page.photo_jpeg = lab::to_jpeg(o.photo.file);
  const lab::RunPage made = lab::write_run_page(record, o.page, page, context.stop);
  if (made.stopped) {
    note("{}: stopped, so it is not written\n", o.page);
    return ok;
  }
  print("wrote {}: {} frames, {:.1f} MB\n", o.page, made.frames,
        static_cast<double>(made.bytes) / 1e6);
  if (made.every > 1)
    note("{}: one frame in {}, because a page holds at most {} MiB of messages\n", o.page,
         made.every, page.max_bytes >> 20U);
  return complete;
}
#endif

/// Writes the report, and the video or page if requested; with these alone only them.
int report_command(const ReportCommand& o, const Context& context) {
  const experiment::Record record = experiment::read_record(o.file);
  const report::ReportOptions options = report_options(o.photo);
  if ((o.video.empty() && o.page.empty()) || !o.out.empty()) {
    const std::string out = o.out.empty() ? "report" : o.out;
    const OutFolder hold(out);
    report::write_run_report(record, out, options);
    print("wrote {}/index.html\n", out);
  }
  int code = ok;
#ifdef MICROSWARM_HAS_LAB
  if (!o.page.empty()) code = write_page(o, record, options, context);
#endif
  return o.video.empty() || context.stop() ? code : write_video(o, record, options, context);
}

}  // namespace

void add_replay(Command app, Action& action) {
  auto file = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  Command cmd =
      app.add_command("replay", "Run a record again and compare; exit code 3 if it differs",
                      "replay out/first/run.h5");
  cmd.add_option("record", *file, "Record of a run (run.h5)").required().type_name("FILE").input();
  add_json(cmd, *json);
  cmd.callback([=, &action] {
    action = [=](const Context& context) { return replay_command(*file, *json, context); };
  });
}

void add_report(Command app, Action& action) {
  auto o = std::make_shared<ReportCommand>();
  Command cmd = app.add_command(
      "report",
      "Write the report of a record: pictures and an HTML page, a video, or the run as a page",
      "report out/first/run.h5 --video out/first/run.mp4 --speed 4");
  cmd.add_option("record", o->file, "Record of a run (run.h5)")
      .required()
      .type_name("FILE")
      .input();
  cmd.add_option("--out", o->out, "Output folder")
      .type_name("FOLDER")
      .default_text("report, or none with --video or --page");
#ifdef MICROSWARM_HAS_LAB
  cmd.add_option("--page", o->page, "The run as one HTML file that plays in a browser")
      .type_name("FILE")
      .check(file_kind({".html", ".htm"}));
#endif
  cmd.add_option("--video", o->video, "Video of the run to write")
      .type_name("FILE")
      .check(file_kind({".mp4", ".mkv", ".avi", ".gif"}));
  cmd.add_option("--from", o->from, "Time at which the video begins")
      .type_name("SECONDS")
      .needs("--video")
      .check(number(0, 1e9));
  cmd.add_option("--to", o->to, "Time at which it ends")
      .type_name("SECONDS")
      .default_text("the run's end")
      .needs("--video")
      .check(number(0, 1e9));
  cmd.add_option("--speed", o->speed, "Seconds of the run per second of the video")
      .type_name("NUMBER")
      .needs("--video")
      .check(number(1e-3, 1e4));
  cmd.add_option("--fps", o->fps, "Pictures of the video per second; at most 50 of a GIF")
      .type_name("NUMBER")
      .needs("--video")
      .check(number(1, 240));
  cmd.add_option("--width", o->width, "Width of the video in pixels")
      .type_name("NUMBER")
      .needs("--video")
      .check(whole(160, 7680));
  add_photo(cmd, o->photo);
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return report_command(*o, context); };
  });
}

}  // namespace microswarm::cli

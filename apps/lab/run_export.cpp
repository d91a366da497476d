// SPDX-License-Identifier: Apache-2.0
#include "lab/run_export.hpp"

#include <fmt/format.h>

#include <charconv>

#include "lab/http.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/report/run_video.hpp"

namespace microswarm::lab {
namespace {

double number_of(std::string_view target, std::string_view key, double standard, double lo,
                 double hi) {
  const std::string text = query_of(target, key);
  if (text.empty()) return standard;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= lo && value <= hi))
    throw InputError(fmt::format("{} is not a number in {:g}..{:g}", key, lo, hi));
  return value;
}

}  // namespace

std::optional<RunExport> read_run_export(std::string_view name, std::string_view target) {
  RunExport wanted;
  if (name == "run.mp4")
    wanted.kind = RunExport::Kind::video;
  else if (name != "picture.svg")
    return std::nullopt;
  wanted.speed = number_of(target, "speed", wanted.speed, 1e-3, 1e6);
  wanted.width = static_cast<int>(number_of(target, "width", wanted.width, 160, 3840));
  wanted.t = number_of(target, "t", wanted.t, 0, 1e9);
  return wanted;
}

Download make_run_export(const RunExport& wanted, const Record& record, const Stop& stop) {
  const RunVideoOptions options{.speed = wanted.speed, .width = wanted.width};
  if (wanted.kind == RunExport::Kind::picture) {
    Download made{.file = std::make_unique<TemporaryFile>("picture.svg")};
    write_run_picture(record, wanted.t, made.file->path(), options);
    return made;
  }
  Download made{.file = std::make_unique<TemporaryFile>("run.mp4")};
  const RunVideo video = write_run_video(record, made.file->path(), options, stop);
  if (video.stopped) throw InputError("the video was stopped");
  if (video.file != made.file->path()) throw InputError("there is no codec for a video here");
  return made;
}

}  // namespace microswarm::lab

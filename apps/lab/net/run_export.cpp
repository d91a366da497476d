// SPDX-License-Identifier: Apache-2.0
#include "lab/net/run_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "lab/net/http.hpp"

namespace microswarm::lab {
namespace {

constexpr double max_time = 1e9;   // [s]
constexpr double gif_rate = 12.5;  // a file of moderate size; a delay is a whole number of 1/100 s

double query_number(std::string_view target, std::string_view key, double standard, double lo,
                    double hi) {
  const std::string text = query_value(target, key);
  if (text.empty()) return standard;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= lo && value <= hi))
    throw InputError(fmt::format("{} is not a number in {:g}..{:g}", key, lo, hi));
  return value;
}

std::string_view file_name(RunExport::Kind kind) {
  switch (kind) {
    case RunExport::Kind::video:
      return "run.mp4";
    case RunExport::Kind::gif:
      return "run.gif";
    case RunExport::Kind::picture:
      break;
  }
  return "picture.svg";
}

}  // namespace

std::optional<RunExport> read_run_export(std::string_view name, std::string_view target) {
  using enum RunExport::Kind;
  const std::array kinds{video, gif, picture};
  const auto kind = std::ranges::find_if(kinds, [&](auto k) { return file_name(k) == name; });
  if (kind == kinds.end()) return std::nullopt;
  RunExport wanted{.kind = *kind};
  report::RunVideoOptions& options = wanted.options;
  if (wanted.kind == gif) options.rate = gif_rate;
  options.from = query_number(target, "from", options.from, 0, max_time);
  options.to = query_number(target, "to", options.to, 0, max_time);
  options.speed = query_number(target, "speed", options.speed, 1e-3, 1e6);
  options.width = static_cast<int>(query_number(target, "width", options.width, 160, 3840));
  wanted.t = query_number(target, "t", wanted.t, 0, max_time);
  return wanted;
}

Download make_run_export(const RunExport& wanted, const experiment::Record& record,
                         const Stop& stop, const std::function<void(double share)>& show) {
  report::RunVideoOptions options = wanted.options;
  if (show)
    options.progress = [&show](const std::string&) {
      return [&show](double share, const std::string&) { show(share); };
    };
  if (stop()) throw InputError("the export was stopped");
  if (wanted.photo)
    options.report = {.photo = formats::read_photograph(wanted.photo->file),
                      .um_per_px = wanted.photo->um_per_px};
  const std::string_view name = file_name(wanted.kind);
  Download made{.file = std::make_unique<TemporaryFile>(name)};
  const std::filesystem::path& file = made.file->path();
  try {
    if (wanted.kind == RunExport::Kind::picture) {
      report::write_run_picture(record, wanted.t, file, options);
      return made;
    }
    const report::RunVideo video = report::write_run_video(record, file, options, stop);
    if (video.stopped) throw InputError("the video was stopped");
    if (video.file != file) throw InputError("there is no codec for a video here");
    return made;
  } catch (const InputError& error) {
    throw_renamed(error, file, name);
  }
}

}  // namespace microswarm::lab

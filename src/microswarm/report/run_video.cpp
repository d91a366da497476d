// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/run_video.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/experiment/session/playback.hpp"
#include "microswarm/report/map_background.hpp"
#include "microswarm/report/robot_marks.hpp"
#include "microswarm/vision/camera/video_file_writer.hpp"

namespace microswarm::report {
namespace {

constexpr double margins = 48;  // around the drawing [px]; see Picture

/// Length of the drawing's longer side for a picture of this width [px].
double longer_side(const Box& view, int width) {
  const double drawn = width - margins;
  return view.width() >= view.height() ? drawn : drawn * view.height() / view.width();
}

class Film {
 public:
  Film(const experiment::Record& record, const RunVideoOptions& options)
      : playback_(record),
        options_(options),
        view_(playback_.world().map->bounds()),
        size_(longer_side(view_, options.width)),
        ground_(view_, title(0), size_) {
    draw_ground(ground_, *playback_.world().map, options.report);
  }

  const std::vector<experiment::Frame>& frames() const { return playback_.record()->frames; }

  /// The run at time t, which must not decrease; the background is drawn once as pixels.
  formats::Image at(double t) {
    Picture picture(view_, title(t), size_);
    picture.ground(ground_);
    draw(picture, t);
    return picture.raster();
  }

  /// The run at time t, entirely as vector graphics.
  void write(double t, const std::filesystem::path& file) {
    Picture picture(view_, title(t), size_);
    draw_ground(picture, *playback_.world().map, options_.report);
    draw(picture, t);
    picture.write(file);
  }

 private:
  void draw(Picture& picture, double t) {
    while (next_ < frames().size() && frames()[next_].t <= t) advance();
    picture.bodies(playback_.world().at(t).moving().bodies());
    picture.line(trail_, colours::trail, 2.5);
    if (tick_) picture.line(tick_->view.path, colours::path, 2.5);
    if (scenario().robots)
      draw_robots(picture);
    else
      draw_swarm(picture, t);
    if (!playback_.world().obstacles.empty()) picture.legend("obstacles", colours::obstacle, true);
  }

  const experiment::Scenario& scenario() const { return playback_.scenario(); }

  std::string title(double t) const {
    const std::string speed = options_.speed == 1 ? "" : fmt::format(" (×{:g})", options_.speed);
    return fmt::format("{}: {:.1f} s{}", default_title(*playback_.record()), t, speed);
  }

  void advance() {
    tick_ = playback_.step();
    ++next_;
    if (!scenario().robots) trail_.push_back(frames()[next_ - 1].pose.position);
  }

  /// Pose at `t`, interpolated linearly between two frames.
  Pose2 pose(double t) const {
    const experiment::Frame& from = frames()[next_ - 1];
    if (next_ == frames().size()) return from.pose;
    const experiment::Frame& to = frames()[next_];
    const double share = std::clamp((t - from.t) / (to.t - from.t), 0.0, 1.0);
    return {from.pose.position + share * (to.pose.position - from.pose.position),
            wrap(from.pose.heading + share * wrap(to.pose.heading - from.pose.heading))};
  }

  void draw_swarm(Picture& picture, double t) const {
    if (scenario().start) picture.mark(scenario().start->position, "start");
    if (scenario().goal) {
      picture.circle({*scenario().goal, scenario().goal_tolerance}, colours::goal, 2);
      picture.mark(*scenario().goal, "goal", colours::goal);
    }
    picture.swarm(pose(t), frames()[next_ - 1].radius);
    picture.legend("swarm", colours::swarm, true);
    picture.legend("planned path", colours::path);
    picture.legend("travelled path", colours::trail);
  }

  void draw_robots(Picture& picture) const {
    if (tick_ && tick_->robots) draw_robot_marks(picture, scenario(), view_, *tick_->robots);
    draw_robot_goals(picture, scenario());
  }

  experiment::Playback playback_;
  const RunVideoOptions& options_;
  Box view_;
  double size_;
  Picture ground_;
  std::size_t next_ = 0;  ///< frame after the current one
  const experiment::Tick* tick_ = nullptr;
  std::vector<Vec2> trail_;
};

void require_frames(const experiment::Record& record) {
  if (record.frames.empty()) throw InputError("the record has no frames to show");
}

}  // namespace

void write_run_picture(const experiment::Record& record, double t,
                       const std::filesystem::path& file, const RunVideoOptions& options) {
  require_frames(record);
  Film(record, options).write(std::max(t, record.frames.front().t), file);
}

RunVideo write_run_video(const experiment::Record& record, const std::filesystem::path& file,
                         const RunVideoOptions& options, const Stop& stop) {
  require_frames(record);
  const double begin = std::max(options.from, record.frames.front().t);
  const double end = std::min(options.to, record.frames.back().t);
  if (!(begin <= end))
    throw InputError(file.string(), fmt::format("the run is from {:g} s to {:g} s: nothing to show",
                                                record.frames.front().t, record.frames.back().t));
  const double step = options.speed / options.rate;
  const double pictures = std::floor((end - begin) / step) + 1;
  if (!(pictures <= max_video_pictures))
    throw InputError(file.string(),
                     fmt::format("the video would have {:.0f} pictures, at most {}: raise the "
                                 "speed or lower the rate",
                                 pictures, max_video_pictures));
  Film film(record, options);
  vision::VideoFileWriter writer(file, options.rate);
  const Progress progress(options.progress, "video");
  RunVideo result;
  for (; result.pictures < static_cast<int>(pictures); ++result.pictures) {
    if (stop()) {
      result.stopped = true;
      break;
    }
    writer.add(film.at(begin + result.pictures * step));
    progress.update(result.pictures / pictures);
  }
  if (const auto written = writer.commit()) result.file = *written;
  return result;
}

}  // namespace microswarm::report

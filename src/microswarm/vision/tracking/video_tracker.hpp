// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/vision/camera/frames.hpp"
#include "microswarm/vision/tracking/particles.hpp"
#include "microswarm/vision/tracking/robot_tracker.hpp"
#include "microswarm/vision/tracking/search_area.hpp"

namespace microswarm::vision {

/// Settings of video tracking, as in a file for `microswarm track --config`.
struct TrackSettings {
  std::optional<double> um_per_px{};  ///< required for tracking, unless the source reports it
  std::optional<double> rate{};
  std::optional<int> depth{};
  std::optional<int> stack_channel{};
  std::optional<int> slice{};
  VideoChannel channel = VideoChannel::grey;
  ParticleParams find{};
  TrackerParams track{};
  std::optional<PictureRegion> region{};
  formats::Mask mask{};  ///< pixels in which robots are tracked; empty: all. Not in files.

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.um_per_px, plain("um_per_px", 1e-6, 1e6, "Scale: side of a pixel in µm."));
    visit(self.rate, hz("rate", 1e-6, 1e6, "Frame rate; none: that of the video."));
    visit(self.depth, plain("depth", 8, 16, "Bits used of 16-bit samples; none: measured."));
    visit(self.stack_channel,
          plain("stack_channel", 1, 1e6, "Channel of a TIFF that holds several, from 1."));
    visit(self.slice, plain("slice", 1, 1e6, "Slice of a TIFF that holds several, from 1."));
    visit(self.channel, plain("channel", "Colour channel used."));
    visit(self.find, plain("find", "Detection of robots in an image."));
    visit(self.track, plain("track", "Tracking of robots through the images."));
    visit(self.region, plain("region", "Rectangle to track in; none: the whole picture."));
  }
};

/// Options to read the pictures by these settings; `times` is a table of their times, or empty.
FrameOptions frame_options(const TrackSettings& settings, const std::filesystem::path& times = {});

/// A robot seen in a frame. The world's origin is the picture's lower left corner, y points up. The
/// last columns repeat number and position under the names that trackpy and its users know.
struct TrackRow {
  int frame = 0;
  double t = 0;  ///< [s]
  int id = 0;
  Vec2 position{};    ///< measured position [µm]
  Vec2 velocity{};    ///< of a TrackResult as by `take_velocities`, else filtered [µm/s]
  double radius = 0;  ///< [µm]
  double mass = 0;    ///< [grey]
  double signal = 0;  ///< [grey]
  double eccentricity = 0;
  Vec2 at_px{};  ///< measured position [px]: y down, (0, 0) is the centre of the first pixel
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.frame, plain("frame", "Picture, from 0."));
    visit(self.id, plain("id", "Robot, from 0 in the order of birth."));
    visit(self.t, s("t", "Time since the first picture, or as given."));
    visit(self.position.x, um("x", "Centre, to the right from the picture's left."));
    visit(self.position.y, um("y", "Centre, up from the picture's lower border."));
    visit(self.velocity.x, um_per_s("vx", "Velocity between the pictures around, to the right."));
    visit(self.velocity.y, um_per_s("vy", "Velocity between the pictures around, upwards."));
    visit(self.radius, um("radius", "Radius of the ring, or of the even disc alike."));
    visit(self.mass, plain("mass", "Sum of greys above the background."));
    visit(self.signal, plain("signal", "Highest grey above the background."));
    visit(self.eccentricity, plain("eccentricity", "0 if round, towards 1 for a line."));
    visit(self.id, plain("particle", "The same as id, as trackpy names it."));
    visit(self.at_px.x, plain("x", "Centre in the picture in px, to the right."));
    visit(self.at_px.y, plain("y", "Centre in the picture in px, downwards."));
  }
};

/// Search radius of the tracker with these settings, which have a scale [µm].
double search_range(const TrackSettings& settings);

/// Summary of tracks. Long tracks have at least `long_track` frames.
struct TrackSummary {
  static constexpr int long_track = 10;

  int frames = 0;
  int features = 0;  ///< robots seen, summed over all frames
  int tracks = 0;
  int long_tracks = 0;
  int single_tracks = 0;  ///< of one frame
  /// Mean displacement of long tracks, summed over the frames [µm]; empty without such tracks.
  std::optional<Vec2> drift{};
  std::optional<double> mean_speed{};  ///< of long tracks between consecutive frames [µm/s]
};

/// Finds and tracks the robots of a video, picture by picture.
class VideoTracker {
 public:
  /// `frame_time` is the mean time between pictures [s]; the filter goes by their own. Throws
  /// InputError for inconsistent settings.
  VideoTracker(const TrackSettings& settings, double frame_time);

  /// Processes the next picture. Returns the rows of the robots seen in it, valid until the next
  /// call. Throws InputError if the region or the mask does not fit the picture.
  const std::vector<TrackRow>& step(const VideoFrame& frame);
  /// Ends the video.
  void finish() { tracker_.finish(); }
  const std::vector<TrackEvent>& events() const { return tracker_.events(); }
  /// Robots whose centres had not settled when the limit of moves ended them, in all pictures.
  int unsettled() const { return unsettled_; }
  /// Robots of all pictures that are wider than `find.diameter`: their centres are wrong.
  int wider() const { return wider_; }
  /// Robots of all pictures that were left out because another is closer than `find.separation`.
  int crowded() const { return crowded_; }
  /// Reasons to doubt the positions of these tracks, a line each; with the diameter that fits.
  std::vector<std::string> doubts(const TrackSummary& tracks) const;

 private:
  void note_widths();

  VideoChannel channel_;
  ParticleParams find_;
  double um_per_px_;
  ParticleFinder finder_;
  RobotTracker tracker_;
  std::optional<double> last_;  ///< time of the picture before [s]
  int unsettled_ = 0;
  int wider_ = 0;
  int crowded_ = 0;
  int seen_ = 0;                 ///< robots
  double mass_ = 0;              ///< of all robots
  double wider_mass_ = 0;        ///< of those wider than the diameter
  formats::Image wide_picture_;  ///< first with one of them
  formats::Image grey_;
  SearchArea area_;
  std::vector<Particle> found_;
  std::vector<Vec2> places_;
  std::vector<TrackRow> rows_;
};

/// World position [µm] of a point in a picture of `height` pixels, where (0, 0) is the centre of
/// the first pixel and y points down. Same convention as cells of a map (formats/mask.hpp).
inline Vec2 place_in_world(Vec2 at_px, int height, double um_per_px) {
  return um_per_px * Vec2{at_px.x + 0.5, height - 0.5 - at_px.y};
}
/// Picture coordinates of a world position.
inline Vec2 place_in_picture(Vec2 position, int height, double um_per_px) {
  return {position.x / um_per_px - 0.5, height - 0.5 - position.y / um_per_px};
}

/// Summarises tracks. `rows` are sorted by frame; `frames` is the number of processed frames.
TrackSummary summarise(const std::vector<TrackRow>& rows, int frames);

/// Whether most tracks of a video are of one frame, as those of noise are, and of robots that move
/// beyond the search range from frame to frame.
bool looks_like_noise(const TrackSummary& summary);

}  // namespace microswarm::vision

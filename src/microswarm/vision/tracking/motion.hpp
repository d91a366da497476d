// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/geometry/vec2.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"

namespace microswarm::vision {

/// Common drift of the robots from the first frame to this one: the sum of the mean displacements
/// from frame to frame of the robots that are seen in both, as trackpy's compute_drift.
struct DriftRow {
  int frame = 0;
  double t = 0;  ///< [s]
  Vec2 drift{};  ///< [µm]
  int robots = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.frame, plain("frame", "Picture, from 0."));
    visit(self.t, s("t", "Time since the first picture."));
    visit(self.drift.x, um("x", "Drift to the right."));
    visit(self.drift.y, um("y", "Drift upwards."));
    visit(self.robots, plain("robots", "Robots seen here and in the picture before."));
  }
};

/// Mean squared displacement of the robots at a lag.
struct MsdRow {
  int lag = 0;
  double t = 0;    ///< [s]
  double msd = 0;  ///< [µm²]
  std::optional<double> standard_error{};
  int tracks = 0;
  int displacements = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.lag, plain("lag", "Time between both positions in median intervals."));
    visit(self.t, s("lag", "Mean time between both positions."));
    visit(self.msd, plain("msd_um2", "Mean squared displacement in µm²."));
    visit(self.standard_error, plain("standard_error_um2", "Of the mean, from track to track."));
    visit(self.tracks, plain("tracks", "Tracks with such displacements."));
    visit(self.displacements, plain("displacements", "Displacements, overlapping in time."));
  }
};

/// Motion of one robot.
struct MotionRow {
  int id = 0;
  int first_frame = 0;
  int frames = 0;
  double duration = 0;               ///< [s]
  double path = 0;                   ///< [µm]
  double net = 0;                    ///< [µm]
  std::optional<double> speed{};     ///< [µm/s]
  std::optional<double> straight{};  ///< net / path
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.id, plain("id", "Robot, from 0 in the order of birth."));
    visit(self.first_frame, plain("first_frame", "Picture in which it is seen first."));
    visit(self.frames, plain("frames", "Pictures in which it is seen."));
    visit(self.duration, s("duration", "Time from its first to its last picture."));
    visit(self.path, um("path", "Sum of the displacements from picture to picture."));
    visit(self.net, um("net", "Distance of its last position from the first."));
    visit(self.speed, um_per_s("mean_speed", "Path / duration."));
    visit(self.straight, plain("straightness", "Net / path: 1 for a straight line."));
  }
};

/// Power law MSD = 4 D t^exponent of the first lags, by least squares of the logarithms.
struct PowerLaw {
  double exponent = 0;   ///< 1 for diffusion, 2 for constant velocity
  double diffusion = 0;  ///< D, the MSD at 1 s / 4 [µm²/s^exponent]
  int lags = 0;          ///< that were used
};

/// Positions within their pixels. Only positions a pixel or more apart in a track count, since a
/// robot at rest is always at one place of its pixel.
struct PixelBias {
  std::vector<double> fractions_x{};  ///< of x − floor(x), of all counted positions [px]
  std::vector<double> fractions_y{};
  /// Mean cosine of 2π x and 2π y, 0 for even positions, 1 where all are at the pixels' centres.
  double cling = 0;
  bool is_significant = false;
};

/// `rows` are sorted by frame in all of these; there are no two of a robot in one frame.
std::vector<DriftRow> drift_of(std::span<const TrackRow> rows);
/// Subtracts the drift from positions, also those in px. Frames without drift keep the last one.
void subtract_drift(std::vector<TrackRow>& rows, std::span<const DriftRow> drift, double um_per_px);
/// Lags are multiples of the median time between pictures, up to a quarter of the longest track, 1
/// to 1000 of them. Two positions count at the lag nearest to the time between them; `t` is the
/// mean of these times. The standard error is that of the mean over tracks, weighted by their
/// displacements; empty for a single track.
std::vector<MsdRow> mean_squared_displacements(std::span<const TrackRow> rows);
/// By the first ten lags or the first third of them, whichever is less; empty for fewer than two.
std::optional<PowerLaw> fit_power_law(std::span<const MsdRow> rows);
std::vector<MotionRow> motion_of_each(std::span<const TrackRow> rows);
PixelBias pixel_bias(std::span<const TrackRow> rows);

}  // namespace microswarm::vision

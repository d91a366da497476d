// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "microswarm/formats/images/image.hpp"
#include "microswarm/rig/perception/perception.hpp"
#include "microswarm/rig/watch/expected_edges.hpp"

namespace cv {
class Mat;
}

namespace microswarm::rig {

/// Place of what a picture shows, relative to what the map and the camera's scale say.
struct PictureFit {
  std::string unsure{};         ///< why it is not known, one line; empty if it is
  double shift_px = 0;          ///< displacement of the worst corner of the workspace
  double shift_um = 0;          ///< the same [µm]
  double sd_px = 0;             ///< standard deviation of the displacement
  Vec2 middle_px{};             ///< displacement of the picture's middle, x right, y down
  double rotation = 0;          ///< of what is seen, clockwise in the picture [rad]
  double magnification = 1;     ///< size in the picture over the expected one
  double seen_share = 0;        ///< share of the expected edges that are found
  double contrast = 0;          ///< mean drop of grey values at the found edges, over two pixels
  vision::CameraScale scale{};  ///< that fits the picture
  /// Whether walls were compared, or else a still of the run's beginning.
  bool by_walls = true;
};

/// Finds where the walls of a map are in a picture, by the edges that are expected there: a
/// similarity by least squares, robust to what moves, to uneven light and noise (the tracker of
/// Harris & Stennett, 1990). A search on a coarse grid of shifts, rotations and sizes comes before
/// it where the walls are not near their places.
class PictureRegistration {
 public:
  /// The walls of `map`, with the workspace's border where the picture shows it.
  PictureRegistration(const Map& map, const CameraView& view);

  /// For maps whose walls do not suffice: from now on pictures are compared with this one;
  /// `moving` are discs with the bodies that move [px].
  void keep_still(const formats::Image& still, std::span<const vision::Ring> moving);

  /// Fit of a grey picture; `wide`: also far from the expected place, which takes some 50 ms more.
  PictureFit fit(const formats::Image& picture, bool wide) const;

 private:
  struct Similarity {
    double x = 0, y = 0, rotation = 0, growth = 0;  // about the middle
  };
  struct Result;
  using Edges = std::vector<ExpectedEdge>;

  Result follow(const cv::Mat& calm, double noise, const Edges& edges, Similarity start,
                double polarity, double reach) const;
  double share_beside(const cv::Mat& calm, const Edges& edges, Similarity by, double polarity,
                      double least) const;
  std::pair<Similarity, double> search(const cv::Mat& calm, const Edges& edges) const;
  Result best_fit(const cv::Mat& calm, double noise, const Edges& edges, bool wide,
                  bool is_still) const;
  Vec2 moved(Vec2 at_px, const Similarity& by) const;
  PictureFit to_fit(const Result& result) const;
  std::string doubt(const Result& result, double shift_px) const;

  CameraView view_;
  Vec2 middle_;
  std::array<Vec2, 4> corners_{};  // of the workspace in the picture
  Edges with_border_, walls_, still_;
  bool has_still_ = false;
};

/// One line about a fit: displacement, rotation and size, and the scale that would fit.
std::string fit_text(const PictureFit& fit);

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/watch/picture_registration.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::rig {
namespace {

constexpr int enough_edges = 60;
constexpr double enough_seen = 0.35;            // share of the expected edges
constexpr double enough_of_still = 0.5;         // share of a still's edges
constexpr double above_chance = 2;              // times the share beside the expected places
constexpr double largest_growth = 0.12;         // of a fit that is believed
constexpr double largest_turn = 15 * pi / 180;  // [rad]
constexpr double beside = 8;                    // [px] along the normal, where no edge is expected
constexpr double certain = 1.5;                 // [px] largest standard deviation
constexpr double clear_shift = 3;  // standard deviations; more is a shift, though of uncertain size
constexpr double close = 2;        // [px] within which an edge is found
constexpr double clear_edge = 3;   // times the noise
constexpr double weakest_edge = 1.5;  // grey value
constexpr double correlation = 4;     // neighbouring edges that err together
constexpr double narrow_reach = 12;   // [px] of a search from the expected place
constexpr double last_reach = 3;      // [px] of the last search along a normal
constexpr double as_good = 0.05;      // by which another place must explain more edges
constexpr double coarse_side = 160;   // [px] of the coarse picture
constexpr double prior = 1e-3;        // weight of no displacement, in edges

Vec2 turned_left(Vec2 v) { return {-v.y, v.x}; }

double grey_at(const cv::Mat& grey, Vec2 at) {
  const double x = std::clamp(at.x, 0.0, grey.cols - 1.001);
  const double y = std::clamp(at.y, 0.0, grey.rows - 1.001);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  const double right = x - column, down = y - row;
  const std::uint8_t* const upper = grey.ptr(row) + column;
  const std::uint8_t* const lower = grey.ptr(row + 1) + column;
  return (1 - down) * ((1 - right) * upper[0] + right * upper[1]) +
         down * ((1 - right) * lower[0] + right * lower[1]);
}

bool is_inside(const cv::Mat& grey, Vec2 at) {
  constexpr double margin = 2;
  return at.x >= margin && at.y >= margin && at.x <= grey.cols - 1 - margin &&
         at.y <= grey.rows - 1 - margin;
}

/// Edge of a picture.
struct SeenEdge {
  double off = 0;   // [px] from its expected place, along the normal
  double drop = 0;  // of grey values over two pixels
};

/// The clearest edge within `reach` of `at` along `normal`; nothing if none is clear.
std::optional<SeenEdge> edge_along(const cv::Mat& grey, Vec2 at, Vec2 normal, double polarity,
                                   int reach, double least) {
  std::array<double, 128> greys;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  const int count = 2 * reach + 3;
  for (int i = 0; i < count; ++i)
    greys[static_cast<std::size_t>(i)] = grey_at(grey, at + (i - reach - 1.0) * normal);
  const auto drop = [&](int k) {
    const auto i = static_cast<std::size_t>(k + reach);
    return polarity * (greys[i] - greys[i + 2]);
  };
  int best = 0;
  double strongest = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double far = static_cast<double>(k) / (reach + 1);
    const double strength = drop(k) * (1 - 0.5 * far * far);
    if (strength > strongest) strongest = strength, best = k;
  }
  if (drop(best) < least) return std::nullopt;
  const double here = drop(best);
  if (best == -reach || best == reach) return SeenEdge{1.0 * best, here};
  const double before = drop(best - 1), after = drop(best + 1);
  const double bend = before - 2 * here + after;
  return SeenEdge{best + (bend < 0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0),
                  here};
}

/// Weight of a residual by Tukey.
double weight_of(double residual, double scale) {
  const double share = residual / scale;
  if (std::abs(share) >= 1) return 0;
  return (1 - share * share) * (1 - share * share);
}

/// 0, -1, 1, …, -last, last.
std::vector<int> outward(int last) {
  std::vector<int> numbers{0};
  for (int k = 1; k <= last; ++k) numbers.insert(numbers.end(), {-k, k});
  return numbers;
}

struct CoarseSlopes {
  cv::Mat slopes;  // of two floats, from bright to dark, at most 1 long
  int side = 1;    // [px] of a coarse pixel
};

CoarseSlopes coarse_slopes(const cv::Mat& grey) {
  const int side =
      std::max(1, static_cast<int>(std::ceil(std::max(grey.cols, grey.rows) / coarse_side)));
  cv::Mat small;
  cv::resize(grey, small, {grey.cols / side, grey.rows / side}, 0, 0, cv::INTER_AREA);
  cv::Mat slopes(small.size(), CV_32FC2, cv::Scalar(0, 0));
  const double usual = std::max(0.5, edge_noise(small));
  for (int y = 1; y + 1 < small.rows; ++y)
    for (int x = 1; x + 1 < small.cols; ++x) {
      const Vec2 slope{1.0 * small.at<std::uint8_t>(y, x - 1) - small.at<std::uint8_t>(y, x + 1),
                       1.0 * small.at<std::uint8_t>(y - 1, x) - small.at<std::uint8_t>(y + 1, x)};
      const double strength = norm(slope);
      const double scale = 1 / std::max(strength, 6 * usual);
      slopes.at<cv::Vec2f>(y, x) = {static_cast<float>(slope.x * scale),
                                    static_cast<float>(slope.y * scale)};
    }
  return {slopes, side};
}

}  // namespace

struct PictureRegistration::Result {
  Similarity by{};
  int expected = 0;   // edges within the picture
  int seen = 0;       // found of these
  double drop = 0;    // mean of these, of grey values over two pixels
  double sd = 0;      // [px], at the worst corner
  double chance = 0;  // share of such edges beside their places
  double share() const { return expected > 0 ? static_cast<double>(seen) / expected : 0; }
};

PictureRegistration::PictureRegistration(const Map& map, const CameraView& view)
    : view_(view),
      middle_{0.5 * (view.width - 1), 0.5 * (view.height - 1)},
      with_border_(wall_edges(map, view, true)),
      walls_(wall_edges(map, view, false)) {
  const Box& b = map.bounds();
  const std::array<Vec2, 4> corners{b.lo, Vec2{b.hi.x, b.lo.y}, b.hi, Vec2{b.lo.x, b.hi.y}};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 at = view.scale.to_picture(corners[k]);
    corners_[k] = {std::clamp(at.x, 0.0, view.width - 1.0),
                   std::clamp(at.y, 0.0, view.height - 1.0)};
  }
}

void PictureRegistration::keep_still(const formats::Image& still,
                                     std::span<const vision::Ring> moving) {
  still_ = still_edges(still, moving);
  has_still_ = true;
}

Vec2 PictureRegistration::moved(Vec2 at, const Similarity& by) const {
  return middle_ + Vec2{by.x, by.y} + (1 + by.growth) * rotated(at - middle_, by.rotation);
}

/// Follows the edges from `start`, with a reach that shrinks.
PictureRegistration::Result PictureRegistration::follow(const cv::Mat& calm, double noise,
                                                        const Edges& edges, Similarity start,
                                                        double polarity, double reach) const {
  constexpr int last_rounds = 4;
  const double unit = std::max(1.0, norm(middle_));  // [px] that makes all unknowns lengths
  const double least = std::max(weakest_edge, clear_edge * noise);
  Result result{.by = start};
  Similarity& by = result.by;
  int rounds = 0;
  for (double r = reach; rounds < last_rounds; r = std::max(last_reach, 0.75 * r)) {
    rounds += r <= last_reach;
    struct Found {
      Vec2 at, normal;
      double off;
    };
    std::vector<Found> found;
    result.expected = result.seen = 0;
    double drops = 0;
    for (const ExpectedEdge& edge : edges) {
      const Vec2 at = moved(edge.at_px, by);
      if (!is_inside(calm, at)) continue;
      ++result.expected;
      const Vec2 normal = rotated(edge.normal, by.rotation);
      const auto seen = edge_along(calm, at, normal, polarity, static_cast<int>(r), least);
      if (!seen) continue;
      found.push_back({at, normal, seen->off});
      if (std::abs(seen->off) > close) continue;
      ++result.seen;
      drops += seen->drop;
    }
    result.drop = drops / std::max(1, result.seen);
    if (found.size() < 8) return result;
    const double scale = std::max(close, r);
    Eigen::Matrix4d normal_matrix = prior * Eigen::Matrix4d::Identity();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    double weights = 0, squares = 0;
    for (const Found& f : found) {
      const Vec2 arm = f.at - middle_;
      const Eigen::Vector4d row(f.normal.x, f.normal.y, dot(f.normal, turned_left(arm)) / unit,
                                dot(f.normal, arm) / unit);
      const double weight = weight_of(f.off, scale);
      normal_matrix += weight * row * row.transpose();
      right += weight * f.off * row;
      weights += weight;
      squares += weight * f.off * f.off;
    }
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal_matrix);
    const Eigen::Vector4d step = solver.solve(right);
    const double turn = step[2] / unit, growth = step[3] / unit;
    const Vec2 shift = Vec2{step[0], step[1]} + (1 + growth) * rotated(Vec2{by.x, by.y}, turn);
    by = {shift.x, shift.y, by.rotation + turn, (1 + by.growth) * (1 + growth) - 1};
    const double variance = std::max(0.01, weights > 0 ? squares / weights : 1) * correlation;
    const Eigen::Matrix4d covariance = variance * solver.solve(Eigen::Matrix4d::Identity().eval());
    result.sd = 0;
    for (const Vec2 corner : corners_) {
      const Vec2 arm = (corner - middle_) / unit;
      Eigen::Matrix<double, 2, 4> at_corner;
      at_corner << 1, 0, -arm.y, arm.x, 0, 1, arm.x, arm.y;
      result.sd =
          std::max(result.sd, std::sqrt((at_corner * covariance * at_corner.transpose()).trace()));
    }
  }
  result.chance = share_beside(calm, edges, by, polarity, least);
  return result;
}

/// Share of edges where none is expected, beside the places of those that are.
double PictureRegistration::share_beside(const cv::Mat& calm, const Edges& edges, Similarity by,
                                         double polarity, double least) const {
  int places = 0, found = 0;
  for (std::size_t i = 0; i < edges.size(); i += 3) {
    const Vec2 normal = rotated(edges[i].normal, by.rotation);
    for (const double off : {-beside, beside}) {
      const Vec2 at = moved(edges[i].at_px, by) + off * normal;
      if (!is_inside(calm, at)) continue;
      ++places;
      found += edge_along(calm, at, normal, polarity, static_cast<int>(close), least).has_value();
    }
  }
  return places > 0 ? static_cast<double>(found) / places : 0;
}

/// The best of a grid of shifts, rotations and sizes in a coarse picture, and the polarity of its
/// walls: 1 if they are dark, -1 if they are bright.
std::pair<PictureRegistration::Similarity, double> PictureRegistration::search(
    const cv::Mat& calm, const Edges& edges) const {
  constexpr int turns = 4, sizes = 3;
  constexpr double turn_step = 2 * pi / 180, size_step = 0.02, better = 1.02;
  const auto [slopes, side] = coarse_slopes(calm);
  const int reach = std::max(48 / side + 1, 13);
  struct Coarse {
    Vec2 at, normal;
  };
  std::map<std::pair<int, int>, Coarse> cells;
  for (const ExpectedEdge& edge : edges)
    cells.insert({{static_cast<int>(edge.at_px.x) / side, static_cast<int>(edge.at_px.y) / side},
                  {edge.at_px, edge.normal}});
  Similarity best;
  double highest = -1, polarity = 1;
  std::vector<double> score;
  for (const int t : outward(turns))
    for (const int s : outward(sizes)) {  // what is nearer comes first, and wins a tie
      const Similarity by{.rotation = t * turn_step, .growth = s * size_step};
      const auto width = static_cast<std::size_t>(2 * reach + 1);
      score.assign(width * width, 0);
      for (const auto& [cell, edge] : cells) {
        const Vec2 at = (1.0 / side) * (moved(edge.at, by) + Vec2{0.5, 0.5});
        const Vec2 normal = rotated(edge.normal, by.rotation);
        const int column = static_cast<int>(std::floor(at.x));
        const int row = static_cast<int>(std::floor(at.y));
        for (int dy = -reach; dy <= reach; ++dy) {
          if (row + dy < 0 || row + dy >= slopes.rows) continue;
          const cv::Vec2f* const line = slopes.ptr<cv::Vec2f>(row + dy);
          double* const sums = &score[static_cast<std::size_t>(dy + reach) * width];
          for (int dx = std::max(-reach, -column); dx <= std::min(reach, slopes.cols - 1 - column);
               ++dx)
            sums[dx + reach] += normal.x * static_cast<double>(line[column + dx][0]) +
                                normal.y * static_cast<double>(line[column + dx][1]);
        }
      }
      for (std::size_t i = 0; i < score.size(); ++i) {
        if (std::abs(score[i]) <= better * highest) continue;
        highest = std::abs(score[i]);
        polarity = score[i] > 0 ? 1 : -1;
        best = by;
        const std::size_t row = i / width;
        best.x = side * (static_cast<double>(i - row * width) - reach);
        best.y = side * (static_cast<double>(row) - reach);
      }
    }
  return {best, polarity};
}

PictureRegistration::Result PictureRegistration::best_fit(const cv::Mat& calm, double noise,
                                                          const Edges& edges, bool wide,
                                                          bool is_still) const {
  Result best = follow(calm, noise, edges, {}, 1, narrow_reach);
  if (!is_still) {
    const Result bright = follow(calm, noise, edges, {}, -1, narrow_reach);
    if (bright.share() > best.share()) best = bright;
  }
  if (!wide || edges.size() < enough_edges) return best;
  const auto [start, polarity] = search(calm, edges);
  if (is_still && polarity < 0) return best;
  const double side = std::max(calm.cols, calm.rows) / coarse_side;
  const Result far = follow(calm, noise, edges, start, polarity, std::clamp(3 * side, 8.0, 40.0));
  return far.share() > best.share() + as_good ? far : best;
}

std::string PictureRegistration::doubt(const Result& result, double shift) const {
  if (result.expected < enough_edges)
    return fmt::format("{} edges are expected in the picture, {} are needed", result.expected,
                       enough_edges);
  if (result.share() < enough_seen)
    return fmt::format("{:.0f} % of the edges that are expected are found, {:.0f} % are needed",
                       100 * result.share(), 100 * enough_seen);
  if (std::abs(result.by.growth) > largest_growth || std::abs(result.by.rotation) > largest_turn)
    return "what fits best is turned or scaled too much to be the same";
  if (result.share() < above_chance * result.chance)
    return fmt::format(
        "{:.0f} % of the edges that are expected are found, and {:.0f} % beside them",
        100 * result.share(), 100 * result.chance);
  if (result.sd > certain && shift < clear_shift * result.sd)
    return fmt::format("the edges fix it to ± {:.2g} px only", result.sd);
  return {};
}

PictureFit PictureRegistration::to_fit(const Result& result) const {
  const Similarity& by = result.by;
  PictureFit fit{.sd_px = result.sd,
                 .middle_px = {by.x, by.y},
                 .rotation = by.rotation,
                 .magnification = 1 + by.growth,
                 .seen_share = result.share(),
                 .contrast = result.drop,
                 .scale = view_.scale};
  for (const Vec2 corner : corners_)
    fit.shift_px = std::max(fit.shift_px, distance(moved(corner, by), corner));
  fit.unsure = doubt(result, fit.shift_px);
  fit.shift_um = fit.shift_px * view_.scale.um_per_px;
  fit.scale.um_per_px /= fit.magnification;
  fit.scale.rotation += view_.scale.y_up ? by.rotation : -by.rotation;
  fit.scale.origin_px = moved(view_.scale.origin_px, by);
  return fit;
}

PictureFit PictureRegistration::fit(const formats::Image& picture, bool wide) const {
  const cv::Mat calm = calm_picture(picture);
  const double noise = edge_noise(calm);
  if (has_still_) {
    PictureFit still = to_fit(best_fit(calm, noise, still_, wide, true));
    still.by_walls = false;
    if (still.unsure.empty() && still.seen_share < enough_of_still)
      still.unsure = "much of what the run began with is no longer seen";
    return still;
  }
  PictureFit fit = to_fit(best_fit(calm, noise, with_border_, wide, false));
  if (fit.unsure.empty()) return fit;
  if (walls_.size() >= enough_edges && walls_.size() < with_border_.size())
    if (PictureFit walls = to_fit(best_fit(calm, noise, walls_, wide, false)); walls.unsure.empty())
      return walls;
  return fit;
}

std::string fit_text(const PictureFit& fit) {
  const auto tenths = [](double x) { return std::round(10 * x) / 10 + 0.0; };  // never -0
  const double turned = degrees(fit.rotation);
  const double larger = 100 * (fit.magnification - 1);
  std::string text = fmt::format(
      "{} up to {:.1f} px ({:.3g} µm) from {} place in the picture: displaced by ({:.1f}, {:.1f}) "
      "px in its middle",
      fit.by_walls ? "the walls are" : "what the run began with is", fit.shift_px, fit.shift_um,
      fit.by_walls ? "their" : "its", tenths(fit.middle_px.x), tenths(fit.middle_px.y));
  if (std::abs(turned) >= 0.05)
    text += fmt::format(", turned by {:.1f}° {}", std::abs(turned),
                        turned > 0 ? "clockwise" : "counter-clockwise");
  if (std::abs(larger) >= 0.05)
    text += fmt::format(", {:.1f} % {} than expected", std::abs(larger),
                        larger > 0 ? "larger" : "smaller");
  return text;
}

}  // namespace microswarm::rig

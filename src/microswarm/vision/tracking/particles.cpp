// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/particles.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <string>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/each_cpu.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/vision/image/mask_ops.hpp"
#include "microswarm/vision/tracking/ring_fit.hpp"

namespace microswarm::vision {
namespace {

constexpr std::size_t together = 4;  // particles that are described at once
constexpr double move_from = 0.6;    // [px] a mask farther from its centroid moves
constexpr int single_steps = 10;     // moves by a pixel, as in trackpy

constexpr double cut_level = 0.15;     // of a particle's level, at the rim of a mask that cuts it
constexpr double flat_level = 0.78;    // of its highest grey: a disc's level, not a spot's
constexpr double edge_low = 0.25;      // of its level, which greys must exceed if it is large
constexpr double edge_high = 0.75;     // and from which they count alike
constexpr int max_soft_rounds = 30;    // of a mask between pixels
constexpr double settled_move = 5e-4;  // [px] moves of its centre that end it
constexpr double beyond = 1.6;         // of a move, since each goes only a part of the way
constexpr double far_from_mask = 1;    // [px] from which it is at another particle

constexpr std::size_t octants = 8;  // of the rim of a mask

/// Eighth of the circle in which a pixel of the rim is.
std::size_t octant(int dx, int dy) {
  return (dx < 0 ? 4U : 0U) + (dy < 0 ? 2U : 0U) + (std::abs(dx) < std::abs(dy) ? 1U : 0U);
}

constexpr std::uint8_t by_itself = 1;  // marks of pixels where a mask was
constexpr std::uint8_t by_another = 2;

int odd(int diameter) { return diameter | 1; }

BandPassParams band_params(const ParticleParams& p) {
  if (p.noise >= odd(p.diameter))
    throw InputError("noise_px: is " + number_text(p.noise) + ", must be below the diameter, " +
                     std::to_string(odd(p.diameter)));
  return {p.noise, odd(p.diameter), p.min_foreground, p.tone == ParticleTone::dark};
}

/// Side of the largest square inside the circle of radius `separation`.
int square_in(int separation) {
  return std::max(1, static_cast<int>(2 * separation / std::numbers::sqrt2));
}

MICROSWARM_EACH_CPU float max_value(std::span<const float> values) {
  std::array<float, 16> lanes{};  // 16 independent lanes, for parallel execution
  std::size_t i = 0;
  for (; i + lanes.size() <= values.size(); i += lanes.size())
    for (std::size_t k = 0; k < lanes.size(); ++k) lanes[k] = std::max(lanes[k], values[i + k]);
  for (; i < values.size(); ++i) lanes[0] = std::max(lanes[0], values[i]);
  return *std::max_element(lanes.begin(), lanes.end());
}

MICROSWARM_EACH_CPU void scale_down(std::span<const float> values, float scale,
                                    std::uint8_t* bytes) {
  for (std::size_t i = 0; i < values.size(); ++i)
    bytes[i] = static_cast<std::uint8_t>(static_cast<int>(scale * values[i]));
}

/// Number of values that are at most `limit`.
MICROSWARM_EACH_CPU std::size_t count_up_to(std::span<const std::uint8_t> values,
                                            std::uint8_t limit) {
  constexpr std::size_t lanes = 64;
  constexpr std::size_t most = 255;  // that a lane can count
  std::size_t count = 0;
  std::size_t i = 0;
  while (i + lanes <= values.size()) {
    std::uint8_t counts[lanes] = {};
    for (std::size_t n = 0; n < most && i + lanes <= values.size(); ++n, i += lanes)
      for (std::size_t k = 0; k < lanes; ++k)
        counts[k] = static_cast<std::uint8_t>(counts[k] + (values[i + k] <= limit ? 1 : 0));
    for (const std::uint8_t n : counts) count += n;
  }
  for (; i < values.size(); ++i) count += values[i] <= limit ? 1 : 0;
  return count;
}

/// Whether any of `count` values is above the threshold and equals the maximum around it.
MICROSWARM_EACH_CPU bool has_peak(const std::uint8_t* values, const std::uint8_t* highest,
                                  std::uint8_t threshold, int count) {
  std::uint8_t any = 0;
  for (int i = 0; i < count; ++i)
    any |= static_cast<std::uint8_t>((values[i] > threshold) & (values[i] == highest[i]));
  return any != 0;
}

}  // namespace

ParticleFinder::ParticleFinder(const ParticleParams& params)
    : params_(params),
      radius_(odd(params.diameter) / 2),
      separation_(params.separation > 0 ? params.separation : odd(params.diameter) + 1),
      band_pass_(band_params(params)),
      window_(radius_) {
  for (int dy = -radius_; dy <= radius_; ++dy)
    for (int dx = -radius_; dx <= radius_; ++dx) {
      if (dx * dx + dy * dy > radius_ * radius_) continue;
      const double twice = 2 * maths::atan2(dy, dx);
      const auto [sine, cosine] = maths::sincos(twice);
      mask_.push_back({dx, dy, cosine, sine});
    }
}

const std::vector<Particle>& ParticleFinder::find(const formats::Image& grey) {
  width_ = grey.width;
  height_ = grey.height;
  scale_to_bytes(band_pass_.filter(grey));
  find_peaks();
  thin_plateaus(peaks_);
  refine_peaks();
  keep_apart();
  for (std::size_t i = 0; i < particles_.size(); i += together) describe(i);
  for (std::size_t i = 0; i < particles_.size(); ++i) centre(particles_[i], peaks_[i]);
  if (params_.shape == ParticleShape::ring) fit_rings(grey);
  return particles_;
}

void ParticleFinder::scale_to_bytes(const std::vector<float>& rise) {
  const float highest = max_value(rise);
  const float scale = highest > 0 ? 255.0F / highest : 0.0F;
  greys_per_byte_ = highest / 255.0;
  bytes_.resize(rise.size() + RoundWindow::read_beyond);
  scale_down(rise, scale, bytes_.data());
}

// Bisects for the least value up to which there are enough.
int ParticleFinder::peak_threshold() const {
  const std::span<const std::uint8_t> pixels{bytes_.data(),
                                             static_cast<std::size_t>(width_) * height_};
  const std::size_t zeros = count_up_to(pixels, 0);
  const double above = static_cast<double>(pixels.size() - zeros);
  const double rank = params_.percentile / 100 * (above - 1);
  int low = 0;
  int high = 255;
  while (low < high) {
    const int middle = (low + high) / 2;
    const std::size_t count = count_up_to(pixels, static_cast<std::uint8_t>(middle)) - zeros;
    if (static_cast<double>(count) > rank)
      high = middle;
    else
      low = middle + 1;
  }
  return high;
}

void ParticleFinder::find_peaks() {
  peaks_.clear();
  constexpr int stretch = 64;  // values of a row tested at once
  const auto threshold = static_cast<std::uint8_t>(peak_threshold());
  if (std::min(width_, height_) <= 2 * radius_) return;
  const int margin = is_large() ? 0 : std::max(radius_, separation_ / 2 - 1);
  const cv::Mat around =
      highest_around(cv::Mat(height_, width_, CV_8U, bytes_.data()), square_in(separation_));
  for (int row = margin; row < height_ - margin; ++row) {
    const std::uint8_t* values = bytes_.data() + static_cast<std::size_t>(row) * width_;
    const std::uint8_t* highest = around.ptr<std::uint8_t>(row);
    for (int from = margin; from < width_ - margin; from += stretch) {
      const int to = std::min(from + stretch, width_ - margin);
      if (!has_peak(values + from, highest + from, threshold, to - from)) continue;
      for (int column = from; column < to; ++column)
        if (values[column] > threshold && values[column] == highest[column])
          peaks_.push_back({column, row});
    }
  }
}

Vec2 ParticleFinder::measure(Peak at, Particle& particle) const {
  const auto [mass, along_x, along_y] = window_.moments(bytes_.data() + pixel_index(at), width_);
  const auto total = static_cast<double>(mass);
  const Vec2 off{static_cast<double>(along_x) / total, static_cast<double>(along_y) / total};
  particle.at_px = Vec2{static_cast<double>(at.column), static_cast<double>(at.row)} + off;
  particle.mass = greys_per_byte_ * total;
  return off;
}

// Moves of a round mask to its centroid ascend the density of a parabolic kernel (mean shift), so
// they end.
Peak ParticleFinder::moved(Peak at, Vec2 off, int move) const {
  const auto step = [&](double d) {
    const int pixels = std::abs(d) > move_from ? 1 : 0;
    const int all = move < single_steps ? pixels : std::max(pixels, static_cast<int>(std::abs(d)));
    return d > 0 ? all : -all;
  };
  return {std::clamp(at.column + step(off.x), radius_, width_ - 1 - radius_),
          std::clamp(at.row + step(off.y), radius_, height_ - 1 - radius_)};
}

void ParticleFinder::refine_peaks() {
  const int limit = params_.max_moves > 0 ? params_.max_moves : odd(params_.diameter) + 20;
  particles_.clear();
  settled_.clear();
  visited_.resize(static_cast<std::size_t>(width_) * height_);
  std::size_t kept = 0;
  for (const Peak& peak : peaks_) {
    Peak at{std::clamp(peak.column, radius_, width_ - 1 - radius_),
            std::clamp(peak.row, radius_, height_ - 1 - radius_)};
    Particle particle;
    const Walk end = refine(at, particle, limit);
    if (end == Walk::known || (is_large() && !is_inside(particle.at_px))) continue;
    peaks_[kept++] = at;
    settled_.push_back(end == Walk::stands);
    particles_.push_back(particle);
  }
  peaks_.resize(kept);
  for (const std::size_t pixel : path_) visited_[pixel] = 0;
  path_.clear();
}

ParticleFinder::Walk ParticleFinder::refine(Peak& at, Particle& particle, int limit) {
  const std::size_t first = path_.size();
  Walk end = Walk::moves;
  for (int move = 0;; ++move) {
    const std::size_t pixel = pixel_index(at);
    if (visited_[pixel] == by_another) end = Walk::known;
    const bool is_circle = visited_[pixel] == by_itself;
    if (end == Walk::known || is_circle) break;
    visited_[pixel] = by_itself;
    path_.push_back(pixel);
    const Peak next = moved(at, measure(at, particle), move);
    if (next == at) end = Walk::stands;
    if (end == Walk::stands || move + 1 >= limit) break;
    at = next;
  }
  for (std::size_t i = first; i < path_.size(); ++i) visited_[path_[i]] = by_another;
  return end;
}

// Several at once, since each sum waits for its last addition.
void ParticleFinder::describe(std::size_t first) {
  const std::size_t count = std::min(together, particles_.size() - first);
  std::array<const std::uint8_t*, together> middle{};
  for (std::size_t k = 0; k < together; ++k) {
    const Peak at = peaks_[first + std::min(k, count - 1)];
    middle[k] = bytes_.data() + pixel_index(at);
  }
  std::array<std::int64_t, together> mass{};
  std::array<std::int64_t, together> second_moment{};
  std::array<double, together> cosine{};
  std::array<double, together> sine{};
  std::array<int, together> highest{};
  for (const MaskPixel& m : mask_) {
    const std::ptrdiff_t offset = m.offset(width_);
    const int squared = m.dx * m.dx + m.dy * m.dy;
    for (std::size_t k = 0; k < together; ++k) {
      const int value = middle[k][offset];
      highest[k] = std::max(highest[k], value);
      mass[k] += value;
      second_moment[k] += static_cast<std::int64_t>(value) * squared;
      cosine[k] += value * m.cosine;
      sine[k] += value * m.sine;
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    Particle& particle = particles_[first + k];
    const auto total = static_cast<double>(mass[k]);
    particle.signal = greys_per_byte_ * highest[k];
    particle.gyration_px = std::sqrt(static_cast<double>(second_moment[k]) / total);
    particle.radius_px = std::numbers::sqrt2 * particle.gyration_px;
    particle.eccentricity = norm({cosine[k], sine[k]}) / std::max(1.0, total - *middle[k]);
  }
}

bool ParticleFinder::is_inside(Vec2 at_px) const {
  const double least = radius_ - 1;
  return std::min(at_px.x, at_px.y) >= least && at_px.x <= width_ - 1 - least &&
         at_px.y <= height_ - 1 - least;
}

// The mask at whole pixels cuts a flat disc that hardly fits into it on one side, and its centroid
// stays near the mask's centre. A mask between pixels, with a soft edge, does not. A spot that
// fades has little there, and such a mask would run after its noise and its neighbours.
void ParticleFinder::centre(Particle& particle, Peak at) const {
  const std::uint8_t* middle = bytes_.data() + pixel_index(at);
  std::int64_t mass = 0, squares = 0;
  int highest = 0;
  std::array<std::int64_t, octants> rim{}, rim_pixels{};
  for (const MaskPixel& m : mask_) {
    const int value = middle[m.offset(width_)];
    mass += value;
    squares += static_cast<std::int64_t>(value) * value;
    highest = std::max(highest, value);
    if (m.dx * m.dx + m.dy * m.dy <= (radius_ - 1) * (radius_ - 1)) continue;
    const std::size_t k = octant(m.dx, m.dy);
    rim[k] += value;
    ++rim_pixels[k];
  }
  // The level of a particle is the mean grey of its mass. A neighbour is at the rim too, but only
  // on its side.
  const double level = static_cast<double>(squares) / static_cast<double>(mass);
  std::size_t cut = 0;
  for (std::size_t k = 0; k < octants; ++k)
    if (static_cast<double>(rim[k]) > cut_level * level * static_cast<double>(rim_pixels[k])) ++cut;
  const bool is_cut = cut > octants / 2 && level > flat_level * highest;
  if (!is_cut && !is_large()) return;
  std::array<double, 256> weights{};
  for (std::size_t v = 0; v < weights.size(); ++v) {
    const auto value = static_cast<double>(v);
    weights[v] = is_large()
                     ? std::clamp((value / level - edge_low) / (edge_high - edge_low), 0.0, 1.0)
                     : value;
  }
  if (!is_cut) {
    double total = 0;
    Vec2 sum;
    for (const MaskPixel& m : mask_) {
      const double weight = weights[middle[m.offset(width_)]];
      total += weight;
      sum += weight * Vec2{1.0 * m.dx, 1.0 * m.dy};
    }
    particle.at_px = Vec2{1.0 * at.column, 1.0 * at.row} + sum / total;
    return;
  }
  Vec2 centre = particle.at_px;
  for (int round = 0; round < max_soft_rounds; ++round) {
    const Vec2 next = soft_centroid(centre, weights);
    const double moved_by = distance(next, centre);
    if (distance(next, particle.at_px) > far_from_mask) return;  // it runs to a neighbour
    centre = next;
    if (moved_by < settled_move) break;
  }
  particle.at_px = centre;
}

Vec2 ParticleFinder::soft_centroid(Vec2 centre, const std::array<double, 256>& weights) const {
  const int reach = radius_ + 1;
  const auto around_x = static_cast<int>(std::lround(centre.x));
  const auto around_y = static_cast<int>(std::lround(centre.y));
  double total = 0;
  Vec2 sum;
  for (int y = std::max(0, around_y - reach); y <= std::min(height_ - 1, around_y + reach); ++y)
    for (int x = std::max(0, around_x - reach); x <= std::min(width_ - 1, around_x + reach); ++x) {
      const Vec2 off = Vec2{1.0 * x, 1.0 * y} - centre;
      const double inside = std::clamp(radius_ + 0.5 - norm(off), 0.0, 1.0);
      const double weight = inside * weights[bytes_[pixel_index({x, y})]];
      total += weight;
      sum += weight * off;
    }
  return total > 0 ? centre + beyond / total * sum : centre;
}

void ParticleFinder::fit_rings(const formats::Image& grey) {
  for (Particle& particle : particles_) {
    const auto ring = fit_ring(grey, particle.at_px, radius_, params_.tone == ParticleTone::bright);
    if (!ring) continue;
    particle.at_px = ring->centre_px;
    particle.radius_px = ring->radius_px;
  }
}

/// Keeps what is heavy enough and not too close to something heavier.
void ParticleFinder::keep_apart() {
  std::vector<std::size_t> order(particles_.size());
  std::iota(order.begin(), order.end(), 0);
  const auto y = [&](std::size_t i) { return particles_[i].at_px.y; };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return y(a) < y(b); });
  std::vector<bool> dropped(particles_.size()), crowded(particles_.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const Particle& a = particles_[order[i]];
      const Particle& b = particles_[order[k]];
      if (b.at_px.y - a.at_px.y >= separation_) break;
      if (squared_norm(b.at_px - a.at_px) >= separation_ * separation_) continue;
      const std::size_t lighter = order[a.mass < b.mass ? i : k];
      dropped[lighter] = true;
      const bool is_neighbour =
          settled_[lighter] && squared_norm(b.at_px - a.at_px) > radius_ * radius_ &&
          std::min(a.mass, b.mass) > std::max(params_.min_mass, 0.5 * std::max(a.mass, b.mass));
      if (is_neighbour) crowded[lighter] = true;
    }
  crowded_ = static_cast<int>(std::count(crowded.begin(), crowded.end(), true));
  std::size_t kept = 0;
  unsettled_ = 0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    if (dropped[i] || particles_[i].mass <= params_.min_mass) continue;
    if (!settled_[i]) ++unsettled_;
    peaks_[kept] = peaks_[i];
    particles_[kept++] = particles_[i];
  }
  particles_.resize(kept);
}

}  // namespace microswarm::vision

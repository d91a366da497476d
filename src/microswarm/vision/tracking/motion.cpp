// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/maths/statistics.hpp"

namespace microswarm::vision {
namespace {

constexpr int max_lag = 1000;

using TracksById = std::map<int, std::vector<const TrackRow*>>;

TracksById by_id(std::span<const TrackRow> rows) {
  TracksById tracks;
  for (const TrackRow& row : rows) tracks[row.id].push_back(&row);
  return tracks;
}

/// Sum of squared displacements of a track at each lag up to `most`, and their number.
struct LagSums {
  std::vector<double> squares;
  std::vector<double> times;
  std::vector<int> count;
};

/// Median time between pictures in which robots are seen [s]; 0 for a single one.
double usual_interval(std::span<const TrackRow> rows) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i].frame > rows[i - 1].frame)
      intervals.push_back((rows[i].t - rows[i - 1].t) / (rows[i].frame - rows[i - 1].frame));
  return intervals.empty() ? 0 : median(intervals);
}

LagSums lag_sums(const std::vector<const TrackRow*>& track, int most, double interval) {
  const auto lags = static_cast<std::size_t>(most) + 1;
  LagSums sums{std::vector<double>(lags), std::vector<double>(lags), std::vector<int>(lags)};
  for (std::size_t i = 0; i < track.size(); ++i)
    for (std::size_t k = i + 1; k < track.size(); ++k) {
      const double elapsed = track[k]->t - track[i]->t;
      const double lag_of_time = std::round(elapsed / interval);
      if (lag_of_time > most) break;
      const int lag = static_cast<int>(lag_of_time);
      if (lag == 0) continue;
      sums.squares[static_cast<std::size_t>(lag)] +=
          squared_norm(track[k]->position - track[i]->position);
      sums.times[static_cast<std::size_t>(lag)] += elapsed;
      ++sums.count[static_cast<std::size_t>(lag)];
    }
  return sums;
}

}  // namespace

std::vector<DriftRow> drift_of(std::span<const TrackRow> rows) {
  std::vector<DriftRow> drift;
  std::map<int, const TrackRow*> last;
  Vec2 sum;
  for (std::size_t i = 0; i < rows.size();) {
    DriftRow now{.frame = rows[i].frame, .t = rows[i].t};
    Vec2 moved;
    for (; i < rows.size() && rows[i].frame == now.frame; ++i) {
      const TrackRow*& before = last[rows[i].id];
      if (before && before->frame + 1 == now.frame) {
        moved += rows[i].position - before->position;
        ++now.robots;
      }
      before = &rows[i];
    }
    if (now.robots > 0) sum += moved / now.robots;
    now.drift = sum;
    drift.push_back(now);
  }
  return drift;
}

void subtract_drift(std::vector<TrackRow>& rows, std::span<const DriftRow> drift,
                    double um_per_px) {
  std::size_t k = 0;
  for (TrackRow& row : rows) {
    while (k + 1 < drift.size() && drift[k + 1].frame <= row.frame) ++k;
    if (k >= drift.size() || drift[k].frame > row.frame) continue;
    row.position -= drift[k].drift;
    row.at_px -= Vec2{drift[k].drift.x, -drift[k].drift.y} / um_per_px;
  }
}

std::vector<MsdRow> mean_squared_displacements(std::span<const TrackRow> rows) {
  const TracksById tracks = by_id(rows);
  const double interval = usual_interval(rows);
  double longest = 0;
  for (const auto& [id, track] : tracks)
    longest = std::max(longest, track.back()->t - track.front()->t);
  if (!(interval > 0) || longest <= 0) return {};
  const double lags = std::floor(longest / interval * (1 + 1e-9)) / 4;
  const int most = static_cast<int>(std::clamp<double>(lags, 1, max_lag));
  std::vector<LagSums> sums;
  sums.reserve(tracks.size());
  for (const auto& [id, track] : tracks) sums.push_back(lag_sums(track, most, interval));
  std::vector<MsdRow> msd;
  for (int lag = 1; lag <= most; ++lag) {
    const auto at = static_cast<std::size_t>(lag);
    MsdRow row{.lag = lag};
    double squares = 0;
    for (const LagSums& s : sums) {
      squares += s.squares[at];
      row.t += s.times[at];
      row.displacements += s.count[at];
      row.tracks += s.count[at] > 0;
    }
    if (row.displacements == 0) continue;
    row.msd = squares / row.displacements;
    row.t /= row.displacements;
    double spread = 0;
    for (const LagSums& s : sums) spread += maths::power(s.squares[at] - s.count[at] * row.msd, 2);
    if (row.tracks > 1)
      row.standard_error = std::sqrt(spread * row.tracks / (row.tracks - 1)) / row.displacements;
    msd.push_back(row);
  }
  return msd;
}

std::optional<PowerLaw> fit_power_law(std::span<const MsdRow> rows) {
  const std::size_t used = std::min<std::size_t>(10, std::max<std::size_t>(2, rows.size() / 3));
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const MsdRow& row : rows.first(std::min(used, rows.size()))) {
    if (row.msd <= 0) continue;
    const double u = maths::log(row.t);
    const double v = maths::log(row.msd);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  if (n < 2) return std::nullopt;
  const double exponent = (n * xy - x * y) / (n * xx - x * x);
  return PowerLaw{exponent, maths::exp((y - exponent * x) / n) / 4, static_cast<int>(n)};
}

std::vector<MotionRow> motion_of_each(std::span<const TrackRow> rows) {
  std::vector<MotionRow> motions;
  for (const auto& [id, track] : by_id(rows)) {
    MotionRow motion{.id = id,
                     .first_frame = track.front()->frame,
                     .frames = static_cast<int>(track.size()),
                     .duration = track.back()->t - track.front()->t,
                     .net = distance(track.back()->position, track.front()->position)};
    for (std::size_t i = 1; i < track.size(); ++i)
      motion.path += distance(track[i]->position, track[i - 1]->position);
    if (motion.duration > 0) motion.speed = motion.path / motion.duration;
    if (motion.path > 0) motion.straight = motion.net / motion.path;
    motions.push_back(motion);
  }
  return motions;
}

PixelBias pixel_bias(std::span<const TrackRow> rows) {
  constexpr double least = 0.2;          // of the mean cosine that matters
  constexpr double deviations = 5;       // of chance
  constexpr std::size_t min_count = 50;  // positions
  PixelBias bias;
  for (const auto& [id, track] : by_id(rows)) {
    const TrackRow* last = nullptr;
    for (const TrackRow* row : track) {
      if (last && distance(row->at_px, last->at_px) < 1) continue;
      last = row;
      bias.fractions_x.push_back(row->at_px.x - std::floor(row->at_px.x));
      bias.fractions_y.push_back(row->at_px.y - std::floor(row->at_px.y));
    }
  }
  const auto count = static_cast<double>(bias.fractions_x.size());
  if (count == 0) return bias;
  double sum = 0;
  for (const auto* fractions : {&bias.fractions_x, &bias.fractions_y})
    for (const double f : *fractions) sum += maths::cos(2 * pi * f);
  bias.cling = sum / (2 * count);
  // A cosine has the variance 1/2, the mean of 2 count of them 1/(4 count).
  bias.is_significant = bias.fractions_x.size() >= min_count &&
                        std::abs(bias.cling) > std::max(least, 0.5 * deviations / std::sqrt(count));
  return bias;
}

}  // namespace microswarm::vision

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/mass_gap.hpp"

#include <algorithm>
#include <cmath>

#include "microswarm/core/maths/infinity.hpp"
#include "microswarm/core/maths/maths.hpp"

namespace microswarm::vision {
namespace {

constexpr double kernel = 0.05;         // [decades] standard deviation of the smoothing
constexpr double gap_depth = 0.25;      // of a gap, beside the lower of its sides
constexpr double min_width = 0.15;      // [decades] of a gap
constexpr double wide_gap = 0.5;        // [decades] of a gap that pairs of robots cannot make
constexpr double rare = 0.01;           // share of all features that outliers have at most
constexpr double enough_robots = 0.25;  // beside lighter features that have a tone
constexpr double min_count = 3;         // features on either side
constexpr double clear_ratio =
    10;                           // ratio of masses from which fewer will do, as of one large robot
constexpr double toneless = 0.3;  // share of the other tone's features from which it is noise

struct Gap {
  std::size_t from, to;  // bins
};

/// The widest gap at the bin of a minimum: where the density is low beside the maxima of both
/// sides.
std::optional<Gap> gap_at(const std::vector<double>& density, std::size_t at) {
  const auto middle = density.begin() + static_cast<std::ptrdiff_t>(at);
  const double low = gap_depth * std::min(*std::max_element(density.begin(), middle),
                                          *std::max_element(middle, density.end()));
  if (density[at] >= low) return std::nullopt;
  Gap gap{at, at};
  while (gap.from > 0 && density[gap.from - 1] < low) --gap.from;
  while (gap.to + 1 < density.size() && density[gap.to + 1] < low) ++gap.to;
  if (gap.from == 0 || gap.to + 1 == density.size()) return std::nullopt;
  if (static_cast<double>(gap.to - gap.from) * MassDensity::step < min_width) return std::nullopt;
  return gap;
}

double count_between(const std::vector<double>& sorted, double from, double to) {
  return static_cast<double>(std::lower_bound(sorted.begin(), sorted.end(), to) -
                             std::lower_bound(sorted.begin(), sorted.end(), from));
}

/// Whether features of the other tone are about as frequent among the masses of a kind.
bool is_noise(const std::vector<double>& masses, const std::vector<double>& other, double from,
              double to) {
  constexpr double slack = 1.1;  // factor of a mass
  const auto begin = std::lower_bound(masses.begin(), masses.end(), from);
  const auto end = std::lower_bound(masses.begin(), masses.end(), to);
  if (end == begin) return false;
  return count_between(other, *begin / slack, *(end - 1) * slack) >=
         toneless * static_cast<double>(end - begin);
}

}  // namespace

double MassGap::min_mass() const { return std::sqrt(noise_to * robots_from); }

MassDensity mass_density(std::span<const double> masses) {
  MassDensity result;
  std::vector<double> logs;
  for (const double mass : masses)
    if (mass > 0) logs.push_back(maths::log10(mass));
  if (logs.empty()) return result;
  const auto [least, most] = std::minmax_element(logs.begin(), logs.end());
  constexpr double margin = 4 * kernel;
  result.first = *least - margin;
  const auto bins =
      static_cast<std::size_t>(std::ceil((*most - *least + 2 * margin) / MassDensity::step)) + 1;
  std::vector<double> counts(bins, 0);
  for (const double log : logs)
    counts[static_cast<std::size_t>(std::lround((log - result.first) / MassDensity::step))] += 1;
  result.density.assign(bins, 0);
  const int reach = static_cast<int>(std::ceil(margin / MassDensity::step));
  for (int i = 0; i < static_cast<int>(bins); ++i) {
    const double count = counts[static_cast<std::size_t>(i)];
    if (count == 0) continue;
    for (int k = std::max(0, i - reach); k <= std::min(static_cast<int>(bins) - 1, i + reach);
         ++k) {
      const double off = (k - i) * MassDensity::step / kernel;
      result.density[static_cast<std::size_t>(k)] += count * maths::exp(-0.5 * off * off);
    }
  }
  return result;
}

MassKinds mass_kinds(std::span<const double> masses, std::span<const double> other, int pictures) {
  MassKinds kinds;
  std::vector<double> sorted(masses.begin(), masses.end());
  std::vector<double> sorted_other(other.begin(), other.end());
  std::sort(sorted.begin(), sorted.end());
  std::sort(sorted_other.begin(), sorted_other.end());
  const auto [first, density] = mass_density(masses);
  const auto bin_mass = [first = first](std::size_t bin) {
    return maths::pow(10.0, first + static_cast<double>(bin) * MassDensity::step);
  };
  const double enough = std::max(min_count, 0.5 * pictures);
  std::vector<MassGap> gaps;
  for (std::size_t at = 1; at + 1 < density.size(); ++at) {
    const auto gap = gap_at(density, at);
    if (!gap) continue;
    at = gap->to;
    const MassGap found{bin_mass(gap->from), bin_mass(gap->to)};
    const double from = gaps.empty() ? 0 : gaps.back().robots_from;
    const bool is_clear = found.robots_from > clear_ratio * found.noise_to;
    if (count_between(sorted, from, found.noise_to) >= (is_clear ? 1 : enough) &&
        count_between(sorted, found.robots_from, infinity) >=
            (is_clear ? std::max(1.0, 0.5 * pictures) : enough))
      gaps.push_back(found);
  }
  // Kinds of noise come first. Beyond a wide gap are no pairs: what is before it is an outlier of
  // the noise if it is rare, or else faint features of the robots' own pictures.
  const auto width = [](const MassGap& gap) {
    return maths::log10(gap.robots_from / gap.noise_to);
  };
  double from = 0;
  for (const MassGap& gap : gaps) {
    const double below = count_between(sorted, from, gap.noise_to);
    const double above = count_between(sorted, gap.robots_from, infinity);
    const bool is_wide = width(gap) > std::max(wide_gap, kinds.gap ? width(*kinds.gap) : 0);
    const bool hides = kinds.gap ? below <= rare * static_cast<double>(sorted.size())
                                 : above >= enough_robots * below;
    if (is_noise(sorted, sorted_other, from, gap.noise_to) || (is_wide && hides)) kinds.gap = gap;
    from = gap.robots_from;
  }
  kinds.has_noise = kinds.gap.has_value();
  const double last = kinds.gap ? kinds.gap->robots_from : 0;
  // What lies beyond a wide gap is robots, though bright ones may have dark rings and as many.
  if (!(kinds.gap && width(*kinds.gap) > wide_gap) &&
      is_noise(sorted, sorted_other, last, infinity)) {
    kinds.has_noise = true;
    kinds.gap.reset();  // all of them are noise
  }
  return kinds;
}

}  // namespace microswarm::vision

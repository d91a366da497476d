// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/tracking/particle_suggestion.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "microswarm/core/maths/statistics.hpp"

namespace microswarm::vision {
namespace {

constexpr int max_rounds = 6;        // until the diameter fits itself
constexpr double edge_level = 0.1;   // of the strongest contrast, at the edge of a robot
constexpr double certain = 5;        // of a contrast, in standard errors
constexpr double heavier = 1.5;      // mass of robots of the other tone, if they are the robots
constexpr double max_robots = 2000;  // from which the mean picture is taken
constexpr double max_pixels = 2e7;   // of mean pictures, and of those that are compared
constexpr double max_compared = 8;   // pictures, for each diameter

struct Features {
  std::vector<double> masses;
  std::vector<std::pair<std::size_t, Particle>> particles;  // with their picture
};

Features find_features(std::span<const formats::Image> pictures, ParticleParams params) {
  params.min_mass = 0;
  params.shape = ParticleShape::spot;
  ParticleFinder finder(params);
  Features all;
  for (std::size_t k = 0; k < pictures.size(); ++k)
    for (const Particle& particle : finder.find(pictures[k])) {
      all.masses.push_back(particle.mass);
      all.particles.push_back({k, particle});
    }
  return all;
}

ParticleTone other(ParticleTone tone) {
  return tone == ParticleTone::dark ? ParticleTone::bright : ParticleTone::dark;
}

/// Mean greys around robots, by the distance from their centres in pixels, and the error of each.
struct Profile {
  std::vector<double> grey;
  std::vector<double> error;
  std::vector<double> pixels;
};

Profile make_profile(std::span<const formats::Image> pictures, const Features& features,
                     double min_mass, int reach) {
  const auto rings = static_cast<std::size_t>(reach) + 1;
  std::vector<double> sum(rings), squares(rings), count(rings);
  const auto area = 4.0 * reach * reach;
  const auto most = static_cast<std::size_t>(std::clamp(max_pixels / area, 4.0, max_robots));
  std::size_t robots = 0;
  for (const auto& [k, particle] : features.particles) {
    if (particle.mass <= min_mass) continue;
    if (++robots > most) break;
    const formats::Image& picture = pictures[k];
    const int x = static_cast<int>(std::lround(particle.at_px.x));
    const int y = static_cast<int>(std::lround(particle.at_px.y));
    for (int row = std::max(0, y - reach); row <= std::min(picture.height - 1, y + reach); ++row)
      for (int column = std::max(0, x - reach); column <= std::min(picture.width - 1, x + reach);
           ++column) {
        const double r = distance(particle.at_px, Vec2{1.0 * column, 1.0 * row});
        const auto ring = static_cast<std::size_t>(r);
        if (ring >= rings) continue;
        const double grey = picture.pixels[picture.index(column, row)];
        sum[ring] += grey;
        squares[ring] += grey * grey;
        count[ring] += 1;
      }
  }
  Profile profile;
  for (std::size_t r = 0; r < rings && count[r] > 0; ++r) {
    const double mean = sum[r] / count[r];
    profile.grey.push_back(mean);
    profile.error.push_back(
        std::sqrt(std::max(0.0, squares[r] / count[r] - mean * mean) / count[r]));
    profile.pixels.push_back(count[r]);
  }
  return profile;
}

/// A robot as its mean picture shows it.
struct MeanRobot {
  int diameter = 0;
  double energy = 0;  ///< squared contrasts, summed over the pixels of all robots
};

/// The diameter ends where the mean grey comes to stay at that of the background, which is the
/// median from there to twice the radius; with a tenth more.
std::optional<MeanRobot> mean_robot(const Profile& profile) {
  const std::vector<double>& grey = profile.grey;
  for (std::size_t edge = 2; 2 * edge < grey.size(); ++edge) {
    const double ground = median({grey.begin() + static_cast<std::ptrdiff_t>(edge + 1),
                                  grey.begin() + static_cast<std::ptrdiff_t>(2 * edge + 1)});
    const auto off = [&](std::size_t r) { return std::abs(grey[r] - ground); };
    std::size_t best = 0;
    for (std::size_t r = 0; r < edge; ++r)
      if (off(r) > off(best)) best = r;
    if (off(best) < std::max(1.0, certain * profile.error[best])) continue;
    const std::size_t beyond = std::min(grey.size() - 1, edge + std::max<std::size_t>(2, edge / 3));
    std::size_t r = edge;
    while (r <= beyond && off(r) < edge_level * off(best)) ++r;
    if (r <= beyond) continue;
    MeanRobot robot{.diameter = static_cast<int>(2 * (edge + edge / 10) + 1)};
    for (r = 0; r < edge; ++r) robot.energy += profile.pixels[r] * off(r) * off(r);
    return robot;
  }
  return std::nullopt;  // it is larger than what is seen of it
}

/// Median mass of what lies above the gap, or of all if there is no noise; 0 if all may be noise.
double robot_mass(const std::vector<double>& masses, const MassKinds& kinds) {
  if (!kinds.gap) return kinds.has_noise ? 0 : median(masses);
  std::vector<double> robots;
  std::copy_if(masses.begin(), masses.end(), std::back_inserter(robots),
               [&](double mass) { return mass > kinds.gap->min_mass(); });
  return median(std::move(robots));
}

}  // namespace

double ParticleSuggestion::heavier_than(double mass) const {
  const auto heavier =
      std::count_if(masses.begin(), masses.end(), [&](double m) { return m > mass; });
  return pictures > 0 ? static_cast<double>(heavier) / pictures : 0;
}

namespace {

/// Chooses tone and minimum mass for the diameter of `best`; returns the features.
Features choose_mass(std::span<const formats::Image> pictures, const ParticleParams& given,
                     ParticleSuggestion& best) {
  best.pictures = static_cast<int>(pictures.size());
  ParticleParams reverse = best.params;
  reverse.tone = other(reverse.tone);
  Features features = find_features(pictures, best.params);
  Features opposite = find_features(pictures, reverse);
  best.kinds = mass_kinds(features.masses, opposite.masses, best.pictures);
  const MassKinds there = mass_kinds(opposite.masses, features.masses, best.pictures);
  if (robot_mass(opposite.masses, there) > heavier * robot_mass(features.masses, best.kinds)) {
    std::swap(features, opposite);
    best.params = reverse;
    best.kinds = there;
  }
  best.params.min_mass = best.kinds.gap ? best.kinds.gap->min_mass() : given.min_mass;
  best.masses = features.masses;
  best.other_masses = opposite.masses;
  return features;
}

struct Fit {
  ParticleParams params;
  double energy = 0;
};

/// From a first diameter to one that fits itself: whose robots are as large in their mean picture.
std::optional<Fit> fit_diameter(std::span<const formats::Image> pictures,
                                const ParticleParams& given, int diameter, int largest) {
  ParticleSuggestion now{.params = given};
  now.params.diameter = diameter;
  for (int round = 0; round < max_rounds; ++round) {
    const Features features = choose_mass(pictures, given, now);
    if (!now.kinds.gap && now.kinds.has_noise) return std::nullopt;
    const int odd = now.params.diameter | 1;
    const auto seen = mean_robot(make_profile(pictures, features, now.params.min_mass, 2 * odd));
    if (!seen || seen->diameter > largest || seen->diameter <= now.params.noise)
      return std::nullopt;
    if (std::abs(seen->diameter - odd) <= std::max(2, odd / 20))
      return Fit{now.params, seen->energy};
    now.params.diameter = seen->diameter;
  }
  return std::nullopt;
}

/// Pictures that suffice to compare diameters.
std::vector<formats::Image> some(std::span<const formats::Image> pictures) {
  const auto pixels = static_cast<double>(pictures[0].pixels.size());
  const auto most =
      static_cast<std::size_t>(std::clamp(max_pixels / std::max(1.0, pixels), 2.0, max_compared));
  const std::size_t step = (pictures.size() + most - 1) / most;
  std::vector<formats::Image> chosen;
  for (std::size_t i = 0; i < pictures.size(); i += step) chosen.push_back(pictures[i]);
  return chosen;
}

}  // namespace

ParticleSuggestion suggest_particles(std::span<const formats::Image> pictures,
                                     const ParticleParams& given) {
  ParticleSuggestion best{.params = given};
  if (pictures.empty()) return best;
  const std::vector<formats::Image> compared = some(pictures);
  const int largest = std::min(1001, 7 * std::min(pictures[0].width, pictures[0].height) / 10);
  std::vector<int> starts{given.diameter};
  for (int start = 7; start <= largest; start = 3 * start / 2 | 1) starts.push_back(start);
  std::optional<Fit> fit;
  for (const int start : starts) {
    if (start <= given.noise) continue;
    const auto next = fit_diameter(compared, given, start, largest);
    if (next && (!fit || next->energy > fit->energy)) fit = next;
  }
  // Without one that fits itself the given diameter is kept.
  best.knows_diameter = fit.has_value();
  if (fit) best.params = fit->params;
  choose_mass(pictures, given, best);
  return best;
}

}  // namespace microswarm::vision

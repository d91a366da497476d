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

constexpr int max_rounds = 6;       // until the diameter fits itself
constexpr double edge_level = 0.1;  // of the strongest contrast, at the edge of a robot
constexpr double certain = 5;       // of a contrast, in standard errors
constexpr double heavier = 1.5;     // mass of robots of the other tone, if they are the robots
constexpr std::size_t max_robots = 2000;  // from which the mean picture is taken

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
};

Profile make_profile(std::span<const formats::Image> pictures, const Features& features,
                     double min_mass, int reach) {
  const auto rings = static_cast<std::size_t>(reach) + 1;
  std::vector<double> sum(rings), squares(rings), count(rings);
  std::size_t robots = 0;
  for (const auto& [k, particle] : features.particles) {
    const formats::Image& picture = pictures[k];
    const int x = static_cast<int>(std::lround(particle.at_px.x));
    const int y = static_cast<int>(std::lround(particle.at_px.y));
    if (particle.mass <= min_mass || x < reach || y < reach || x >= picture.width - reach ||
        y >= picture.height - reach || ++robots > max_robots)
      continue;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const double r = distance(particle.at_px, Vec2{1.0 * (x + dx), 1.0 * (y + dy)});
        const auto ring = static_cast<std::size_t>(std::lround(r));
        if (ring >= rings) continue;
        const double grey = picture.pixels[picture.index(x + dx, y + dy)];
        sum[ring] += grey;
        squares[ring] += grey * grey;
        count[ring] += 1;
      }
  }
  Profile profile;
  for (std::size_t r = 0; r < rings && count[r] > 1; ++r) {
    const double mean = sum[r] / count[r];
    profile.grey.push_back(mean);
    profile.error.push_back(
        std::sqrt(std::max(0.0, squares[r] / count[r] - mean * mean) / count[r]));
  }
  return profile;
}

/// Diameter of a robot: from where on the mean grey remains that of the background.
std::optional<int> best_diameter(const Profile& profile) {
  const std::size_t rings = profile.grey.size();
  if (rings < 6) return std::nullopt;
  const std::size_t far = 2 * rings / 3;
  const double ground =
      median({profile.grey.begin() + static_cast<std::ptrdiff_t>(far), profile.grey.end()});
  const auto off = [&](std::size_t r) { return std::abs(profile.grey[r] - ground); };
  double strongest = 0;
  double error = 0;
  for (std::size_t r = 0; r < far; ++r)
    if (off(r) > strongest) {
      strongest = off(r);
      error = profile.error[r];
    }
  if (strongest < certain * error || strongest < 1) return std::nullopt;
  std::size_t edge = far;
  while (edge > 0 && off(edge - 1) < edge_level * strongest) --edge;
  if (edge == far) return std::nullopt;  // it is larger than what is seen of it
  return static_cast<int>(2 * edge + 1);
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

ParticleSuggestion suggest_particles(std::span<const formats::Image> pictures,
                                     const ParticleParams& params) {
  ParticleSuggestion best{.params = params};
  best.pictures = static_cast<int>(pictures.size());
  if (pictures.empty()) return best;
  const int largest = std::min(pictures[0].width, pictures[0].height) / 4;
  for (int round = 0; round < max_rounds; ++round) {
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
    best.params.min_mass = best.kinds.gap ? best.kinds.gap->min_mass() : params.min_mass;
    best.masses = features.masses;
    best.other_masses = opposite.masses;
    const int now = best.params.diameter | 1;
    if (!best.kinds.gap && best.kinds.has_noise) break;  // the mean picture is that of noise
    const auto seen =
        best_diameter(make_profile(pictures, features, best.params.min_mass, 2 * now));
    best.knows_diameter = seen.has_value();
    const int next = seen.value_or(2 * now - 1);
    if (seen && std::abs(next - now) <= 2) return best;
    if (next > largest || round + 1 == max_rounds) break;
    best.params.diameter = next;
  }
  // No diameter fits itself: the given one is kept.
  best.knows_diameter = false;
  if (best.params.diameter == params.diameter) return best;
  best.params.diameter = params.diameter;
  const Features features = find_features(pictures, best.params);
  ParticleParams reverse = best.params;
  reverse.tone = other(reverse.tone);
  best.masses = features.masses;
  best.other_masses = find_features(pictures, reverse).masses;
  best.kinds = mass_kinds(best.masses, best.other_masses, best.pictures);
  best.params.min_mass = best.kinds.gap ? best.kinds.gap->min_mass() : params.min_mass;
  return best;
}

}  // namespace microswarm::vision

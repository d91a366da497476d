// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/rig/identify/response_data.hpp"

namespace microswarm::rig {

/// An estimate and its standard error.
struct Estimate {
  double value = 0;
  double error = 0;
};

/// Response of a swarm to its commands, beside what the rig's file says.
struct ResponseFit {
  Estimate gain{};       ///< distance moved over distance commanded
  Estimate angle{};      ///< direction of the motion against the command, counter-clockwise [rad]
  Estimate delay{};      ///< time from a command to its motion in the pictures [s]
  Vec2 drift{};          ///< motion without command [µm/s]
  double residual = 0;   ///< RMS distance of the sightings from the fitted path [µm]
  double explained = 0;  ///< share of the variance of the sightings that the fit explains
  double driven = 0;     ///< commanded distance [µm]
  double from = 0;       ///< start of the section that was fitted [s]
  double until = 0;      ///< its end [s]
  std::size_t sightings = 0;
  std::vector<Sighting> path{};  ///< the fitted path at the sightings
};

/// Fits gain, angle and delay by least squares to the longest section that was driven at the usual
/// frequency: seen(t) = p + v t + gain · R(angle) · driven(t − delay), with a constant drift v.
/// Standard errors allow for residuals that depend on the one before. Nothing if fewer than 20
/// sightings or no motion was commanded.
std::optional<ResponseFit> fit_response(const ResponseData& data);

/// Reasons why a fit is too poor for its values to be used, one line each; empty if it is good.
std::vector<std::string> doubts(const ResponseFit& fit);

/// Speed at one frequency relative to the commanded one.
struct FrequencyLevel {
  double frequency = 0;  ///< [Hz]
  Estimate share{};      ///< distance moved along the usual direction over distance commanded
};

/// Frequencies of a sweep between which the swarm begins to fall behind.
struct StepOut {
  std::vector<FrequencyLevel> levels{};  ///< in the order of frequency
  std::optional<double> followed{};      ///< largest frequency that was followed [Hz]
  std::optional<double> lost{};          ///< smallest frequency above it that was not [Hz]
};

/// Share of the best level below which the swarm does not follow: it is reached at 1.05 times the
/// step-out frequency for a body that slips.
inline constexpr double followed_share = 0.7;

/// Speeds at the frequencies of the sweep that follows the fitted section. Levels of less than 0.5
/// s are left out. No levels without a sweep.
StepOut fit_step_out(const ResponseData& data, const ResponseFit& fit);

}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/scene/swarm_criteria.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>

#include "microswarm/core/maths/maths.hpp"

namespace microswarm::vision {
namespace {

constexpr double view_share = 0.2;  // of the picture, from which a cut region may be the background

bool lies_in(const Blob& blob, const Blob& other) {
  return distance(blob.centre_px, other.centre_px) < std::max(blob.radius_px, other.radius_px);
}

/// Criterion that excludes a blob that is too small, too large or too smooth.
NotSwarm refused(Blob blob, const SceneParams& params, const SwarmPrior& prior, bool smooth_count) {
  const BlobParams& look = params.swarm.look;
  NotSwarm no{.blob = std::move(blob)};
  const Blob& b = no.blob;
  const auto set = [&](SwarmCriterion criterion, double value, double limit, const char* key) {
    no.criterion = criterion;
    no.value = value;
    no.limit = limit;
    no.key = key;
  };
  if (b.radius_px < look.min_radius)
    set(SwarmCriterion::min_radius, b.radius_px, look.min_radius, "scene.swarm.look.min_radius_px");
  else if (b.radius_px > look.max_radius)
    set(SwarmCriterion::max_radius, b.radius_px, look.max_radius, "scene.swarm.look.max_radius_px");
  else if (!smooth_count)
    set(SwarmCriterion::texture, b.texture, look.min_texture, "scene.swarm.look.min_texture");
  else if (b.is_cut)
    set(SwarmCriterion::whole, b.texture, look.min_texture, "scene.swarm.look.min_texture");
  else if (b.radius_px < prior.min_radius_px || b.radius_px > prior.max_radius_px)
    set(SwarmCriterion::expected, b.radius_px,
        b.radius_px < prior.min_radius_px ? prior.min_radius_px : prior.max_radius_px,
        "radius_tolerance");  // of PerceptionParams
  else if (!fits(b, params, prior))
    set(SwarmCriterion::distance, distance(b.centre_px, *prior.at_px), params.swarm.jump,
        "scene.swarm.jump_px");
  else
    set(SwarmCriterion::alone, b.texture, look.min_texture, "scene.swarm.look.min_texture");
  return no;
}

/// Why a blob that looks like a swarm is no candidate.
NotSwarm outranked(const Blob& blob, const SeenScene& scene, const SceneParams& params,
                   const SwarmPrior& prior) {
  const double off = prior.at_px ? distance(blob.centre_px, *prior.at_px) : 0;
  if (off > params.swarm.jump)
    return {blob, SwarmCriterion::distance, off, params.swarm.jump, "scene.swarm.jump_px"};
  const double largest = scene.swarm.candidates.front().radius_px;
  return {blob, SwarmCriterion::rival, maths::power(blob.radius_px / largest, 2),
          params.swarm.rival, "scene.swarm.rival"};
}

}  // namespace

std::vector<NotSwarm> why_not_swarm(const SeenScene& scene, const formats::Image& picture,
                                    const SceneParams& params, const SwarmPrior& prior,
                                    const formats::Mask* walls) {
  const bool is_found = scene.swarm.sight == SwarmSight::found;
  const bool smooth_count = scene.swarm.sight == SwarmSight::none && params.smooth_swarm;
  std::vector<NotSwarm> all;
  std::vector<Blob> left;
  find_blobs(picture, params.swarm.look, walls, &left);
  for (Blob& blob : left)
    if (!is_found || !lies_in(blob, *scene.swarm.swarm))
      all.push_back(refused(std::move(blob), params, prior, smooth_count));
  for (const Blob& blob : scene.swarm.others) all.push_back(outranked(blob, scene, params, prior));
  if (is_found || scene.swarm.sight == SwarmSight::several) return all;

  const auto is_new = [&](const Blob& blob) {
    return std::none_of(all.begin(), all.end(),
                        [&](const NotSwarm& other) { return lies_in(blob, other.blob); });
  };
  BlobParams any = params.swarm.look;
  any.min_texture = 0;
  any.max_radius = 1e4;
  any.min_contrast = 1;
  for (Blob& blob : find_blobs(picture, any, walls))
    if (is_new(blob) && blob.contrast < params.swarm.look.min_contrast)
      all.push_back({blob, SwarmCriterion::contrast, blob.contrast, params.swarm.look.min_contrast,
                     "scene.swarm.look.min_contrast"});
  any.min_contrast = params.swarm.look.min_contrast;
  any.tone = any.tone == ParticleTone::dark ? ParticleTone::bright : ParticleTone::dark;
  const double view = static_cast<double>(picture.width) * picture.height;
  for (Blob& blob : find_blobs(picture, any, walls)) {
    if (!is_new(blob)) continue;
    // The light is fitted to what covers most of the picture: the rest has the other tone then.
    const double share = std::numbers::pi * blob.radius_px * blob.radius_px / view;
    all.push_back({blob, SwarmCriterion::tone, blob.is_cut && share > view_share ? share : 0, 0.5,
                   "scene.swarm.look.tone"});
  }
  return all;
}

std::string reason(const NotSwarm& no) {
  const auto below = [&](const char* what, int digits) {
    return fmt::format("{} {:.{}f} {} {:.4g} ({})", what, no.value, digits,
                       no.value < no.limit ? "<" : ">", no.limit, no.key);
  };
  const auto smooth = [&](const char* why) { return below("texture", 1) + ", " + why; };
  switch (no.criterion) {
    case SwarmCriterion::min_radius:
    case SwarmCriterion::max_radius:
      return below("radius", 1);
    case SwarmCriterion::texture:
      return below("texture", 1);
    case SwarmCriterion::alone:
      return smooth("and it is not the only smooth one");
    case SwarmCriterion::whole:
      return smooth("and it is cut");
    case SwarmCriterion::expected:
      return below("smooth, radius", 1);
    case SwarmCriterion::distance:
      return below("distance", 1);
    case SwarmCriterion::rival:
      return below("area beside the largest", 2);
    case SwarmCriterion::contrast:
      return below("contrast", 1);
    case SwarmCriterion::tone:
      break;
  }
  const std::string other = fmt::format("of the other tone ({})", no.key);
  if (no.value == 0) return other;
  return other + ", or the background of a swarm that covers more than half of the view";
}

std::string short_reason(const NotSwarm& no) {
  if (no.criterion == SwarmCriterion::tone) return "other tone";
  const std::string whole = reason(no);
  return whole.substr(0, whole.find(" ("));
}

}  // namespace microswarm::vision

// SPDX-License-Identifier: Apache-2.0
// Swarms without texture, and why something is not the swarm.
#include "microswarm/vision/scene/swarm_criteria.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

#include "microswarm/vision/scene/scene_overlay.hpp"
#include "tests/vision/microscope.hpp"

namespace microswarm::vision {
namespace {

using test::DrawnFrame;

/// What is drawn: a smooth disc lets `share` of the light through.
struct DrawnScene {
  DrawnFrame frame{test::frame_width, test::frame_height};
  Rng rng{21, Purpose::test, 0};

  void cloud(Vec2 at, double radius) {
    frame.swarm(
        {.centre = at, .radius = radius, .clumps = 300, .clump_radius = 1.5, .opacity = 0.65}, rng);
  }
  formats::Image look(double noise = 4) { return frame.expose(165, 0.2, 0.5, 0.1, noise, rng); }
};

formats::Image inverted(formats::Image picture) {
  for (std::uint8_t& grey : picture.pixels) grey = static_cast<std::uint8_t>(255 - grey);
  return picture;
}

/// Criteria that blobs failed, with the nearest blob within 10 px of each place.
std::optional<SwarmCriterion> failed(const std::vector<NotSwarm>& all, Vec2 at) {
  for (const NotSwarm& no : all)
    if (distance(no.blob.centre_px, at) < 10) return no.criterion;
  return std::nullopt;
}

TEST(SmoothSwarm, IsTheOnlySmoothBlobWhereNothingHasTexture) {
  DrawnScene drawn;
  drawn.frame.disc({300, 200}, 30, 0.4);
  const formats::Image dark = drawn.look();
  for (const ParticleTone tone : {ParticleTone::dark, ParticleTone::bright}) {
    SceneParams params;
    params.swarm.look.tone = params.obstacles.tone = tone;
    const SeenScene scene = find_scene(tone == ParticleTone::dark ? dark : inverted(dark), params);
    ASSERT_EQ(scene.swarm.sight, SwarmSight::found);
    EXPECT_LT(distance(scene.swarm.swarm->centre_px, Vec2{300, 200}), 0.5);
    EXPECT_NEAR(scene.swarm.swarm->radius_px, 30, 1);
    EXPECT_LT(scene.swarm.swarm->texture, params.swarm.look.min_texture);
    EXPECT_TRUE(scene.obstacles.empty());
  }
  SceneParams without;
  without.smooth_swarm = false;
  const SeenScene scene = find_scene(dark, without);
  EXPECT_EQ(scene.swarm.sight, SwarmSight::none);
  EXPECT_EQ(scene.obstacles.size(), 1U);
  EXPECT_EQ(failed(why_not_swarm(scene, dark, without), {300, 200}), SwarmCriterion::texture);
}

TEST(SmoothSwarm, IsNoneBesideTexture) {
  for (const bool bright : {false, true}) {
    DrawnScene drawn;
    drawn.frame.disc({150, 200}, 30, 0.4);
    drawn.cloud({450, 250}, 30);
    SceneParams params;
    if (bright) params.swarm.look.tone = params.obstacles.tone = ParticleTone::bright;
    const formats::Image picture = bright ? inverted(drawn.look()) : drawn.look();
    const SeenScene scene = find_scene(picture, params);
    ASSERT_EQ(scene.swarm.sight, SwarmSight::found);
    EXPECT_LT(distance(scene.swarm.swarm->centre_px, Vec2{450, 250}), 1.5);
    EXPECT_EQ(scene.obstacles.size(), 1U);
    const auto reasons = why_not_swarm(scene, picture, params);
    EXPECT_EQ(failed(reasons, {150, 200}), SwarmCriterion::texture);
    EXPECT_EQ(failed(reasons, {450, 250}), std::nullopt);
  }
}

TEST(SmoothSwarm, IsNotGuessedAmongSeveral) {
  DrawnScene drawn;
  drawn.frame.disc({150, 200}, 30, 0.4);
  drawn.frame.disc({450, 250}, 28, 0.4);
  const formats::Image picture = drawn.look();
  const SeenScene scene = find_scene(picture);
  EXPECT_EQ(scene.swarm.sight, SwarmSight::none);
  EXPECT_EQ(scene.obstacles.size(), 2U);
  const auto reasons = why_not_swarm(scene, picture);
  EXPECT_EQ(failed(reasons, {150, 200}), SwarmCriterion::alone);
  EXPECT_EQ(failed(reasons, {450, 250}), SwarmCriterion::alone);
}

TEST(SmoothSwarm, IsKnownByItsPlaceAndSize) {
  DrawnScene drawn;
  drawn.frame.disc({150, 200}, 30, 0.4);
  drawn.frame.disc({220, 220}, 12, 0.4);
  drawn.frame.disc({450, 250}, 30, 0.4);
  const formats::Image picture = drawn.look();
  const SceneParams params;
  const SwarmPrior prior{.at_px = Vec2{170, 210}, .min_radius_px = 20, .max_radius_px = 40};
  const SeenScene scene = find_scene(picture, params, prior);
  ASSERT_EQ(scene.swarm.sight, SwarmSight::found);
  EXPECT_LT(distance(scene.swarm.swarm->centre_px, Vec2{150, 200}), 0.5);
  EXPECT_EQ(scene.obstacles.size(), 2U);

  const SwarmPrior larger{.at_px = Vec2{170, 210}, .min_radius_px = 35};
  const SeenScene none = find_scene(picture, params, larger);
  EXPECT_EQ(none.swarm.sight, SwarmSight::none);
  const auto reasons = why_not_swarm(none, picture, params, larger);
  EXPECT_EQ(failed(reasons, {150, 200}), SwarmCriterion::expected);
}

TEST(SmoothSwarm, ThatIsCutIsAnObstacle) {
  DrawnScene drawn;
  drawn.frame.disc({5, 200}, 40, 0.4);
  const formats::Image picture = drawn.look();
  const SeenScene scene = find_scene(picture);
  EXPECT_EQ(scene.swarm.sight, SwarmSight::none);
  EXPECT_EQ(scene.obstacles.size(), 1U);
  const auto reasons = why_not_swarm(scene, picture);
  ASSERT_EQ(reasons.size(), 1U);
  EXPECT_EQ(reasons[0].criterion, SwarmCriterion::whole);
}

TEST(NotSwarm, EachCriterionIsToldWithValueAndLimit) {
  DrawnScene drawn;
  drawn.cloud({120, 120}, 30);             // of the other tone, after inversion
  drawn.frame.disc({320, 120}, 4, 0.3);    // small
  drawn.cloud({320, 350}, 60);             // too large, by a limit of 50
  drawn.frame.disc({520, 120}, 30, 0.97);  // faint
  const formats::Image picture = drawn.look(2);
  SceneParams params;
  params.swarm.look.max_radius = 50;
  params.swarm.jump = 50;
  const SwarmPrior prior{.at_px = Vec2{520, 350}};
  const SeenScene scene = find_scene(picture, params, prior);
  EXPECT_EQ(scene.swarm.sight, SwarmSight::far);
  const auto reasons = why_not_swarm(scene, picture, params, prior);
  EXPECT_EQ(failed(reasons, {120, 120}), SwarmCriterion::distance);
  EXPECT_EQ(failed(reasons, {320, 120}), SwarmCriterion::min_radius);
  EXPECT_EQ(failed(reasons, {320, 350}), SwarmCriterion::max_radius);
  EXPECT_EQ(failed(reasons, {520, 120}), SwarmCriterion::contrast);
  for (const NotSwarm& no : reasons) {
    const bool is_limit_of_above =
        no.criterion == SwarmCriterion::max_radius || no.criterion == SwarmCriterion::distance;
    EXPECT_EQ(no.value > no.limit, is_limit_of_above) << reason(no);
    EXPECT_NE(reason(no).find(no.key), std::string::npos) << reason(no);
  }
  const formats::Image shown = [&] {
    formats::Image drawn_scene = draw_scene(picture, scene);
    draw_reasons(drawn_scene, reasons);
    return drawn_scene;
  }();
  EXPECT_EQ(shown.channels, 3);
  if (const char* given = std::getenv("MICROSWARM_PICTURES"))
    formats::write_png(std::filesystem::path(given) / "reasons.png", shown);
}

TEST(NotSwarm, ASmoothPartCutOffFromASwarmHasItsOwnOutline) {
  int cut_off = 0;
  for (const double angle : {-2.5, -1.5, -0.5, 0.5, 1.5, 2.5})
    for (const double apart : {35.0, 42.0, 50.0}) {
      DrawnScene drawn;
      const Vec2 smooth = Vec2{320, 240} + apart * unit_vector(angle);
      drawn.cloud({320, 240}, 30);
      drawn.frame.disc(smooth, 22, 0.4);
      std::vector<Blob> refused;
      find_blobs(drawn.look(2), SceneParams().swarm.look, nullptr, &refused);
      for (const Blob& blob : refused) {
        if (blob.radius_px < 15) continue;
        ++cut_off;
        for (const Vec2 q : blob.outline_px)
          EXPECT_LT(std::min(distance(q, smooth) - 22, distance(q, Vec2{320, 240}) - 30), 4);
      }
    }
  EXPECT_GT(cut_off, 6);
}

TEST(NotSwarm, TheOtherToneIsTold) {
  DrawnScene drawn;
  drawn.cloud({120, 120}, 30);
  const formats::Image picture = inverted(drawn.look());
  const SeenScene scene = find_scene(picture);
  EXPECT_EQ(scene.swarm.sight, SwarmSight::none);
  EXPECT_EQ(failed(why_not_swarm(scene, picture), {120, 120}), SwarmCriterion::tone);
}

TEST(NotSwarm, MoreThanHalfOfTheViewHasAReason) {
  DrawnScene drawn;
  drawn.cloud({320, 240}, 30);
  drawn.frame.disc({320, 240}, 300, 0.4);
  const formats::Image picture = drawn.look();
  const SeenScene scene = find_scene(picture);
  EXPECT_NE(scene.swarm.sight, SwarmSight::found);
  const auto reasons = why_not_swarm(scene, picture);
  EXPECT_TRUE(!reasons.empty() || contrast_limit(picture, {}) > 99);  // the disc's contrast
}

TEST(NotSwarm, StripesHaveAReason) {
  DrawnScene drawn;
  for (int x = 0; x < test::frame_width; x += 80)
    drawn.frame.box({1.0 * x, -1}, {x + 30.0, 481}, 0.6);
  const formats::Image picture = drawn.look();
  const SeenScene scene = find_scene(picture);
  EXPECT_NE(scene.swarm.sight, SwarmSight::found);
  const auto reasons = why_not_swarm(scene, picture);
  EXPECT_TRUE(!reasons.empty() || contrast_limit(picture, {}) > 66);  // the stripes' contrast
}

}  // namespace
}  // namespace microswarm::vision

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/vessels/vessels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "microswarm/core/maths/rng.hpp"
#include "microswarm/vision/image/overlay.hpp"
#include "microswarm/vision/vessels/agreement.hpp"
#include "microswarm/vision/vessels/outline.hpp"
#include "microswarm/world/connectivity/passage.hpp"
#include "tests/cases.hpp"
#include "tests/files.hpp"

namespace microswarm::vision {
namespace {

struct Drawn {
  formats::Image picture;
  formats::Mask truth;
};

// Dark curved lines of known width under uneven light and noise.
Drawn drawn(int side, std::uint64_t seed) {
  Drawn out{{side, side, 3, {}}, formats::Mask(side, side)};
  out.picture.pixels.resize(static_cast<std::size_t>(side) * side * 3);
  Rng rng(seed, Purpose::test);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const double x = static_cast<double>(column) / side;
      const double y = static_cast<double>(row) / side;
      const double trunk = std::abs(y - 0.5 - 0.12 * std::sin(5 * x)) * side;
      const double branch = std::abs(x - 0.45 - 0.15 * std::sin(4 * y)) * side;
      const bool vessel = trunk < 5 || branch < 3.5;
      out.truth.at(column, row) = vessel;
      const double light = 120 + 60 * x - 30 * y;
      const double grey = light * (vessel ? 0.62 : 1.0) + 4 * rng.normal();
      const std::size_t i = out.picture.index(column, row);
      for (std::size_t c = 0; c < 3; ++c)
        out.picture.pixels[i + c] = static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0));
    }
  return out;
}

TEST(Vessels, DrawnOnesAreFound) {
  const Drawn d = drawn(400, 1);
  const VesselSegmentation found = segment_vessels(d.picture, {.method = VesselMethod::lines});
  const Agreement a = compare(d.truth, found.vessels);
  EXPECT_GT(a.sensitivity().value_or(0), 0.95);
  EXPECT_GT(a.specificity().value_or(0), 0.9);
}

TEST(Vessels, TheSamePictureGivesTheSameMaskWithinTheView) {
  const Drawn d = drawn(300, 2);
  const VesselSegmentation a = segment_vessels(d.picture);
  const VesselSegmentation b = segment_vessels(d.picture);
  EXPECT_EQ(a.vessels, b.vessels);
  for (std::size_t i = 0; i < a.vessels.cells.size(); ++i)
    EXPECT_LE(a.vessels.cells[i], a.field_of_view.cells[i]);
}

TEST(Vessels, BlankAndTinyPicturesHaveNone) {
  for (int side : {1, 3, 64}) {
    const formats::Image blank{
        side, side, 1, std::vector<std::uint8_t>(static_cast<std::size_t>(side) * side, 128)};
    const VesselSegmentation found = segment_vessels(blank);
    EXPECT_EQ(found.vessels.width, side);
    for (const std::uint8_t cell : found.vessels.cells) EXPECT_EQ(cell, 0);
  }
}

TEST(Vessels, WideOnesAreThoseThatADiscFits) {
  VesselSegmentation found;
  found.vessels = formats::Mask(120, 80);
  for (int x = 0; x < 120; ++x) {
    for (int y = 10; y < 31; ++y) found.vessels.at(x, y) = 1;
    for (int y = 50; y < 57; ++y) found.vessels.at(x, y) = 1;
  }
  const formats::Mask wide = wide_vessels(found, 11);
  for (int x = 20; x < 100; ++x)
    for (int y = 0; y < 80; ++y) EXPECT_EQ(wide.at(x, y) != 0, y >= 10 && y < 31) << x << ", " << y;
  EXPECT_EQ(wide_vessels(found, 5).at(60, 53), 1);
  EXPECT_EQ(wide_vessels(found, 25).at(60, 20), 0);
}

TEST(Outline, KeepsAreaAndPieces) {
  const Drawn d = drawn(300, 3);
  const auto regions = outline(d.truth, 2, 2);
  double cells = 0;
  for (const std::uint8_t cell : d.truth.cells) cells += cell;
  double sum = 0;
  for (const Polygon& region : regions) sum += area(region);
  ASSERT_FALSE(regions.empty());
  EXPECT_NEAR(sum, 4 * cells, 0.05 * 4 * cells);
  EXPECT_EQ(regions.size(), 1U);
}

TEST(Overlay, HasThePicturesSizeAndColour) {
  const Drawn d = drawn(64, 4);
  const formats::Image shown = overlay(d.picture, d.truth);
  EXPECT_EQ(shown.width, 64);
  EXPECT_EQ(shown.channels, 3);
  EXPECT_NE(shown.pixels, d.picture.pixels);
}

TEST(Agreement, OfAMaskWithItselfIsPerfect) {
  const Drawn d = drawn(64, 5);
  const Agreement a = compare(d.truth, d.truth);
  EXPECT_EQ(a.dice(), 1.0);
  EXPECT_EQ(a.sensitivity(), 1.0);
  EXPECT_EQ(a.specificity(), 1.0);
}

TEST(VesselsSample, AgreesWithItsMask) {
  const auto folder = test::sample_folder() / "vessels";
  const formats::Mask drawn_mask =
      formats::threshold(formats::read_image(folder / "retina_mask.png"), 128, false);
  for (const VesselMethod method : {VesselMethod::automatic, VesselMethod::lines}) {
    VesselParams params;
    params.method = method;
    params.keep = KeepPieces::all;
    const VesselSegmentation found =
        segment_vessels(formats::read_image(folder / "retina.png"), params);
    const Agreement a = compare(drawn_mask, found.vessels, &found.field_of_view);
    EXPECT_GT(*a.dice(), 0.65);
    EXPECT_GT(*a.sensitivity(), 0.9);
    EXPECT_GT(*a.specificity(), 0.9);
  }
}

std::filesystem::path retinas() { return test::data_folder() / "vessels"; }

TEST(Vessels, RetinasAgreeWithTheirObservers) {
  if (!std::filesystem::exists(retinas())) GTEST_SKIP() << retinas() << " is absent";
  VesselParams params;
  params.keep = KeepPieces::all;
  int left = test::cases(4);
  struct Measured {
    const char* name;
    double dice;
  };
  for (const auto& [name, dice] : {Measured{"CHASE_01L", 0.779}, Measured{"CHASE_05R", 0.817},
                                   Measured{"CHASE_09L", 0.719}, Measured{"CHASE_12R", 0.759}}) {
    if (left-- == 0) break;
    const auto read = [&](const char* what) {
      return formats::threshold(formats::read_image(retinas() / (std::string(name) + what)), 128,
                                false);
    };
    const formats::Mask first = read("_mask_obs1.png");
    const formats::Mask second = read("_mask_obs2.png");
    const VesselSegmentation found =
        segment_vessels(formats::read_image(retinas() / (std::string(name) + ".jpg")), params);
    const Agreement ours = compare(first, found.vessels, &found.field_of_view);
    const Agreement theirs = compare(first, second, &found.field_of_view);
    std::printf(
        "%s: sensitivity %.3f, specificity %.3f, Dice %.3f (second observer %.3f, %.3f, %.3f); "
        "against the second observer Dice %.3f\n",
        name, *ours.sensitivity(), *ours.specificity(), *ours.dice(), *theirs.sensitivity(),
        *theirs.specificity(), *theirs.dice(),
        *compare(second, found.vessels, &found.field_of_view).dice());
    EXPECT_GT(*ours.dice(), dice - 0.01) << name;
    EXPECT_GT(*ours.specificity(), 0.95) << name;
    EXPECT_EQ(note_on_noise(found), "") << name;
  }
}

// 3504 × 2336 pixels; grey levels of the labels tell arteries, veins and crossings.
TEST(Vessels, RetinasOfHighResolutionAgreeToo) {
  if (!std::filesystem::exists(retinas())) GTEST_SKIP() << retinas() << " is absent";
  const formats::Mask labels =
      formats::threshold(formats::read_image(retinas() / "HRF_09_h_AVlabels.png"), 1, false);
  VesselParams params;
  params.keep = KeepPieces::all;
  const VesselSegmentation found =
      segment_vessels(formats::read_image(retinas() / "HRF_09_h.jpg"), params);
  const Agreement agreement = compare(labels, found.vessels, &found.field_of_view);
  EXPECT_GT(*agreement.dice(), 0.787);  // 0.797
  EXPECT_GT(*agreement.specificity(), 0.95);
}

TEST(Outline, WallsReachTheBorderOfTheMap) {
  formats::Mask network(40, 30);
  for (int column = 0; column < 30; ++column)
    for (int row = 10; row < 16; ++row) network.at(column, row) = 1;
  const Map map({{0, 0}, {240, 180}}, walls_around(network, 6, 6));
  const MapReport report = check_map(map);
  EXPECT_EQ(report.free_pieces, 1);
  EXPECT_TRUE(map.is_free(Vec2{7, 100}, 0));
  EXPECT_FALSE(map.is_free(Vec2{1, 1}, 0));
}

}  // namespace
}  // namespace microswarm::vision

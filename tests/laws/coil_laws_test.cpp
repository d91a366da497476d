// SPDX-License-Identifier: Apache-2.0
// Laws that every system of coils keeps.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/coils/currents.hpp"
#include "tests/actuation/support.hpp"
#include "tests/laws/fields_laws.hpp"

namespace microswarm {
namespace {

using Coils = decltype(actuation::CoilSystemParams::coils);
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A system around a centre, scaled: all its lengths are `scale` times as long. Files are written
/// into a folder.
struct CoilCase {
  std::string name;
  std::function<Coils(const test::Folder&, double scale)> make;
  double reach = 10'000;     ///< half a side of the cube in which it is asked [µm]
  bool is_smooth = true;     ///< its field has no bends: it is no interpolated grid
  bool has_lengths = true;   ///< a matrix has none
  bool is_mirrored = false;  ///< the field is the same on the other side of the centre
  bool makes_any_field = true;
};

void PrintTo(const CoilCase& c, std::ostream* os) { *os << c.name; }

class CoilLaws : public testing::TestWithParam<CoilCase> {
 protected:
  actuation::CoilSystemParams params(double scale = 1) const {
    actuation::CoilSystemParams p;
    p.coils = GetParam().make(folder_, scale);
    return p;
  }
  actuation::CoilSystem made(double scale = 1) const {
    return actuation::CoilSystem(params(scale), {}, folder_ / "");
  }
  Vector3d place(test::Dice& dice, const actuation::CoilSystem& system) const {
    return system.centre() + GetParam().reach * dice.vector();
  }
  static VectorXd random_currents(test::Dice& dice, const actuation::CoilSystem& system) {
    VectorXd currents(static_cast<Eigen::Index>(system.size()));
    for (double& i : currents) i = 5 * dice.number();
    return currents;
  }

  test::Folder folder_;
};

TEST_P(CoilLaws, FieldIsLinearInTheCurrents) {
  const actuation::CoilSystem system = made();
  test::Dice dice(1);
  for (int trial = 0; trial < 30; ++trial) {
    const actuation::Actuation at = system.at(place(dice, system));
    const VectorXd one = random_currents(dice, system), two = random_currents(dice, system);
    const double a = dice.number(), b = dice.number();
    const Vector3d offset = at.offset.field;
    const Vector3d sum = a * (at.total_field(one) - offset) + b * (at.total_field(two) - offset);
    EXPECT_LE((at.total_field(a * one + b * two) - offset - sum).norm(), 1e-12 * (1 + sum.norm()));
    EXPECT_LE((at.total_field(-one) - offset + (at.total_field(one) - offset)).norm(),
              1e-12 * (1 + at.total_field(one).norm()));
    // A coil alone is its column.
    for (Eigen::Index i = 0; i < at.field.cols(); ++i) {
      const VectorXd alone = VectorXd::Unit(at.field.cols(), i);
      EXPECT_LE((at.total_field(alone) - offset - at.field.col(i)).norm(),
                1e-12 * (1 + offset.norm()));
    }
  }
}

TEST_P(CoilLaws, SamePlaceSameBits) {
  const actuation::CoilSystem one = made(), two = made();
  test::Dice dice(2);
  for (int trial = 0; trial < 10; ++trial) {
    const Vector3d p = place(dice, one);
    EXPECT_EQ(one.at(p).field, two.at(p).field);
    EXPECT_EQ(one.at(p).gradients, two.at(p).gradients);
  }
}

TEST_P(CoilLaws, GradientIsThatOfTheField) {
  const actuation::CoilSystem system = made();
  test::Dice dice(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector3d p = place(dice, system);
    const VectorXd currents = random_currents(dice, system);
    const auto field = [&](const Vector3d& at) {
      return Vector3d(system.at(at).total_field(currents));
    };
    const Eigen::Matrix3d told = system.at(p).total_gradient(currents);
    EXPECT_LE((told - told.transpose()).norm(), 1e-12 * told.norm()) << "no curl";
    EXPECT_LE(std::abs(told.trace()), 1e-12 * told.norm()) << "no divergence";
    if (!GetParam().is_smooth) continue;
    const Eigen::Matrix3d g = test::difference_gradient(field, p, GetParam().reach / 100);
    EXPECT_LE((g - told).norm(), 1e-6 * (told.norm() + field(p).norm() / GetParam().reach));
  }
}

// What is twice as far away from coils twice as large is half as strong for one ampere turn.
TEST_P(CoilLaws, LengthsScaleTheField) {
  if (!GetParam().has_lengths) return;
  const actuation::CoilSystem one = made(1), two = made(2);
  test::Dice dice(4);
  const bool is_given_by_values = !GetParam().is_smooth;  // a grid: they stand at other places
  for (int trial = 0; trial < 20; ++trial) {
    const Vector3d p = place(dice, one);
    const actuation::Actuation near = one.at(p), far = two.at(2 * p);
    const double factor = is_given_by_values ? 1 : 2;
    EXPECT_LE((factor * far.field - near.field).norm(), 1e-9 * near.field.norm());
    EXPECT_LE((2 * factor * far.gradients - near.gradients).norm(), 1e-9 * near.gradients.norm());
  }
}

TEST_P(CoilLaws, IsAsSymmetricAsItIsBuilt) {
  if (!GetParam().is_mirrored) return;
  const actuation::CoilSystem system = made();
  test::Dice dice(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector3d away = GetParam().reach * dice.vector();
    const actuation::Actuation here = system.at(system.centre() + away);
    const actuation::Actuation there = system.at(system.centre() - away);
    // All coils alike: what one of a pair makes here, the other makes there.
    const VectorXd all = VectorXd::Ones(here.field.cols());
    EXPECT_LE((here.total_field(all) - there.total_field(all)).norm(),
              1e-10 * here.total_field(all).norm());
  }
}

TEST_P(CoilLaws, CurrentsMakeTheFieldThatIsAskedFor) {
  const actuation::CoilSystem system = made();
  test::Dice dice(6);
  for (int trial = 0; trial < 40; ++trial) {
    const actuation::Actuation at = system.at(place(dice, system));
    const Vector3d wanted = 10 * dice.vector();
    const actuation::CurrentsForField found = actuation::currents_for(at, wanted);
    const Vector3d made_field = at.total_field(found.currents);
    EXPECT_LE((made_field - found.field).norm(), 1e-9 * (1 + wanted.norm()));
    EXPECT_NEAR(found.short_by, (made_field - wanted).norm(), 1e-9 * (1 + wanted.norm()));
    EXPECT_EQ(found.rank == 3, GetParam().makes_any_field);
    EXPECT_EQ(found.reached, GetParam().makes_any_field);
    // What is missing can be made by no coil, and nothing else is missing.
    const Vector3d left = wanted - made_field;
    if (found.missing.cols() > 0) {
      EXPECT_LE((found.missing.transpose() * at.field).norm(), 1e-9 * at.field.norm());
      EXPECT_LE((left - found.missing * (found.missing.transpose() * left)).norm(), 1e-9);
    }
    // Currents that change nothing only make them larger.
    const VectorXd random = random_currents(dice, system);
    const VectorXd idle = random - actuation::currents_for(at, at.total_field(random)).currents;
    EXPECT_LE((at.field * idle).norm(), 1e-9 * (1 + at.field.norm()));
    EXPECT_GE((found.currents + idle).norm(), found.currents.norm() * (1 - 1e-9));
  }
}

TEST_P(CoilLaws, LimitsAreHonouredAndTheDirectionKept) {
  actuation::CoilSystem system = made();
  constexpr double most = 2;
  system.limit_current(most);
  ASSERT_EQ(system.amplifiers().size(), system.size());
  for (const actuation::AmplifierParams& amplifier : system.amplifiers()) {
    ASSERT_TRUE(amplifier.max_current);
    EXPECT_LE(*amplifier.max_current, most);
  }
  system.limit_current(2 * most);  // a limit is never widened
  EXPECT_LE(*system.amplifiers()[0].max_current, most);
  const actuation::Amplifiers amplifiers(system.amplifiers());
  test::Dice dice(7);
  int cut = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const VectorXd wanted = random_currents(dice, system);
    const actuation::LimitedCurrents driven = amplifiers.steady(wanted);
    EXPECT_LE(driven.currents.cwiseAbs().maxCoeff(), most * (1 + 1e-12));
    EXPECT_LE((driven.currents - driven.scale * wanted).norm(), 1e-12 * wanted.norm());
    EXPECT_EQ(driven.hits.empty(), wanted.cwiseAbs().maxCoeff() <= most);
    EXPECT_EQ(driven.scale < 1, !driven.hits.empty());
    // The most of it: a share more would break the limit.
    if (driven.scale < 1) {
      EXPECT_NEAR(driven.currents.cwiseAbs().maxCoeff(), most, 1e-9);
      ++cut;
    }
  }
  EXPECT_GT(cut, 10);
}

TEST_P(CoilLaws, IsKnownInItsWorkspace) {
  const actuation::CoilSystem system = made();
  EXPECT_TRUE(system.in_workspace(system.centre()));
  EXPECT_EQ(system.coil_names().size(), system.size());
  test::Dice dice(8);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector3d p = place(dice, system);
    ASSERT_TRUE(system.in_workspace(p));
    EXPECT_TRUE(system.at(p).field.allFinite());
  }
  const Vector3d outside = system.centre() + 10 * GetParam().reach * Vector3d::Ones();
  if (GetParam().is_smooth) {
    EXPECT_TRUE(system.at(outside).field.allFinite());
    return;
  }
  EXPECT_FALSE(system.in_workspace(outside));
  const std::string what = test::error_of([&] { system.at(outside); });
  EXPECT_TRUE(test::is_one_line_naming(what, "", {"grid"}));
}

TEST_P(CoilLaws, ReadsBack) { laws::expect_reads_back(params()); }
TEST_P(CoilLaws, LimitsAreKept) {
  const bool has_some = !std::holds_alternative<actuation::MpemCoils>(params().coils) &&
                        !std::holds_alternative<actuation::VfieldCoils>(params().coils);
  EXPECT_EQ(laws::expect_limits_are_kept(params().coils) > 0, has_some);
}

/// A node every 10 mm, of a field that is straight in the place: [mT/A] in terms of µm.
std::string grid_text(double scale, const Vector3d& middle) {
  std::string text = "27\n3 3 3\n";
  for (int axis = 0; axis < 3; ++axis)
    text += fmt::format("{} {}\n", -0.012 * scale, 0.012 * scale);
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k)
        text +=
            fmt::format("{} {} {} {} {} {}\n", 0.012 * scale * i, 0.012 * scale * j,
                        0.012 * scale * k, 1e-3 * (middle.x() + 0.1 * i + 0.05 * j),
                        1e-3 * (middle.y() + 0.05 * i - 0.3 * j), 1e-3 * (middle.z() + 0.2 * k));
  return text;
}

/// Three dipoles around the workspace.
std::string mpem_text(double scale) {
  std::string text = "System_Name: three\nCoil_List: [X, Y, Z]\n";
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d e = Vector3d::Unit(axis);
    text += fmt::format(
        "{}:\n  Source_List: [One]\n  One:\n    A_Coeff: ~\n    B_Coeff: [{}]\n"
        "    Source_Direction: [{}, {}, {}]\n    Source_Position: [{}, {}, {}]\n",
        "XYZ"[axis], 1e-7 * scale * scale, e.x(), e.y(), e.z(), -0.06 * scale * e.x(),
        -0.06 * scale * e.y(), -0.06 * scale * e.z());
  }
  text += "Workspace_Dimensions: [";
  for (int axis = 0; axis < 3; ++axis)
    text += fmt::format("{}[{}, {}]", axis ? ", " : "", -0.02 * scale, 0.02 * scale);
  return text + "]\n";
}

std::vector<CoilCase> coil_cases() {
  const auto helmholtz = [](const test::Folder&, double scale) -> Coils {
    actuation::HelmholtzCoils c;
    for (double& radius : c.radius) radius *= scale;
    return c;
  };
  const auto cube = [](const test::Folder&, double scale) -> Coils {
    return actuation::CubeCoils{.radius = 30000 * scale,
                                .distance = 60000 * scale,
                                .length = 15000 * scale,
                                .thickness = 8000 * scale};
  };
  const auto loops = [](const test::Folder&, double scale) -> Coils {
    actuation::LoopCoils c;
    for (int axis = 0; axis < 3; ++axis) {
      actuation::WindingParams winding;
      winding.radius = 30000 * scale;
      winding.turns = 50;
      winding.axis = {0.1, 0.2, 0.3};
      winding.axis[static_cast<std::size_t>(axis)] = 2;
      winding.centre[static_cast<std::size_t>(axis)] = 50000 * scale;
      c.coils.push_back({fmt::format("coil{}", axis), {winding}});
    }
    return c;
  };
  const auto mpem = [](const test::Folder& folder, double scale) -> Coils {
    const std::string name = fmt::format("three{}.yaml", scale);
    folder.with(name, mpem_text(scale));
    return actuation::MpemCoils{name};
  };
  const auto vfield = [](const test::Folder& folder, double scale) -> Coils {
    actuation::VfieldCoils c;
    for (int axis = 0; axis < 3; ++axis) {
      c.files.push_back(fmt::format("grid{}of{}.txt", axis, scale));
      folder.with(c.files.back(), grid_text(scale, 2 * Vector3d::Unit(axis)));
    }
    return c;
  };
  const auto matrix = [](const test::Folder&, double) -> Coils {
    return actuation::MatrixCoils{
        .names = {"a", "b", "c", "d"},
        .field = {{1, 0.2, 0, 0.5}, {0.1, 2, -0.3, 0.5}, {0, 0.4, 1.5, 0.5}},
        .offset = {0.05, -0.02, 0.03}};
  };
  const auto flat = [](const test::Folder&, double) -> Coils {
    return actuation::MatrixCoils{.names = {"a", "b"}, .field = {{1, 0.2}, {0.1, 2}, {0, 0}}};
  };
  return {{.name = "Helmholtz", .make = helmholtz, .is_mirrored = true},
          {.name = "Cube", .make = cube, .is_mirrored = true},
          {.name = "Loops", .make = loops},
          {.name = "Mpem", .make = mpem},
          {.name = "Vfield", .make = vfield, .is_smooth = false},
          {.name = "Matrix", .make = matrix, .has_lengths = false, .is_mirrored = true},
          {.name = "MatrixFlat",
           .make = flat,
           .has_lengths = false,
           .is_mirrored = true,
           .makes_any_field = false}};
}

INSTANTIATE_TEST_SUITE_P(All, CoilLaws, testing::ValuesIn(coil_cases()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/mpem.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <map>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/actuation/coils/text_rows.hpp"
#include "microswarm/core/text/text.hpp"
#include "tests/actuation/support.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

constexpr std::string_view small = R"(System_Name: pair
Coil_List: [Left, Right, Offset]
Left:
  Source_List: [One, Two]
  One: {A_Coeff: ~, B_Coeff: [2.0e-5], Source_Direction: [1, 0, 0], Source_Position: [-0.1, 0, 0]}
  Two: {A_Coeff: [1.0e-3], B_Coeff: ~, Source_Direction: [0, 0, 2], Source_Position: [0, 0, 0]}
Right:
  Source_List: [One]
  One: {A_Coeff: ~, B_Coeff: [2.0e-5], Source_Direction: [0, 1, 0], Source_Position: [0.1, 0, 0]}
Offset:
  Source_List: [One]
  One: {A_Coeff: [-5.0e-5], B_Coeff: ~, Source_Direction: [0, 1, 0], Source_Position: [0, 0, 0]}
Workspace_Dimensions: [[-0.01, 0.01], [-0.01, 0.01], [0, 0.02]]
)";

TEST(Mpem, ReadsSourcesAndTheirFields) {
  const MpemSystem system = parse_mpem(small, "pair.yaml");
  EXPECT_EQ(system.name, "pair");
  ASSERT_EQ(system.coils.size(), 2u);
  EXPECT_EQ(system.coils[0].name, "Left");
  // Dipoles of 2e-5 T m³/A at 0.1 m: on their axis 2 b/r³ = 40 mT, beside it −b/r³ = −20 mT.
  const Eigen::Vector3d left = field_at(system.coils[0].sources, {0, 0, 0}).field;
  EXPECT_LE((left - Eigen::Vector3d(40, 0, -1)).norm(), 1e-12);
  const Eigen::Vector3d right = field_at(system.coils[1].sources, {0, 0, 0}).field;
  EXPECT_LE((right - Eigen::Vector3d(0, -20, 0)).norm(), 1e-12);
  EXPECT_LE((field_at(system.offset, {5, 6, 7}).field - Eigen::Vector3d(0, 0.05, 0)).norm(), 1e-15);
  EXPECT_TRUE(system.in_workspace({1e4, 0, 0}));
  EXPECT_FALSE(system.in_workspace({1.0001e4, 0, 0}));
  EXPECT_FALSE(system.in_workspace({0, 0, -1}));
}

TEST(Mpem, EveryOrderIsTheGradientOfItsPotential) {
  test::Dice dice(3);
  for (int trial = 0; trial < 200; ++trial) {
    Multipole source{0.1 * dice.vector(), dice.direction(), {}, {}};
    const std::size_t n = static_cast<std::size_t>(trial % 6);
    (trial % 2 ? source.A : source.B).assign(n, 0);
    (trial % 2 ? source.A : source.B).push_back(1);
    const Eigen::Vector3d p = 1e6 * source.position + 2e5 * dice.vector();
    // Ψ by its definition; std::legendre is the standard library's P_n.
    const auto potential = [&](const Eigen::Vector3d& at) {
      const Eigen::Vector3d off = 1e-6 * at - source.position;
      const double r = off.norm();
      const double P = std::legendre(static_cast<unsigned>(n) + 1, off.dot(source.direction) / r);
      const auto k = static_cast<double>(n) + 1;
      return 1e3 * (trial % 2 ? std::pow(r, k) : std::pow(r, -k - 1)) * P;
    };
    const FieldGradient f = multipole_field(source, p);
    const double h = 100;
    Eigen::Vector3d expected;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d e = h * Eigen::Vector3d::Unit(axis);
      expected[axis] = -1e6 *
                       (8 * (potential(p + e) - potential(p - e)) -
                        (potential(p + 2 * e) - potential(p - 2 * e))) /
                       (12 * h);
    }
    EXPECT_LE((f.field - expected).norm(), 1e-7 * expected.norm()) << trial;
    const auto field = [&](const Eigen::Vector3d& at) { return multipole_field(source, at).field; };
    const Eigen::Matrix3d g = test::difference_gradient(field, p, h);
    EXPECT_LE((f.gradient - g).norm(), 1e-7 * (g.norm() + 1e-6 * f.field.norm())) << trial;
    EXPECT_NEAR(f.gradient.trace(), 0, 1e-10 * (f.gradient.norm() + 1e-300));
  }
}

TEST(Mpem, AtASourceOnlyWhatHasABoundIsThere) {
  Multipole source{{0, 0, 0}, {0, 0, 1}, {0.5, 2}, {1e-5}};
  const FieldGradient f = multipole_field(source, {0, 0, 0});
  EXPECT_EQ(f.field, Eigen::Vector3d(0, 0, -500));
  // r² P_2 has the gradient 2 (I − 3 z zᵀ) of its field, in T/m.
  const Eigen::Matrix3d expected = 2e-3 * Eigen::Vector3d(1, 1, -2).asDiagonal().toDenseMatrix();
  EXPECT_LE((f.gradient - expected).norm(), 1e-15);
}

TEST(Mpem, RefusesInOneLine) {
  const auto refusal = [](std::string text, std::string_view from, std::string_view to) {
    text.replace(text.find(from), from.size(), to);
    return test::error_of([&] { parse_mpem(text, "pair.yaml"); });
  };
  const std::string text(small);
  EXPECT_EQ(refusal(text, "\nLeft:", "\nLft:"),
            "pair.yaml:1:1: missing key 'Left' in the calibration, where Coil_List names it");
  EXPECT_TRUE(test::is_one_line_naming(refusal(text, "Coil_List", "List"), "pair.yaml:1:1",
                                       {"missing", "Coil_List"}));
  EXPECT_TRUE(test::is_one_line_naming(
      refusal(text, "Source_Position: [-0.1", "Source Position: [-0.1"), "pair.yaml:5:8",
      {"Source_Position", "One", "Left", "Source Position"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal(text, "B_Coeff: [2.0e-5]", "B_Coeff: ~"),
                                       "pair.yaml:5:8", {"One", "Left", "A_Coeff", "B_Coeff"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal(text, "[2.0e-5]", "[.nan]"), "pair.yaml:5:31",
                                       {"B_Coeff", "One", "Left"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal(text, "[0, 0, 2]", "[0, 0, 0]"), "pair.yaml:6:58",
                                       {"Source_Direction", "Two", "Left"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal(text, "[0, 0.02]", "[0.02, 0]"), "pair.yaml:13:54",
                                       {"Workspace_Dimensions", "[least, most]"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal(text, "[Left, Right, Offset]", "[Left, Left]"),
                                       "pair.yaml:2:19", {"Left", "Coil_List"}));
}

class CalibrationData : public testing::Test {
 protected:
  void SetUp() override {
    if (test::data_folder().empty()) GTEST_SKIP() << "no folder MICROSWARM_DATA";
  }
  std::filesystem::path folder_ = test::data_folder() / "magcal";
};

/// |found − expected| in terms of the largest expected value of that kind.
struct Worst {
  double relative = 0;
  int compared = 0;
  template <class Vector>
  void add(const Vector& found, const Vector& expected) {
    ++compared;
    if (expected.norm() > 0)
      relative = std::max(relative, (found - expected).norm() / expected.norm());
    else
      EXPECT_LE(found.norm(), 1e-12);
  }
};

/// Compares a calibration with the fields and gradients in the table beside it.
void expect_fields(const std::filesystem::path& folder, const std::string& name) {
  const MpemSystem mpem = read_mpem(folder / (name + ".yaml"));
  CoilSystemParams params;
  params.coils = MpemCoils{name + ".yaml"};
  const CoilSystem system(params, {}, folder);
  const std::string text = read_file(folder / (name + ".expected_fields.csv"));
  TextRows rows(text, name);
  ASSERT_TRUE(rows.next());
  const std::size_t columns = rows.pieces(',').size();
  const std::size_t coils = columns - 12;
  ASSERT_EQ(system.size(), coils);
  Worst fields, gradients;
  int undefined = 0;
  while (rows.next()) {
    const auto pieces = rows.pieces(',');
    ASSERT_EQ(pieces.size(), columns);
    // A gradient of "-nan" stands at the place of a source without strength: ours is finite.
    const auto number = [&](std::size_t i) {
      return pieces[i].ends_with("nan") ? std::nan("") : rows.number(pieces[i], "value");
    };
    const Eigen::Vector3d p = 1e6 * Eigen::Vector3d(number(0), number(1), number(2));
    Eigen::VectorXd currents(static_cast<Eigen::Index>(coils));
    for (std::size_t i = 0; i < coils; ++i) currents[static_cast<Eigen::Index>(i)] = number(3 + i);
    const std::size_t b = 3 + coils;
    const Actuation at = system.at(p);
    const Eigen::Vector3d expected = 1e3 * Eigen::Vector3d(number(b), number(b + 1), number(b + 2));
    fields.add(at.total_field(currents), expected);
    FiveGradients five;
    for (std::size_t k = 0; k < 5; ++k) five[static_cast<Eigen::Index>(k)] = number(b + 3 + k);
    const FiveGradients found = five_gradients(at.total_gradient(currents));
    if (five.allFinite())
      gradients.add(found, FiveGradients(mt_per_um_of_t_per_m * five));
    else
      ++undefined;
    EXPECT_TRUE(found.allFinite());
    EXPECT_EQ(mpem.in_workspace(p), number(columns - 1) == 1);
  }
  std::cout << name << ": " << fields.compared << " fields within " << fields.relative << ", "
            << gradients.compared << " gradients within " << gradients.relative << '\n';
  EXPECT_LE(fields.relative, 1e-6) << name;
  EXPECT_LE(gradients.relative, 1e-6) << name;
  EXPECT_GE(gradients.compared, 30) << name;
  EXPECT_EQ(undefined, name == "OctoMag_IC" ? 10 : 0);
}

TEST(CalibrationSample, FieldsAndGradientsAreThoseExpected) {
  expect_fields(test::sample_folder() / "coils", "coils");
}

TEST(CalibrationSample, GridsOfFieldsAreRead) {
  const auto folder = test::sample_folder() / "coils";
  CoilSystemParams params;
  params.coils = VfieldCoils{{"Left.txt", "Right.txt", "Below.txt"}};
  const CoilSystem grids(params, {}, folder);
  params.coils = MpemCoils{"coils.yaml"};
  const CoilSystem mpem(params, {}, folder);
  EXPECT_EQ(grids.coil_names()[1], "Right");
  // At the nodes they are the calibration's fields, between them about.
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5000, -5000, 5000), Eigen::Vector3d(-5000, 0, 0)})
    EXPECT_LE((grids.at(p).field - mpem.at(p).field).norm(), 1e-5 * mpem.at(p).field.norm());
  const Eigen::Vector3d between(1000, -2500, 2000);
  EXPECT_LE((grids.at(between).field - mpem.at(between).field).norm(),
            0.03 * mpem.at(between).field.norm());
}

TEST_F(CalibrationData, FieldsAndGradientsAreThoseExpected) {
  for (const std::string name : {"OctoMag_Calibration", "MagBed_Calibration_03-07-2018",
                                 "Navion_2_Calibration_24-02-2020", "OctoMag_IC"})
    expect_fields(folder_, name);
}

TEST_F(CalibrationData, TheTwoInvalidFilesAreRefused) {
  const auto refusal = [&](const char* file) {
    const std::string what = test::error_of([&] { read_mpem(folder_ / file); });
    return what.substr(folder_.string().size() + 1);
  };
  EXPECT_TRUE(test::is_one_line_naming(refusal("invalid.yaml"), "invalid.yaml:18:1",
                                       {"Coil_0", "Coil_List"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal("invalid_no_coeffs.yaml"),
                                       "invalid_no_coeffs.yaml:25:9",
                                       {"Source_Position", "Src_0", "Coil_0", "Source Position"}));
}

TEST_F(CalibrationData, GridsOfFieldsAreRead) {
  CoilSystemParams params;
  VfieldCoils coils;
  for (int i = 0; i < 8; ++i) coils.files.push_back("vfield_0" + std::to_string(i) + ".txt");
  params.coils = coils;
  const CoilSystem system(params, {}, folder_);
  ASSERT_EQ(system.size(), 8u);
  EXPECT_EQ(system.coil_names()[3], "vfield_03");
  // A node of the file, and half way to the next.
  const Actuation at = system.at({-5000, -5000, 0});
  EXPECT_LE((at.field.col(0) - Eigen::Vector3d(-0.781205, -0.14303, -0.0215438)).norm(), 1e-12);
  const Actuation between = system.at({-5000, -5000, 500});
  EXPECT_NEAR(between.field(0, 0), -0.5 * (0.781205 + 0.760604), 1e-12);
  const FieldGrid uniform = read_vfield(folder_ / "vfield_single.yaml");
  EXPECT_LE((uniform.at({1000, 2000, -3000}).field - Eigen::Vector3d(1000, 1000, 1000)).norm(),
            1e-9);
  EXPECT_LE(uniform.at({1000, 2000, -3000}).gradient.norm(), 1e-12);
}

}  // namespace
}  // namespace microswarm::actuation

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/coils/calibration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/actuation/support.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

Eigen::Matrix<double, 3, 4> true_matrix() {
  Eigen::Matrix<double, 3, 4> A;
  A << 1.2, -0.1, 0.02, 0.4, 0.05, 0.9, -0.03, 0.5, 0, 0.1, 2.1, -0.6;
  return A;
}

std::string measured(int rows, double noise, const Eigen::Vector3d& offset) {
  test::Dice dice(12);
  std::string text = "# a probe at the centre\ni_x_a,i_y_a,i_z_a,i_w_a,x_um,bx_mt,by_mt,bz_mt\n";
  for (int r = 0; r < rows; ++r) {
    Eigen::Vector4d currents;
    for (double& i : currents) i = 5 * dice.number();
    const Eigen::Vector3d b = true_matrix() * currents + offset + noise * dice.vector();
    text += fmt::format("{},{},{},{},{},{},{},{}\n", currents[0], currents[1], currents[2],
                        currents[3], 10 * r, b[0], b[1], b[2]);
  }
  return text;
}

double error_of_fit(const FittedMatrix& fit) {
  double worst = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 4; ++i)
      worst = std::max(
          worst, std::abs(fit.coils.field[k][i] - true_matrix()(static_cast<Eigen::Index>(k),
                                                                static_cast<Eigen::Index>(i))));
  return worst;
}

TEST(Calibration, FindsTheMatrixThatMadeTheFields) {
  const auto exact = fit_matrix(parse_measurements(measured(4, 0, {0, 0, 0}), "m.csv"));
  EXPECT_LE(error_of_fit(exact), 1e-12);
  EXPECT_LE(exact.worst, 1e-12);
  const Eigen::Vector3d earth(0.02, -0.01, 0.045);
  const auto offset =
      fit_matrix(parse_measurements(measured(9, 0, earth), "m.csv"), {.offset = true});
  EXPECT_LE(error_of_fit(offset), 1e-12);
  EXPECT_NEAR(offset.coils.offset[2], 0.045, 1e-12);
  EXPECT_EQ(offset.coils.names, (std::vector<std::string>{"x", "y", "z", "w"}));
}

TEST(Calibration, ResidualsAreTheNoiseAndOrthogonalToTheCurrents) {
  const FieldMeasurements rows = parse_measurements(measured(400, 0.1, {0, 0, 0}), "m.csv");
  const FittedMatrix fit = fit_matrix(rows);
  EXPECT_LE(error_of_fit(fit), 0.01);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(fit.rms[k], 0.1 / std::sqrt(3), 0.005);
  EXPECT_NEAR(fit.total_rms, fit.rms.norm(), 1e-15);
  Eigen::Matrix<double, 3, 4> products = Eigen::Matrix<double, 3, 4>::Zero();
  for (std::size_t r = 0; r < rows.rows.size(); ++r) {
    products += fit.residuals[r] * rows.rows[r].currents.transpose();
    EXPECT_LE(fit.residuals[r].norm(), fit.worst);
  }
  EXPECT_LE(products.norm(), 1e-9);
  EXPECT_EQ(fit.residuals[fit.worst_row].norm(), fit.worst);
}

TEST(Calibration, NamesTheWorstPoint) {
  std::string text = measured(30, 0, {0, 0, 0});
  text += "1,1,1,1,300,9,9,9\n";
  const FieldMeasurements rows = parse_measurements(text, "m.csv");
  const FittedMatrix fit = fit_matrix(rows);
  EXPECT_EQ(fit.worst_row, 30u);
  EXPECT_EQ(rows.rows[fit.worst_row].line, 33);
  EXPECT_EQ(rows.rows[fit.worst_row].position, Eigen::Vector3d(300, 0, 0));
}

TEST(Calibration, TablesWithSemicolonsAreTheSame) {
  const std::string text = measured(9, 0.1, {0, 0, 0});
  std::string other = text;
  for (char& c : other) c = c == ',' ? ';' : c == '.' ? ',' : c;
  const FieldMeasurements rows = parse_measurements(text, "m.csv");
  const FieldMeasurements others = parse_measurements(other, "m.csv");
  EXPECT_EQ(others.coils, rows.coils);
  ASSERT_EQ(others.rows.size(), rows.rows.size());
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    EXPECT_EQ(others.rows[i].field, rows.rows[i].field);
    EXPECT_EQ(others.rows[i].currents, rows.rows[i].currents);
  }
}

TEST(Calibration, RefusesWhatIsNotDetermined) {
  const auto refusal = [](const std::string& text, bool offset = false) {
    return test::error_of(
        [&] { fit_matrix(parse_measurements(text, "m.csv"), {.offset = offset}); });
  };
  const std::string header = "i_x_a,i_y_a,i_z_a,bx_mt,by_mt,bz_mt\n";
  EXPECT_EQ(
      refusal(header + "1,0,0,1,0,0\n0,1,0,0,1,0\n"),
      "m.csv: 2 measurements do not determine the fields of 'z': currents are missing that change "
      "each of them apart from the others");
  EXPECT_TRUE(
      test::is_one_line_naming(refusal(header + "1,2,0,1,0,0\n0,0,1,0,1,0\n-2,-4,1,1,1,1\n"),
                               "m.csv", {"3", "fields", "x", "y"}));
  EXPECT_TRUE(
      test::is_one_line_naming(refusal(header + "1,0,0,1,0,0\n0,1,0,0,1,0\n0,0,1,1,1,1\n", true),
                               "m.csv", {"3", "fields", "x", "y", "z"}));
}

TEST(Calibration, ACoilWithoutEffectIsNamed) {
  const auto refusal = [](const std::string& rows, bool gradients = false) {
    const FieldMeasurements measured =
        parse_measurements("i_x_a,i_y_a,x_um,y_um,bx_mt,by_mt,bz_mt\n" + rows, "m.csv");
    const FittedMatrix fit = fit_matrix(measured, {.offset = true, .gradients = gradients});
    return test::error_of([&] { require_effects(measured, fit); });
  };
  std::string noise, silent, maxwell;
  test::Dice dice(5);
  for (const auto& [x, y] : {std::pair{0, 0}, {4000, 0}, {0, 4000}, {-4000, 0}, {0, -4000}})
    for (const auto& [a, b] : {std::pair{0, 0}, {2, 0}, {-2, 0}, {0, 2}, {0, -2}}) {
      const std::string at = fmt::format("{},{},{},{},", a, b, x, y);
      const Eigen::Vector3d n = 0.01 * dice.vector();
      noise += fmt::format("{}{},{},{}\n", at, a + n[0], n[1], 0.04 + n[2]);
      silent += at + "0,0,0\n";
      // No field at the centre, but gradients.
      maxwell += fmt::format("{}{},{},0.04\n", at, a + 1e-4 * b * x, -1e-4 * b * y);
    }
  EXPECT_TRUE(test::is_one_line_naming(refusal(noise), "m.csv", {"'y'"})) << refusal(noise);
  EXPECT_FALSE(test::names(refusal(noise), "'x'"));
  EXPECT_TRUE(test::is_one_line_naming(refusal(noise, true), "m.csv", {"'y'"}));
  EXPECT_TRUE(test::names(refusal(silent), "'x', 'y'"));
  EXPECT_TRUE(test::names(refusal(silent, true), "'x', 'y'"));
  EXPECT_EQ(refusal(maxwell, true), "nothing was thrown");
  const FieldMeasurements measured =
      parse_measurements("i_x_a,bx_mt,by_mt,bz_mt\n1,0,0,0\n2,0,0,0\n", "m.csv");
  EXPECT_FALSE(largest_error(fit_matrix(measured)).has_value());
}

TEST(Calibration, RefusesBrokenFilesInOneLine) {
  const auto refusal = [](const std::string& text) {
    return test::error_of([&] { parse_measurements(text, "m.csv"); });
  };
  EXPECT_TRUE(
      test::is_one_line_naming(refusal(""), "m.csv:1", {"i_NAME_a", "bx_mt", "by_mt", "bz_mt"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal("bx_mt,by_mt,bz_mt\n"), "m.csv:1",
                                       {"0", "i_NAME_a", "1..64"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal("i_x_a,bx_mt,by_mt\n"), "m.csv:1",
                                       {"column", "bz_mt", "missing"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal("i_x_a,i_x_a,bx_mt,by_mt,bz_mt\n"), "m.csv:1",
                                       {"column", "i_x_a", "twice"}));
  const std::string header = "i_x_a,bx_mt,by_mt,bz_mt\n";
  EXPECT_TRUE(test::is_one_line_naming(refusal(header), "m.csv:1", {"measurements", "header"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal(header + "1,2,3\n"), "m.csv:2",
                                       {"3", "fields", "header", "4"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal(header + "1,2,x,4\n"), "m.csv:2", {"by_mt", "x"}));
  EXPECT_TRUE(
      test::is_one_line_naming(refusal(header + "1,2,nan,4\n"), "m.csv:2", {"by_mt", "nan"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal(header + "2e9,2,3,4\n"), "m.csv:2", {"2e9", "1e9"}));
}

}  // namespace
}  // namespace microswarm::actuation

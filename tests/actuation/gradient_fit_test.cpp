// SPDX-License-Identifier: Apache-2.0
// Gradients in a calibration: what made the fields is found again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <iostream>
#include <random>

#include "microswarm/actuation/coils/calibration.hpp"
#include "microswarm/actuation/coils/measurement_plan.hpp"
#include "microswarm/actuation/coils/mpem.hpp"
#include "microswarm/actuation/coils/text_rows.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/text/file.hpp"
#include "tests/actuation/support.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

CoilSystem helmholtz() {
  return read_coil_system(MICROSWARM_SOURCE_DIR "/scenarios/rigs/helmholtz.yaml");
}

/// The centre and `reach` along both ways of each axis.
std::vector<Eigen::Vector3d> cross(const Eigen::Vector3d& centre, double reach) {
  std::vector<Eigen::Vector3d> positions{centre};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1, 1})
      positions.emplace_back(centre + side * reach * Eigen::Vector3d::Unit(axis));
  return positions;
}

/// Measures the plan in a system, with the noise of a probe [mT].
FieldMeasurements measure(const CoilSystem& system, const std::vector<Eigen::Vector3d>& positions,
                          double noise, const FieldGradient& ambient = {}) {
  std::mt19937_64 source(7);
  std::normal_distribution<double> normal(0, 1);
  FieldMeasurements measured{.file = "m.csv", .coils = system.coil_names()};
  int line = 1;
  for (const MeasurementStep& step :
       measurement_plan(system, {.positions = positions, .levels = 2, .pairs = true})) {
    Eigen::Vector3d b = system.at(step.position).total_field(step.currents) + ambient.field +
                        ambient.gradient * step.position;
    for (double& component : b) component += noise * normal(source);
    measured.rows.push_back({step.currents, step.position, b, ++line});
  }
  return measured;
}

CoilSystem system_with(const FittedMatrix& fit) {
  CoilSystemParams params;
  params.coils = fit.coils;
  return CoilSystem(read_yaml_text<CoilSystemParams>(to_yaml(params), "fitted.yaml"),
                    "fitted.yaml");
}

TEST(GradientFit, FindsAnyFieldAndGradientInFreeSpaceExactly) {
  test::Dice dice(3);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 1 + trial % 5;
    MatrixCoils truth;
    truth.field.assign(3, {});
    truth.gradient.assign(5, {});
    for (int i = 0; i < n; ++i) {
      truth.names.push_back(fmt::format("c{}", i));
      for (auto& row : truth.field) row.push_back(3 * dice.number());
      for (auto& row : truth.gradient) row.push_back(40 * dice.number());
    }
    for (double& x : truth.offset) x = dice.number();
    for (double& x : truth.offset_gradient) x = dice.number();
    truth.centre = {1000 * dice.number(), 1000 * dice.number(), 1000 * dice.number()};
    CoilSystemParams params;
    params.coils = truth;
    params.amplifiers = {{.max_current = 5}};
    const CoilSystem system(params);
    // Three positions of a plane are enough.
    const std::vector<Eigen::Vector3d> positions{1000 * dice.vector(), 1000 * dice.vector(),
                                                 1000 * dice.vector()};
    const Eigen::Vector3d centre(truth.centre.data());
    const FittedMatrix fit = fit_matrix(measure(system, positions, 0),
                                        {.offset = true, .gradients = true, .centre = centre});
    const Actuation found = system_with(fit).at(centre), expected = system.at(centre);
    EXPECT_LE((found.field - expected.field).norm(), 1e-9);
    EXPECT_LE((found.gradients - expected.gradients).norm(), 1e-9 * mt_per_um_of_t_per_m * 100);
    EXPECT_LE((found.offset.field - expected.offset.field).norm(), 1e-9);
    EXPECT_LE((found.offset.gradient - expected.offset.gradient).norm(), 1e-10);
    EXPECT_LE(fit.worst, 1e-9);
    // Law: a field in free space has neither sources nor curl, and the system says its field.
    for (int i = 0; i < n; ++i) {
      const Eigen::Matrix3d G = gradient_matrix(FiveGradients(found.gradients.col(i)));
      EXPECT_EQ(G, G.transpose());
      EXPECT_NEAR(G.trace(), 0, 1e-15);
    }
    const Eigen::Vector3d p = 5000 * dice.vector();
    const CoilSystem fitted = system_with(fit);
    const Eigen::VectorXd I = Eigen::VectorXd::LinSpaced(n, -1, 2);
    const auto field = [&](const Eigen::Vector3d& q) { return fitted.at(q).total_field(I); };
    EXPECT_LE((test::difference_gradient(field, p, 10) - fitted.at(p).total_gradient(I)).norm(),
              1e-9);
  }
}

TEST(GradientFit, FindsAHelmholtzSystemWithinItsStandardErrors) {
  const CoilSystem system = helmholtz();
  const Eigen::Vector3d centre(25000, -20000, 18000);
  const double noise = 0.02;
  const FieldMeasurements measured = measure(system, cross(centre, 800), noise);
  const FittedMatrix fit = fit_matrix(measured, {.offset = true, .gradients = true});
  const Actuation found = system_with(fit).at(centre), truth = system.at(centre);
  EXPECT_EQ(Eigen::Vector3d(fit.coils.centre.data()), centre);
  const Eigen::Array33d fields = (found.field - truth.field).cwiseAbs().array();
  const Eigen::ArrayXXd gradients =
      (found.gradients - truth.gradients).cwiseAbs().array() / mt_per_um_of_t_per_m;
  // 5 σ of the noise: the field's curvature within 0.8 mm is far below it.
  EXPECT_TRUE((fields < 5 * fit.field_errors.array()).all()) << fields << '\n' << fit.field_errors;
  EXPECT_TRUE((gradients < 5 * fit.gradient_errors.array()).all()) << gradients << '\n'
                                                                   << fit.gradient_errors;
  EXPECT_GT(truth.gradients.norm() / mt_per_um_of_t_per_m, 5 * fit.gradient_errors.maxCoeff());
  // The standard errors are those of the noise: they are neither vain nor shy.
  EXPECT_GT((fields / fit.field_errors.array()).maxCoeff(), 0.5);
  EXPECT_NEAR(fit.total_rms, noise * std::sqrt(3), 0.1 * noise);
  EXPECT_LT(largest_error(fit)->share, 0.01);
  const FittedMatrix uniform = fit_matrix(measured, {.offset = true});
  EXPECT_GT(uniform.total_rms, 1.5 * fit.total_rms);
}

TEST(GradientFit, StandardErrorsAreTheSpreadOfManyFits) {
  test::Dice dice(5);
  const CoilSystem system = helmholtz();
  const std::vector<Eigen::Vector3d> positions = cross({0, 0, 0}, 2000);
  FieldMeasurements measured = measure(system, positions, 0);
  const std::vector<FieldMeasurement> exact = measured.rows;
  constexpr int fits = 300;
  for (const bool with : {false, true}) {
    double squares = 0, errors = 0;
    for (int i = 0; i < fits; ++i) {
      for (std::size_t r = 0; r < exact.size(); ++r)
        measured.rows[r].field = exact[r].field + 0.1 * dice.vector();
      const FittedMatrix fit = fit_matrix(measured, {.offset = true, .gradients = with});
      const double off = with ? fit.coils.gradient[1][2] : fit.coils.field[0][2];
      squares += off * off / fits;
      const double error = with ? fit.gradient_errors(1, 2) : fit.field_errors(0, 2);
      errors += error * error / fits;
    }
    EXPECT_NEAR(std::sqrt(squares / errors), 1, 0.12) << with;
  }
}

TEST(GradientFit, RefusesWhatPositionsDoNotTell) {
  const CoilSystem system = helmholtz();
  const auto refusal = [&](const std::vector<Eigen::Vector3d>& positions, bool offset = true) {
    return test::error_of(
        [&] { fit_matrix(measure(system, positions, 0), {.offset = offset, .gradients = true}); });
  };
  EXPECT_TRUE(test::is_one_line_naming(
      refusal({{0, 0, 0}}), "m.csv",
      {"15", "dBx/dx", "dBx/dy", "dBx/dz", "dBy/dy", "dBy/dz", "x", "y", "z", "positions"}));
  // On a line along x the gradients along it are known, and no others.
  const std::string line = refusal({{0, 0, 0}, {1000, 0, 0}, {2500, 0, 0}});
  EXPECT_TRUE(test::is_one_line_naming(line, "m.csv", {"dBy/dy", "dBy/dz", "without current"}));
  EXPECT_FALSE(test::names(line, "dBx/dx")) << line;
  EXPECT_FALSE(determines_gradients(measure(system, {{0, 0, 0}}, 0), {}));
  EXPECT_TRUE(determines_gradients(measure(system, {{0, 0, 0}, {9, 0, 0}, {0, 0, 9}}, 0), {}));
  // One coil was only measured at one of them.
  FieldMeasurements some = measure(system, cross({0, 0, 0}, 1000), 0);
  std::erase_if(some.rows, [](const FieldMeasurement& row) {
    return row.currents[1] != 0 && !row.position.isZero();
  });
  const std::string why =
      test::error_of([&] { fit_matrix(some, {.offset = true, .gradients = true}); });
  EXPECT_TRUE(test::names(why, "'y'")) << why;
  EXPECT_FALSE(test::names(why, "'x'") || test::names(why, "'z'")) << why;
}

TEST(GradientFit, AFileWithoutFreedomHasNoErrors) {
  FieldMeasurements measured{.file = "m.csv", .coils = {"a"}};
  measured.rows.push_back({Eigen::VectorXd::Ones(1), {0, 0, 0}, {1, 2, 3}, 2});
  const FittedMatrix fit = fit_matrix(measured);
  EXPECT_EQ(fit.freedom, 0u);
  EXPECT_TRUE(std::isnan(fit.field_errors(0, 0)));
}

TEST(GradientFit, AMatrixFileMustHaveFiveRowsOfGradients) {
  const auto refusal = [](const std::string& more) {
    return test::error_of([&] {
      const std::string text =
          "coils: {type: matrix, names: [a], field_mt_per_a: [[1], [1], [1]], " + more + "}";
      CoilSystem(read_yaml_text<CoilSystemParams>(text, "rig.yaml"), "rig.yaml");
    });
  };
  EXPECT_TRUE(test::names(refusal("gradient_t_per_m_per_a: [[1], [1], [1]]"), "must have 5"));
  EXPECT_TRUE(test::names(refusal("gradient_t_per_m_per_a: [[1], [1], [1, 2], [1], [1]]"),
                          "row 3 of gradient_t_per_m_per_a has 2 numbers"));
  EXPECT_TRUE(test::names(refusal("offset_gradient_t_per_m: [1]"), "must have 5"));
  EXPECT_TRUE(test::names(refusal("centre_um: [1]"), "centre_um"));
}

/// The calibrations of OctoMag, MagBed and Navion tabulate fields at seven positions; those within
/// 4 mm of the origin are taken as measurements.
TEST(GradientFitData, GradientsNearTheCentreAreThoseOfTheMultipoles) {
  const std::filesystem::path folder = test::data_folder() / "magcal";
  if (test::data_folder().empty()) GTEST_SKIP() << "no folder MICROSWARM_DATA";
  for (const char* name : {"OctoMag_Calibration", "MagBed_Calibration_03-07-2018",
                           "Navion_2_Calibration_24-02-2020"}) {
    const std::string text = read_file(folder / (std::string(name) + ".expected_fields.csv"));
    TextRows rows(text, name);
    ASSERT_TRUE(rows.next());
    const std::size_t coils = rows.pieces(',').size() - 12;
    FieldMeasurements measured{.file = name};
    for (std::size_t i = 0; i < coils; ++i) measured.coils.push_back(fmt::format("c{}", i));
    while (rows.next()) {
      const auto cells = rows.pieces(',');
      const auto number = [&](std::size_t i) { return rows.number(cells[i], "value"); };
      FieldMeasurement row{.currents = Eigen::VectorXd(static_cast<Eigen::Index>(coils)),
                           .line = rows.line()};
      for (std::size_t i = 0; i < coils; ++i)
        row.currents[static_cast<Eigen::Index>(i)] = number(3 + i);
      for (std::size_t k = 0; k < 3; ++k) {
        row.position[static_cast<Eigen::Index>(k)] = 1e6 * number(k);
        row.field[static_cast<Eigen::Index>(k)] = 1e3 * number(3 + coils + k);
      }
      if (row.position.norm() < 4500) measured.rows.push_back(row);
    }
    const FitOptions options{.gradients = true, .centre = Eigen::Vector3d::Zero()};
    const FittedMatrix fit = fit_matrix(measured, options);
    const FittedMatrix uniform = fit_matrix(measured);
    CoilSystemParams params;
    params.coils = MpemCoils{std::string(name) + ".yaml"};
    const Actuation truth = CoilSystem(params, {}, folder).at(Eigen::Vector3d::Zero());
    const Actuation found = system_with(fit).at(Eigen::Vector3d::Zero());
    double fields = 0, gradients = 0;
    for (Eigen::Index i = 0; i < truth.field.cols(); ++i) {
      fields =
          std::max(fields, (found.field - truth.field).col(i).norm() / truth.field.col(i).norm());
      gradients = std::max(gradients, (found.gradients - truth.gradients).col(i).norm() /
                                          truth.gradients.col(i).norm());
    }
    std::cout << name << ": " << measured.rows.size() << " rows, fields within " << fields
              << ", gradients within " << gradients << ", RMS residual " << fit.total_rms
              << " mT, without gradients " << uniform.total_rms << " mT\n";
    EXPECT_LT(fields, 0.01) << name;
    EXPECT_LT(gradients, 0.15) << name;
    EXPECT_LT(fit.total_rms, 0.2 * uniform.total_rms) << name;
  }
}

}  // namespace
}  // namespace microswarm::actuation

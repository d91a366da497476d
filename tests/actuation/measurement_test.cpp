// SPDX-License-Identifier: Apache-2.0
// Plan, log and probe of a guided measurement.
#include <gtest/gtest.h>

#include <fstream>

#include "microswarm/actuation/amplifiers/amplifiers.hpp"
#include "microswarm/actuation/coils/measurement_log.hpp"
#include "microswarm/actuation/coils/measurement_plan.hpp"
#include "microswarm/actuation/coils/probe_file.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

CoilSystem two_coils(std::vector<AmplifierParams> amplifiers) {
  CoilSystemParams params;
  params.coils = MatrixCoils{.names = {"a", "b"}, .field = {{1, 0}, {0, 1}, {0, 0}}};
  params.amplifiers = std::move(amplifiers);
  return CoilSystem(params);
}

TEST(MeasurementPlan, HoldsEveryCurrentForEver) {
  const CoilSystem system = two_coils(
      {{.thermal_resistance = 2, .max_current = 10, .max_temperature = 60}, {.max_current = 2.47}});
  const auto steps =
      measurement_plan(system, {.positions = {{0, 0, 0}, {5, 0, 0}}, .levels = 2, .pairs = true});
  ASSERT_EQ(steps.size(), 2u * (1 + 2 * 2 * 2 + 1));
  for (const MeasurementStep& step : steps)
    EXPECT_EQ(Amplifiers(system.amplifiers()).steady(step.currents).scale, 1);
  EXPECT_TRUE(steps[0].currents.isZero());
  EXPECT_LT(steps[2].currents[0], 4.5);  // heat allows less than the current's limit
  EXPECT_NEAR(steps[1].currents[0], 0.5 * steps[2].currents[0], 1e-12);
  EXPECT_EQ(steps[6].currents[1], 1.9);  // 80 %, two digits
  EXPECT_EQ(steps[9].currents, Eigen::VectorXd(steps[2].currents + steps[6].currents));
  EXPECT_EQ(steps[10].position, Eigen::Vector3d(5, 0, 0));
}

TEST(MeasurementPlan, RefusesCurrentsThatCannotBeHeld) {
  const auto refusal = [](const std::vector<AmplifierParams>& amplifiers,
                          std::optional<double> current) {
    return test::error_of([&] {
      measurement_plan(two_coils(amplifiers), {.positions = {{0, 0, 0}}, .current = current});
    });
  };
  EXPECT_TRUE(test::is_one_line_naming(refusal({{.max_current = 3}, {.max_current = 2}}, 2.5), "",
                                       {"b", "2 A", "2.5 A"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal({{.max_current = 3}, {}}, {}), "", {"b", "limits"}));
  EXPECT_TRUE(test::is_one_line_naming(refusal({{.ambient = 70, .max_temperature = 60}}, {}), "",
                                       {"a", "no current"}));
}

TEST(MeasurementPlan, ARowMeetsOneStep) {
  const CoilSystem system = two_coils({{.max_current = 10}});
  const auto steps = measurement_plan(system, {.positions = {{0, 0, 0}, {9, 0, 0}}});
  std::vector<FieldMeasurement> rows;
  EXPECT_EQ(missing_steps(steps, rows).size(), 10u);
  const auto measured = [&](const Eigen::VectorXd& currents, const Eigen::VectorXd& planned,
                            const Eigen::Vector3d& position) {
    rows.push_back({currents, position, {}, 2, planned});
  };
  measured(0.6 * steps[1].currents, steps[1].currents, {0, 0, 0});  // limited by the device
  measured(steps[2].currents, Eigen::Vector2d(1, 2), {0, 0, 0});    // another's
  rows.push_back({steps[2].currents, {0, 0, 0}, {}, 3});            // not known of which
  measured(steps[0].currents, steps[0].currents, {9, 0, 0});
  measured(steps[0].currents, steps[0].currents, {9, 0, 0});
  const auto missing = missing_steps(steps, rows);
  EXPECT_EQ(missing.size(), 8u);
  EXPECT_EQ(missing[0].currents, steps[0].currents);
  EXPECT_EQ(missing[1].currents, steps[2].currents);
}

TEST(MeasurementLog, IsCompleteAfterEachRowAndGoesOn) {
  const test::Folder folder;
  const auto file = folder / "measured.csv";
  {
    MeasurementLog log(file, {"a", "b+"});
    EXPECT_FALSE(std::filesystem::exists(file));
    log.add(Eigen::Vector2d(1, -0.1), Eigen::Vector2d(2, -0.2), {10, 0, 0}, {.mean = {1, 2, 3}});
    log.add(Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0), {0, 0, 0},
            mean_reading({{1, 0, 0}, {2, 0, 0}, {3, 0, 0.1 + 0.2}}));
    EXPECT_EQ(read_measurements(file).rows.size(), 2u);
  }
  std::ofstream(file, std::ios::app) << "# a remark\n\n";
  MeasurementLog log(file, {"a", "b+"});
  ASSERT_EQ(log.measured().rows.size(), 2u);
  EXPECT_EQ(log.measured().rows[0].currents, Eigen::VectorXd(Eigen::Vector2d(1, -0.1)));
  EXPECT_EQ(log.measured().rows[0].planned, Eigen::VectorXd(Eigen::Vector2d(2, -0.2)));
  EXPECT_EQ(log.measured().rows[1].field, Eigen::Vector3d(2, 0, (0.1 + 0.2) / 3));
  EXPECT_NE(read_file(file).find(",3,1,0,"), std::string::npos);
  log.add(Eigen::Vector2d(2, 0), Eigen::Vector2d(2, 0), {0, 0, 0}, {.mean = {4, 5, 6}});
  EXPECT_EQ(read_measurements(file).rows[2].line, log.measured().rows[2].line);
  log.remove_last();
  log.remove_last();
  EXPECT_EQ(read_measurements(file).rows.size(), 1u);
  log.remove_last();
  log.remove_last();
  EXPECT_TRUE(log.measured().rows.empty());
  log.add(Eigen::Vector2d(2, 0), Eigen::Vector2d(2, 0), {0, 0, 0}, {.mean = {4, 5, 6}});
  EXPECT_EQ(read_measurements(file).rows.size(), 1u);
}

TEST(MeasurementLog, RefusesAnothersFile) {
  const test::Folder folder;
  const auto file = folder.with("m.csv", "# note\ni_a_a,bx_mt,by_mt,bz_mt\n1,2,3,4\n");
  EXPECT_TRUE(test::is_one_line_naming(test::error_of([&] { MeasurementLog(file, {"a"}); }),
                                       file.string() + ":2", {"columns", "readings"}));
  EXPECT_TRUE(test::names(test::error_of([&] { MeasurementLog(folder / "n.csv", {"a,b"}); }),
                          "'a,b' cannot be"));
}

TEST(ProbeFile, OnlyRowsThatBeginLaterCount) {
  const test::Folder folder;
  const auto file = folder.with("probe.csv", "time,bz_mt,bx_mt,by_mt\n0,9,9,9\n1,8,");
  std::ofstream out(file, std::ios::app);
  const auto more = [&](const char* text) { (out << text).flush(); };
  ProbeFile probe(file);
  std::vector<Eigen::Vector3d> fields;
  probe.skip_to_end();
  more("7,6\n2,3,1,");
  probe.read(fields);
  EXPECT_TRUE(fields.empty());
  more("2\r\n\n# a remark\n3,6,4,5\n");
  probe.read(fields);
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_EQ(fields[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(fields[1], Eigen::Vector3d(4, 5, 6));
  more("4,1,2\n");
  EXPECT_TRUE(test::names(test::error_of([&] { probe.read(fields); }), "has 3 fields"));
  std::filesystem::resize_file(file, 30);
  EXPECT_TRUE(test::names(test::error_of([&] { probe.read(fields); }), "cut short"));
}

TEST(ProbeFile, ARepeatedReadingIsOne) {
  ProbeRows rows("t_s,bx_mt,by_mt,bz_mt", "p");
  std::vector<Eigen::Vector3d> fields;
  rows.take("1,1,2,3\n1,1,2,3\n0.5,1,2,3\n1.01,4,5,6\n", fields);
  EXPECT_EQ(fields.size(), 2u);
}

TEST(ProbeFile, SemicolonsQuotesAndDecimalCommasAreRead) {
  ProbeRows rows("\"t_s\";\"bx_mt\";\"by_mt\";\"bz_mt\"", "p");
  std::vector<Eigen::Vector3d> fields;
  rows.take("0,5;1,25;2;3\n", fields);
  ASSERT_EQ(fields.size(), 1u);
  EXPECT_EQ(fields[0], Eigen::Vector3d(1.25, 2, 3));
}

TEST(ProbeFile, RefusesInOneLine) {
  const test::Folder folder;
  const auto opened = [&](const std::string& text) {
    return test::error_of([&] { ProbeFile probe(folder.with("p.csv", text)); });
  };
  const std::string name = (folder / "p.csv").string();
  EXPECT_TRUE(test::is_one_line_naming(opened(""), name, {"header", "bx_mt"}));
  EXPECT_TRUE(test::is_one_line_naming(opened("bx_mt,by_mt\n"), name, {"bz_mt", "missing"}));
  EXPECT_TRUE(
      test::names(test::error_of([&] { ProbeFile probe(folder / "none"); }), "cannot read"));
  EXPECT_TRUE(test::names(test::error_of([&] { ProbeFile probe("/dev/zero"); }), "regular file"));
  const auto taken = [](const std::string& text) {
    ProbeRows rows("bx_mt,by_mt,bz_mt", "p");
    std::vector<Eigen::Vector3d> fields;
    return test::error_of([&] { rows.take(text, fields); });
  };
  EXPECT_TRUE(test::is_one_line_naming(taken("1,2,x\n"), "p", {"'x'", "number"}));
  EXPECT_TRUE(test::is_one_line_naming(taken("1,2,nan\n"), "p", {"'nan'"}));
  EXPECT_TRUE(test::is_one_line_naming(taken("1,2,1e9\n"), "p", {"'1e9'", "10000"}));
  EXPECT_TRUE(test::is_one_line_naming(taken(std::string(9000, '1')), "p", {"4096"}));
}

}  // namespace
}  // namespace microswarm::actuation

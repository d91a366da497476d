// SPDX-License-Identifier: Apache-2.0
// `rig calibrate --measure` as a program: an operator at a pseudo-terminal, or a probe's logger,
// answers with the field of a known system for the currents that a device at another one has.
#include "measured_rig.hpp"

namespace microswarm::test {
namespace {

TEST_F(RigMeasure, AnOperatorIsGuidedToMatrixAndGradients) {
  Terminal terminal(arguments({"--positions", "0,0,0;5000,0,0;0,5000,0", "--gradients"}), at);
  for (const Eigen::Vector3d& position : {Eigen::Vector3d(0, 0, 0), {5000, 0, 0}, {0, 5000, 0}}) {
    ASSERT_TRUE(terminal.hears("then Enter")) << terminal.said();
    EXPECT_EQ(currents().norm(), 0);
    terminal.press("\r");
    position.isZero() ? answer_first(terminal, 7, position) : answer(terminal, 7, position);
  }
  EXPECT_EQ(terminal.wait(), 0) << terminal.said();
  EXPECT_EQ(rows(), 21u);
  expect_truth("fitted.yaml", 1e-5);
  const actuation::CoilSystem system = actuation::read_coil_system(at.folder / "fitted.yaml");
  EXPECT_EQ(system.name(), "bench coils");
  EXPECT_EQ(system.amplifiers().at(0).max_temperature, 90);
  EXPECT_EQ(system.amplifiers().at(0).max_current, 12);  // that of the file, not the driver's 10 A
  EXPECT_EQ(system.centre(), Eigen::Vector3d(2500, 2500, 0));
  const Eigen::MatrixXd gradients =
      system.at({0, 0, 0}).gradients / actuation::mt_per_um_of_t_per_m;
  EXPECT_LE((gradients - truth_G).cwiseAbs().maxCoeff(), 1e-3) << gradients;
  // The file is one that is fitted without coils, and the field elsewhere has the gradients in it.
  good({"rig", "calibrate", "measured.csv", "--gradients", "--offset"});
  const Json field = Json::parse(good(
      {"rig", "field", "fitted.yaml", "--at", "1000,-2000,500", "--currents", "1,2,-1", "--json"}));
  const Eigen::Vector3d I(1, 2, -1);
  const Eigen::Vector3d expected =
      truth_A * I + Eigen::Vector3d(0.02, -0.03, 0.045) +
      actuation::gradient_matrix(actuation::FiveGradients(truth_G * I)) *
          actuation::mt_per_um_of_t_per_m * Eigen::Vector3d(1000, -2000, 500);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(field["field_mt"][k].get<double>(), expected[k], 1e-3);
  EXPECT_TRUE(names(good({"rig", "map", "fitted.yaml", "--points", "5"}), "centre"));
}

TEST_F(RigMeasure, WhatIsNoFieldIsAskedAgain) {
  Terminal terminal(arguments(), at);
  ASSERT_TRUE(terminal.hears("then Enter")) << terminal.said();
  terminal.press("sure\r");
  ASSERT_TRUE(terminal.hears("is needed")) << terminal.said();
  begin(terminal);
  for (const auto& [wrong, complaint] : std::vector<std::pair<std::string, std::string>>{
           {"much\r", "three numbers are needed"},
           {"1 nan 2\r", "'nan' is no field"},
           {"1 2\r", "three numbers are needed"},
           {"1e9 0 0\r", "'1e9' is no field of at most 10000 mT"},
           {"\r", "three numbers are needed"},
           {"1;2;3\r", "three numbers are needed"},
           {"0x1 2 3\r", "'0x1' is no field"}}) {
    ASSERT_TRUE(terminal.hears(question)) << terminal.said();
    terminal.press(wrong);
    ASSERT_TRUE(terminal.hears(complaint)) << wrong << terminal.said();
  }
  EXPECT_FALSE(exists("measured.csv"));
  // Backspace and Ctrl-U edit; r puts the current in again; b takes the last one back.
  ASSERT_TRUE(terminal.hears(question)) << terminal.said();
  terminal.press(
      "77\x15"
      "0.02 -0.03 0.0459\x7f\r");
  skip_clamp(terminal);
  ASSERT_TRUE(terminal.hears("2/7: 4 A in x")) << terminal.said();
  EXPECT_TRUE(read("measured.csv").ends_with("0,0,0,0,0,0,0.02,-0.03,0.045,1,,,,0,0,0\n"));
  ASSERT_TRUE(terminal.hears(question));
  terminal.press("r\r");
  ASSERT_TRUE(terminal.hears("2/7: 4 A in x")) << terminal.said();
  ASSERT_TRUE(terminal.hears(question));
  terminal.press("b\r");
  ASSERT_TRUE(terminal.hears("1/7: no current")) << terminal.said();
  EXPECT_EQ(rows(), 0u);
  answer(terminal, 7, {0, 0, 0});
  EXPECT_EQ(terminal.wait(), 0) << terminal.said();
  expect_truth("fitted.yaml", 1e-5);
}

TEST_F(RigMeasure, WhatWasMeasuredIsKeptAndItGoesOn) {
  {
    Terminal terminal(arguments(), at);
    begin(terminal);
    answer_first(terminal, 2, {0, 0, 0});
    ASSERT_TRUE(terminal.hears(question));
    EXPECT_GT(currents().norm(), 3);
    terminal.press("1 2\x03");  // Ctrl-C amid an answer
    EXPECT_EQ(terminal.wait(), 3) << terminal.said();
    EXPECT_TRUE(names(terminal.said(), "2 of 7 measurements")) << terminal.said();
    EXPECT_EQ(currents().norm(), 0);
    EXPECT_EQ(rows(), 2u);
  }
  {
    Terminal terminal(arguments(), at);
    begin(terminal);
    answer(terminal, 2, {0, 0, 0});
    ASSERT_TRUE(terminal.hears(question));
    terminal.send(SIGKILL);
    EXPECT_EQ(terminal.wait(), -SIGKILL);
    EXPECT_EQ(rows(), 4u);
  }
  Terminal terminal(arguments(), at);
  begin(terminal);
  ASSERT_TRUE(terminal.hears("5/7: -4 A in y")) << terminal.said();
  answer(terminal, 3, {0, 0, 0});
  EXPECT_EQ(terminal.wait(), 0) << terminal.said();
  expect_truth("fitted.yaml", 1e-5);
  // All is measured: nothing is driven any more.
  const int arms = device.count(actuation::CoilMessage::arm);
  EXPECT_EQ(run(arguments()).code, 0);
  EXPECT_EQ(device.count(actuation::CoilMessage::arm), arms);
}

TEST_F(RigMeasure, SilenceTurnsTheCoilsOff) {
  Terminal terminal(arguments({"--hold", "0.4"}), at);
  begin(terminal);
  answer(terminal, 1, {0, 0, 0});
  skip_clamp(terminal);
  ASSERT_TRUE(terminal.hears(question));
  ASSERT_TRUE(terminal.hears("no answer in 0.4 s")) << terminal.said();
  EXPECT_EQ(currents().norm(), 0);
  sleep_ms(300);
  EXPECT_EQ(currents().norm(), 0);
  terminal.press("\r");
  ASSERT_TRUE(terminal.hears(question)) << terminal.said();
  EXPECT_GT(currents().norm(), 3);
  ASSERT_TRUE(terminal.hears("no answer in 0.4 s")) << terminal.said();
  terminal.press("q\r");
  EXPECT_EQ(terminal.wait(), 3) << terminal.said();
  EXPECT_EQ(rows(), 1u);
}

TEST_F(RigMeasure, EscStopsAtOnceAlsoAmidAnAnswer) {
  Terminal terminal(arguments(), at);
  begin(terminal);
  answer(terminal, 1, {0, 0, 0});
  skip_clamp(terminal);
  ASSERT_TRUE(terminal.hears(question));
  const int sets = device.count(actuation::CoilMessage::set),
            stops = device.count(actuation::CoilMessage::stop);
  terminal.press("1.5 \x1b");
  EXPECT_EQ(terminal.wait(), 4) << terminal.said();
  EXPECT_TRUE(names(terminal.said(), "emergency key")) << terminal.said();
  EXPECT_GT(device.count(actuation::CoilMessage::stop), stops);
  EXPECT_LT(device.count(actuation::CoilMessage::set) - sets, 40);
  EXPECT_EQ(currents().norm(), 0);
  EXPECT_EQ(rows(), 1u);
}

TEST_F(RigMeasure, ADeviceThatFallsSilentIsAFaultAndTheRowsAreKept) {
  std::atomic<bool> silent = false;
  FakeDevice other([&](actuation::CoilReply& reply) {
    hear(reply);
    return !silent;
  });
  Terminal terminal(arguments({"--set", "driver.port=" + other.port()}), at);
  begin(terminal);
  answer(terminal, 1, {0, 0, 0});
  skip_clamp(terminal);
  ASSERT_TRUE(terminal.hears(question)) << terminal.said();
  silent = true;
  EXPECT_EQ(terminal.wait(), 4) << terminal.said();
  EXPECT_TRUE(names(terminal.said(), "does not answer")) << terminal.said();
  EXPECT_EQ(rows(), 1u);
}

TEST_F(RigMeasure, AProbesLoggerIsReadWithoutAnOperator) {
  const Logger logger(at.folder / "probe.csv", [&] { return truth(); });
  const Outcome outcome =
      run(arguments({"--probe", "probe.csv", "--dwell", "0.4", "--other-stop", "--json"}));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  expect_truth("fitted.yaml", 0.01);
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["measurements"], 7);
  EXPECT_LT(json["largest_error"].get<double>(), 0.05);
  const auto table = read("measured.csv");
  const auto lines = split(table, '\n');
  const auto cells = split(lines[1], ',');
  EXPECT_GT(std::stoi(std::string(cells[9])), 5);
  EXPECT_NEAR(std::stod(std::string(cells[10])), 0.01, 0.005);
}

TEST_F(RigMeasure, AProbeThatStopsIsToldInOneLine) {
  write("probe.csv", "bx_mt,by_mt,bz_mt\n1,2,3\n");
  const Outcome outcome = run(arguments({"--probe", "probe.csv", "--other-stop"}));
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "probe.csv: no new row in 5 s after '1,2,3'")) << outcome.err;
  EXPECT_EQ(currents().norm(), 0);
  write("broken.csv", "bx,by_mt,bz_mt\n");
  refused(arguments({"--probe", "broken.csv", "--other-stop"}),
          naming("broken.csv", {"bx_mt", "missing"}));
  EXPECT_FALSE(exists("measured.csv"));
}

TEST_F(RigMeasure, ALimitOfTheDeviceIsToldAndItEnds) {
  device.limit(1, 250);
  {
    Terminal terminal(arguments(), at);
    begin(terminal);
    answer_first(terminal, 3, {0, 0, 0});
    ASSERT_TRUE(terminal.hears("the device limits y to 2.")) << terminal.said();
    ASSERT_TRUE(terminal.hears("of 4 A")) << terminal.said();
    answer(terminal, 1, {0, 0, 0});
    ASSERT_TRUE(terminal.hears("5/7: -4 A in y")) << terminal.said();
    terminal.press("\x03");
    EXPECT_EQ(terminal.wait(), 3) << terminal.said();
  }
  Terminal terminal(arguments(), at);
  begin(terminal);
  ASSERT_TRUE(terminal.hears("5/7: -4 A in y")) << terminal.said();
  answer(terminal, 3, {0, 0, 0});
  EXPECT_EQ(terminal.wait(), 0) << terminal.said();
  EXPECT_EQ(rows(), 7u);
  expect_truth("fitted.yaml", 1e-5);
  // All is measured: nothing is driven any more. Another current is another measurement.
  const int arms = device.count(actuation::CoilMessage::arm);
  EXPECT_EQ(run(arguments()).code, 0);
  EXPECT_EQ(device.count(actuation::CoilMessage::arm), arms);
  Arguments stronger = arguments();
  *std::ranges::find(stronger, "4") = "4.5";
  Terminal again(stronger, at);
  begin(again);
  skip_clamp(again);
  EXPECT_TRUE(again.hears("2/7: 4.5 A in x")) << again.said();
}

TEST_F(RigMeasure, ALimitOfTheDeviceEndsWithAProbeToo) {
  device.limit(0, 250);
  const Logger logger(at.folder / "probe.csv", [&] { return truth(); });
  const Outcome outcome =
      run(arguments({"--probe", "probe.csv", "--dwell", "0.2", "--other-stop"}));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "the device limits x to 2.")) << outcome.err;
  EXPECT_EQ(rows(), 7u);
}

TEST_F(RigMeasure, ADeviceThatLetsNoCurrentThroughEndsIt) {
  device.limit(0, 0);
  write("probe.csv", "bx_mt,by_mt,bz_mt\n");
  const Logger logger(at.folder / "probe.csv", [&] { return truth(); });
  const Outcome outcome =
      run(arguments({"--probe", "probe.csv", "--dwell", "0.2", "--other-stop"}));
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  // The drive and the measurement both notice it after about a second.
  EXPECT_TRUE(names(outcome.err, "drives no current") || names(outcome.err, "0 A")) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "4 A in x")) << outcome.err;
  EXPECT_EQ(rows(), 1u);
  EXPECT_FALSE(exists("fitted.yaml"));
}

TEST_F(RigMeasure, AnswersFromAPipeDoNotRepeatAStepForEver) {
  std::string answers = "0 0 0\n";
  for (int i = 0; i < 20; ++i) answers += "r\n";
  write("answers.txt", answers);
  at.in = "answers.txt";
  const Outcome outcome = run(arguments({"--other-stop"}));
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "4 A in x") && names(outcome.err, "without a measurement"))
      << outcome.err;
}

TEST_F(RigMeasure, ADeadProbeGivesNoCalibration) {
  // Noise could look like an effect: how many rows a mean has depends on the time.
  const auto dead = [] { return Eigen::Vector3d(0.01, 0, 0); };
  const Logger logger(at.folder / "probe.csv", dead, 0);
  const Outcome outcome =
      run(arguments({"--probe", "probe.csv", "--dwell", "0.2", "--other-stop"}));
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "'x', 'y', 'z'")) << outcome.err;
  EXPECT_FALSE(exists("fitted.yaml"));
  const std::string coils = "i_x_a,i_y_a,bx_mt,by_mt,bz_mt\n";
  const Arguments fit{"rig", "calibrate", "m.csv", "--offset", "--out", "out.yaml"};
  write("m.csv", coils + "0,0,0,0,0\n1,0,0,0,0\n0,1,0,0,0\n-1,0,0,0,0\n0,-1,0,0,0\n");
  refused(fit, naming("m.csv", {"x", "y"}));
  write("m.csv", coils + "0,0,1,2,3\n1,0,2,2,3\n0,1,1,2,3\n-1,0,0,2,3\n0,-1,1,2,3\n");
  refused(fit, naming("m.csv", {"'y'"}));
  write("m.csv", coils + "0,0,1,2,3\n1,0,2,2,3\n0,1,1,2,3\n");  // just enough
  refused(fit, naming("m.csv", {"'y'"}));
}

TEST_F(RigMeasure, WhatCannotBeIsRefusedBeforeTheFirstCurrent) {
  const auto complaint = [&](const Arguments& more, const Complaint& expected) {
    Arguments all = arguments(more);
    all.emplace_back("--other-stop");
    refused(all, expected);
  };
  complaint({"--gradients"}, naming("--positions", {"dBx/dx", "dBy/dz", "x", "y", "z"}));
  complaint({"--gradients", "--positions", "0,0,0;1000,0,0;2000,0,0"},
            naming("--positions", {"dBy/dy", "dBy/dz"}));
  complaint({"--set", "driver.full_scale_a=3"}, naming("", {"x", "3 A", "4 A"}));
  complaint({"--positions", "none.csv"}, naming("none.csv", {"cannot read"}));
  complaint({"--positions", "nan,0,0"}, naming("--positions", {"three numbers", "'nan,0,0'"}));
  complaint({"--positions", "0,0"}, naming("--positions", {"three numbers", "'0,0'"}));
  complaint({"--positions", "0,0,0;1"}, naming("--positions", {"three numbers", "'0,0,0;1'"}));
  write("places.csv", "x_um,y_um,z_um\n0,0,0\n1,2\n");
  complaint({"--positions", "places.csv"}, naming("places.csv:3", {"2", "3"}));
  const std::string other = "i_a_a,bx_mt,by_mt,bz_mt\n1,2,3,4\n";
  write("measured.csv", other);
  complaint({}, naming("measured.csv:1", {"columns"}));
  EXPECT_EQ(read("measured.csv"), other);
  fs::remove(at.folder / "measured.csv");
  refused(arguments(), naming("", {"--other-stop"}));
  Arguments over = arguments();
  *std::ranges::find(over, "fitted.yaml") = "coils.yaml";
  refused(over, naming("coils.yaml", {"input"}));
  EXPECT_EQ(device.count(actuation::CoilMessage::set), 0);
}

}  // namespace
}  // namespace microswarm::test

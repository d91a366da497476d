// SPDX-License-Identifier: Apache-2.0
// `rig calibrate --measure` beside what it can know: the fields of the coil file, and a clamp
// meter.
#include "measured_rig.hpp"

namespace microswarm::test {
namespace {

TEST_F(RigMeasure, AnImplausibleAnswerIsAskedForAgainAndTakenIfItIsTheSame) {
  Terminal terminal(arguments(), at);
  begin(terminal);
  answer_first(terminal, 1, {0, 0, 0});
  for (const auto& [typed, complaint] : std::vector<std::pair<std::string, std::string>>{
           {"-7.6 0.2 -0.8\r", "a reversed coil or probe?"},
           {"76 2 -8\r", "gauss instead of mT?"},
           {"7.6 0.2 -0.8\r", ""}}) {
    ASSERT_TRUE(terminal.hears("2/7: 4 A in x")) << terminal.said();
    ASSERT_TRUE(terminal.hears(question)) << terminal.said();
    EXPECT_EQ(rows(), 1u);
    terminal.press(typed);
    ASSERT_TRUE(terminal.hears(complaint)) << terminal.said();
  }
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(terminal.hears("3/7: -4 A in x")) << terminal.said();
    ASSERT_TRUE(terminal.hears(question)) << terminal.said();
    EXPECT_EQ(rows(), 2u);
    terminal.press("0 -7.6 0\r");
  }
  ASSERT_TRUE(terminal.hears("taken after 2 readings")) << terminal.said();
  ASSERT_TRUE(terminal.hears("4/7: 4 A in y")) << terminal.said();
  EXPECT_EQ(rows(), 3u);
}

TEST_F(RigMeasure, AClampMeterShowsAWrongFullScale) {
  Terminal terminal(arguments(), at);
  begin(terminal);
  answer(terminal, 1, {0, 0, 0});
  ASSERT_TRUE(terminal.hears("4 A in x: amperes by a clamp meter")) << terminal.said();
  terminal.press("much\r");
  ASSERT_TRUE(terminal.hears("a current in A")) << terminal.said();
  ASSERT_TRUE(terminal.hears("amperes by a clamp meter")) << terminal.said();
  EXPECT_GT(currents().norm(), 3);
  terminal.press("8.1\r");
  EXPECT_EQ(terminal.wait(), 2) << terminal.said();
  EXPECT_TRUE(names(terminal.said(), "driver.full_scale_a is 10, must be")) << terminal.said();
  EXPECT_EQ(currents().norm(), 0);
  EXPECT_EQ(rows(), 1u);
  // Twice the current has heated four times as much.
  const auto state = at.folder / ".state/microswarm";
  const std::string kept = read_file(*fs::directory_iterator(state));
  EXPECT_TRUE(names(kept, "90")) << kept;
}

TEST_F(RigMeasure, AClampMeterThatAgreesIsInTheCommissioningRecord) {
  Terminal terminal(arguments({"--by", "ann"}), at);
  begin(terminal);
  answer(terminal, 1, {0, 0, 0});
  ASSERT_TRUE(terminal.hears("amperes by a clamp meter")) << terminal.said();
  terminal.press("4.05\r");
  ASSERT_TRUE(terminal.hears("2/7: 4 A in x")) << terminal.said();
  const std::string record = read("rig.commissioning.yaml");
  EXPECT_NE(record.find("what: current"), std::string::npos) << record;
  EXPECT_NE(record.find("4.05 A of 4 A"), std::string::npos) << record;
  EXPECT_NE(record.find("by: ann"), std::string::npos) << record;
}

TEST_F(RigMeasure, TheClampMeterIsAskedForAgainAndTheStepBeforeMayBe) {
  Terminal terminal(arguments({"--hold", "0.6"}), at);
  begin(terminal);
  answer(terminal, 1, {0, 0, 0});
  ASSERT_TRUE(terminal.hears("by a clamp meter")) << terminal.said();
  ASSERT_TRUE(terminal.hears("no answer in 0.6 s")) << terminal.said();
  terminal.press("\r");
  ASSERT_TRUE(terminal.hears("by a clamp meter")) << terminal.said();
  terminal.press("b\r");
  answer(terminal, 1, {0, 0, 0});
  skip_clamp(terminal);
  ASSERT_TRUE(terminal.hears("2/7: 4 A in x")) << terminal.said();
  EXPECT_EQ(rows(), 1u);
}

TEST_F(RigMeasure, EachCoilIsToldBesideTheFile) {
  const Logger logger(at.folder / "probe.csv", [&] { return truth(); });
  const Arguments probe = arguments({"--probe", "probe.csv", "--dwell", "0.2", "--other-stop"});
  const Outcome told = run(probe);
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_NE(read("rig.commissioning.yaml").find("what: field"), std::string::npos);
  for (const char* coil : {"coil x: 0.85 times", "coil y: 1.0", "coil z: 0.9"})
    EXPECT_TRUE(told.out.find(coil) != std::string::npos) << told.out;
  Arguments json = probe;
  json.emplace_back("--json");
  const Json fit = Json::parse(run(json).out);
  EXPECT_NEAR(fit["ratio_to_file"][0].get<double>(), 0.85, 0.02);
  EXPECT_LT(fit["angle_to_file_deg"][2].get<double>(), 15);
}

}  // namespace
}  // namespace microswarm::test

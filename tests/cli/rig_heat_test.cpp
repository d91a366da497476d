// SPDX-License-Identifier: Apache-2.0
// `rig heat` as a program: a log of a coil, and an operator who reads a voltmeter while it heats.
#include <chrono>

#include "measured_rig.hpp"
#include "microswarm/actuation/amplifiers/coil_heat.hpp"
#include "microswarm/actuation/coils/heat_fit.hpp"

namespace microswarm::test {
namespace {

const std::string sample =
    (fs::path(MICROSWARM_SOURCE_DIR) / "tests/samples/coils/heat.csv").string();

/// A small coil that heats within seconds, driven by the test's device.
class RigHeat : public RigMeasure {
 protected:
  RigHeat() { write_coils("max_current_a: 12, max_voltage_v: 24, max_temperature_degc: 90"); }

  static Arguments heat(const std::string& seconds = "4", const std::string& hold = "5") {
    return {"rig",   "heat",     "heat.csv",  "--measure", "rig.yaml", "--coil",
            "x",     "--heat",   seconds,     "--cool",    "4",        "--every",
            "0.2",   "--hold",   hold,        "--ambient", "22",       "--coils-cold",
            "--out", "out.yaml", "--current", "4"};
  }
  /// Answers with the voltage of the coil that heats as `coil` does, until the program ends.
  void read_voltmeter(Terminal& terminal) {
    using Seconds = std::chrono::duration<double>;
    double temperature = coil.ambient;
    auto before = std::chrono::steady_clock::now();
    const auto pass = [&] {
      const auto now = std::chrono::steady_clock::now();
      const double current = currents()[0];
      temperature = actuation::temperature_later(coil, temperature, current * current,
                                                 Seconds(now - before).count());
      before = now;
      return current * coil.resistance * (1 + coil.temperature_coefficient * (temperature - 20));
    };
    while (terminal.running()) {
      pass();
      if (terminal.hears("volts of coil x: ", 0)) terminal.press(std::to_string(pass()) + "\r");
      sleep_ms(5);
    }
  }

  actuation::AmplifierParams coil{
      .resistance = 1.2, .thermal_resistance = 2, .thermal_time = 1.5, .ambient = 22};
};

TEST_F(RigHeat, ALogIsFittedAndWritten) {
  const Json fit = Json::parse(good({"rig", "heat", sample, "--ambient", "22", "--json"}));
  EXPECT_NEAR(fit["resistance_ohm"]["value"].get<double>(), 0.92, 0.005);
  EXPECT_NEAR(fit["thermal_resistance_k_per_w"]["value"].get<double>(), 2.4, 0.1);
  EXPECT_NEAR(fit["thermal_time_s"]["value"].get<double>(), 410, 20);
  EXPECT_GT(fit["warmest_degc"].get<double>(), 50);
  const Outcome outcome = run({"rig", "heat", sample, "--coils", "coils.yaml", "--coil", "y",
                               "--coil", "z", "--ambient", "22", "--out", "out.yaml"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(names(outcome.err, "2 of 3 coils")) << outcome.err;
  const actuation::CoilSystem written = actuation::read_coil_system(at.folder / "out.yaml");
  EXPECT_EQ(written.amplifiers()[0].thermal_resistance, 2.5);  // of x, as it was
  for (const std::size_t k : {1, 2}) {
    EXPECT_NEAR(written.amplifiers()[k].thermal_resistance, 2.4, 0.1);
    EXPECT_EQ(written.amplifiers()[k].max_temperature, 90);
  }
}

TEST_F(RigHeat, AnOperatorIsGuidedThroughHeatingAndCooling) {
  Terminal terminal(heat(), at);
  read_voltmeter(terminal);
  ASSERT_EQ(terminal.wait(), 0) << terminal.said();
  EXPECT_EQ(currents().norm(), 0);
  const actuation::AmplifierParams found =
      actuation::read_coil_system(at.folder / "out.yaml").amplifiers()[0];
  EXPECT_NEAR(found.resistance / coil.resistance, 1, 0.02);
  EXPECT_NEAR(found.thermal_resistance / coil.thermal_resistance, 1, 0.1);
  EXPECT_NEAR(found.thermal_time / coil.thermal_time, 1, 0.15);
  // Not a second time into the same file.
  Arguments again = heat();
  again.emplace_back("--other-stop");
  refused(again, naming("heat.csv", {"exists"}));
}

TEST_F(RigHeat, TheHottestVoltageEndsTheHeating) {
  coil.thermal_resistance = 8;  // it would end at some 400 °C
  coil.thermal_time = 6;
  Terminal terminal(heat("100"), at);
  read_voltmeter(terminal);
  EXPECT_NE(terminal.wait(), 4) << terminal.said();
  EXPECT_TRUE(names(terminal.said(), "that is the coil's maximum temperature, 90 °C"))
      << terminal.said();
  for (const actuation::HeatRow& row : actuation::read_heat_log(at.folder / "heat.csv").rows) {
    if (row.voltage && row.current > 1) {
      EXPECT_LT(*row.voltage / row.current, coil.resistance * 1.4);  // some 120 °C
    }
  }
}

TEST_F(RigHeat, SilenceTurnsTheCoilOff) {
  Terminal terminal(heat("4", "0.5"), at);
  ASSERT_TRUE(terminal.hears("no answer in 0.5 s")) << terminal.said();
  EXPECT_EQ(terminal.wait(), 4);
  EXPECT_EQ(currents().norm(), 0);
  EXPECT_FALSE(exists("out.yaml"));
}

TEST_F(RigHeat, EscTurnsTheCoilOffAtOnce) {
  Terminal terminal(heat(), at);
  ASSERT_TRUE(terminal.hears("volts of coil x: ")) << terminal.said();
  EXPECT_GT(currents().norm(), 3);
  terminal.press("4.\x1b");
  EXPECT_EQ(terminal.wait(), 4) << terminal.said();
  EXPECT_EQ(currents().norm(), 0);
}

TEST_F(RigHeat, AWarmCoilIsNotMeasuredAsAColdOne) {
  Arguments warm = heat();  // nothing is known of it, so it counts as hot
  std::erase(warm, "--coils-cold");
  warm.emplace_back("--other-stop");
  const Outcome outcome = run(warm);
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "coil x is at 90 °C")) << outcome.err;
  EXPECT_EQ(currents().norm(), 0);
  EXPECT_FALSE(exists("heat.csv"));
}

TEST_F(RigHeat, WhatCannotBeIsRefused) {
  refused({"rig", "heat", sample, "--out", "out.yaml"}, naming("--out", {"--coil"}));
  refused({"rig", "heat", sample, "--coils", "coils.yaml", "--coil", "w", "--out", "out.yaml"},
          naming("--coil", {"'w'", "x, y, z"}));
  refused({"rig", "heat", "none.csv", "--measure", "rig.yaml"}, naming("--measure", {"--coil"}));
  write("short.csv", "t_s,i_a,v_v\n0,4,3.7\n60,4,3.8\n");
  refused({"rig", "heat", "short.csv"}, naming("short.csv", {"2 readings"}));
  write("probe.csv", "t_s,i_a,temperature_degc\n0,4,22\n60,4,30\n");
  refused({"rig", "heat", "probe.csv"}, naming("probe.csv", {"--coils", "--coil"}));
  EXPECT_EQ(device.count(actuation::CoilMessage::set), 0);
  EXPECT_FALSE(exists("out.yaml"));
}

}  // namespace
}  // namespace microswarm::test

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/rig/commissioning/commissioning.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "tests/files.hpp"

namespace microswarm::rig {
namespace {

class CommissioningRecord : public testing::Test {
 protected:
  CommissioningRecord() { write("simulated"); }
  void write(const std::string& driver, const std::string& more = "") {
    folder.with("coils.yaml", "coils: {type: helmholtz}\n");
    file = folder.with("rig.yaml", "coils: coils.yaml\ndriver: {type: " + driver + "}\n" + more);
  }
  Rig rig(const Settings& settings = {}) const { return read_rig(file, settings); }
  void measure(Quantity what, const std::string& value = "1 ± 0.1") const {
    add_to_commissioning(file,
                         {commissioning_entry(what, value, "ann", key_fingerprint(rig(), what))});
  }
  static std::string text(const CommissioningState& state, double days = 0) {
    return to_text(state, std::time(nullptr) + static_cast<std::time_t>(days * 86400));
  }

  test::Folder folder;
  std::filesystem::path file;
};

TEST_F(CommissioningRecord, WithoutDevicesNothingIsMissing) {
  EXPECT_EQ(text(commissioning_state(rig())), "");
  write("serial, port: /dev/none");
  EXPECT_EQ(text(commissioning_state(rig())),
            "never measured: field, current, gain, angle, delay, step_out");
}

TEST_F(CommissioningRecord, NamesWhatWasMeasuredByWhomAndWhen) {
  measure(Quantity::gain, "0.6 ± 0.01 times");
  measure(Quantity::angle, "+15 ± 1°");
  EXPECT_EQ(commissioning_file(file).filename(), "rig.commissioning.yaml");
  EXPECT_EQ(text(commissioning_state(rig())),
            "gain 0.6 ± 0.01 times, angle +15 ± 1° by ann today; never measured: delay, "
            "step_out");
  EXPECT_NE(text(commissioning_state(rig()), 3.5).find("by ann 3 days ago"), std::string::npos);
  EXPECT_NE(text(commissioning_state(rig()), 1.2).find("by ann 1 day ago"), std::string::npos);
  EXPECT_NE(text(commissioning_state(rig()), -5).find("in the future"), std::string::npos);
  // The last entry counts, all are kept.
  measure(Quantity::gain, "0.7 ± 0.01 times");
  EXPECT_EQ(read_commissioning(file).entries.size(), 3u);
  EXPECT_NE(text(commissioning_state(rig())).find("gain 0.7"), std::string::npos);
}

TEST_F(CommissioningRecord, IsStaleOnceTheKeysHaveChanged) {
  for (const auto& [what, name] : enum_names(Quantity{})) measure(what);
  EXPECT_TRUE(commissioning_state(rig()).complete());
  const auto stale = [&](const char* setting) { return text(commissioning_state(rig({setting}))); };
  for (const auto& [setting, names] : std::vector<std::pair<const char*, const char*>>{
           {"field.speed_per_pitch_um_per_s=500", "since: gain"},
           {"field.heading_offset_deg=5", "since: angle"},
           {"delay_s=0.2", "since: delay"},
           {"field.step_out_frequency_hz=30", "since: step_out"},
           {"field.amplitude_mt=5", "since: gain, step_out"},
           {"field.kind=rolling", "since: gain, angle, delay, step_out"}})
    EXPECT_TRUE(stale(setting).ends_with(names)) << setting << ": " << stale(setting);
  EXPECT_EQ(stale("name=other").find("stale"), std::string::npos);
  folder.with("coils.yaml", "coils: {type: helmholtz, turns: [90, 140, 180]}\n");
  EXPECT_TRUE(text(commissioning_state(rig())).ends_with("since: gain, angle, step_out"));
  // Limits of the coils are not their field.
  folder.with("coils.yaml", "coils: {type: helmholtz}\ndrives: [{max_current_a: 5}]\n");
  EXPECT_TRUE(commissioning_state(rig()).complete());
}

TEST_F(CommissioningRecord, MayBeRequired) {
  EXPECT_TRUE(missing_commissioning(rig(), commissioning_state(rig())).empty());
  const Rig strict = rig({"safety.require_commissioning=true"});
  measure(Quantity::gain);
  const Issues issues = missing_commissioning(strict, commissioning_state(strict));
  ASSERT_FALSE(issues.empty());
  EXPECT_NE(issues.begin()->text.find("never measured: angle, delay, step_out"), std::string::npos)
      << issues.begin()->text;
  for (const Quantity what : {Quantity::angle, Quantity::delay, Quantity::step_out}) measure(what);
  EXPECT_TRUE(missing_commissioning(strict, commissioning_state(strict)).empty());
}

TEST_F(CommissioningRecord, TwoProgramsThatAddAtOnceLoseNothing) {
  const auto add = [&](Quantity what) {
    for (int k = 0; k < 30; ++k)
      add_to_commissioning(file, {commissioning_entry(what, "1", "ann", "x")});
  };
  std::thread other([&] { add(Quantity::gain); });
  add(Quantity::delay);
  other.join();
  EXPECT_EQ(read_commissioning(file).entries.size(), 60u);
}

TEST_F(CommissioningRecord, DamagedItIsRefusedAndKept) {
  measure(Quantity::gain);
  const std::string bad = "entries: [{what: moon}]\n";
  write_file_atomically(commissioning_file(file), bad);
  EXPECT_THROW(commissioning_state(rig()), InputError);
  EXPECT_THROW(add_to_commissioning(file, {}), InputError);
  EXPECT_EQ(read_file(commissioning_file(file)), bad);
}

}  // namespace
}  // namespace microswarm::rig

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "tests/config/message.hpp"

namespace microswarm {
namespace {

struct Round {
  static constexpr std::string_view type_name = "round";
  double gap = 1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.gap, um("gap", 0, 100, "Gap.").formerly("margin_um"));
  }
};

struct Square {
  static constexpr std::string_view type_name = "square";
  double clearance = 2;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.clearance, um("clearance", 0, 100, "Clearance.").formerly("margin_um"));
  }
};

struct Clock {
  double rate = 1;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.rate, hz("rate", 0, 10, "Rate."));
  }
};

struct Sensing {
  double timeout = 3;
  Clock clock;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.timeout, s("timeout", 0, 10, "Timeout."));
    visit(self.clock, plain("clock", "Clock."));
  }
};

struct House {
  std::variant<Round, Square> body;
  std::vector<Round> rooms;
  std::optional<Square> cellar;
  Sensing sensing;
  static constexpr std::array<MovedKey, 3> moved_keys{
      {{"body.timeout_s", "sensing.timeout_s"}, {"body.colour", ""}, {"sensing.clock.hand", ""}}};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.body, plain("body", "Body.").formerly("shape"));
    visit(self.rooms, plain("rooms", "Rooms."));
    visit(self.cellar, plain("cellar", "Cellar."));
    visit(self.sensing, plain("sensing", "Sensing."));
  }
};

struct Read {
  House house;
  Notes notes;
  std::string mistakes;
};

Read read(std::string_view text) {
  Read out;
  Issues issues;
  read_yaml(type_of<House>(), &out.house, text, "house.yaml", issues, out.notes, House::moved_keys);
  for (const Issue& issue : issues) out.mistakes += to_string(issue) + "\n";
  return out;
}

/// The assignment with its present keys, once it is applied.
std::optional<std::string> present(House& house, std::string_view text, Notes& notes) {
  const auto setting = set_value(house, parse_setting(text), "--set", notes);
  return setting ? std::optional(to_string(*setting)) : std::nullopt;
}

TEST(FormerKeys, AreReadWhereverTheyStandWithOneNoteEach) {
  const Read r = read(
      "shape: {type: square, margin_um: 5}\n"
      "rooms: [{margin_um: 6}, {gap_um: 7}]\n"
      "cellar: {margin_um: 8}\n");
  EXPECT_EQ(r.mistakes, "");
  EXPECT_EQ(std::get<Square>(r.house.body).clearance, 5);
  ASSERT_EQ(r.house.rooms.size(), 2u);
  EXPECT_EQ(r.house.rooms[0].gap, 6);
  EXPECT_EQ(r.house.rooms[1].gap, 7);
  EXPECT_EQ(r.house.cellar->clearance, 8);
  EXPECT_EQ(r.notes, (Notes{"house.yaml:1:1: 'shape' is now 'body'",
                            "house.yaml:1:23: 'margin_um' is now 'clearance_um'",
                            "house.yaml:2:10: 'margin_um' is now 'gap_um'",
                            "house.yaml:3:10: 'margin_um' is now 'clearance_um'"}));
}

TEST(FormerKeys, MayHaveStoodInAnotherPart) {
  const Read r = read("body: {type: round, timeout_s: 4}\n");
  EXPECT_EQ(r.mistakes, "");
  EXPECT_EQ(r.house.sensing.timeout, 4);
  EXPECT_EQ(r.notes, Notes{"house.yaml:1:21: 'body.timeout_s' is now 'sensing.timeout_s'"});
}

TEST(FormerKeys, MistakesInTheirValuesNameThePresentKeyAtTheirPlace) {
  const Read r = read("body: {type: round, margin_um: 500}\n");
  EXPECT_EQ(r.mistakes, "house.yaml:1:32: gap_um is 500 µm, allowed 0..100 µm\n");
}

TEST(FormerKeys, AreUnknownBesideThePresentKeyAndInOtherAlternatives) {
  EXPECT_EQ(read("body: {type: round, margin_um: 5, gap_um: 6}\n").mistakes,
            "house.yaml:1:21: 'margin_um' is the former name of 'gap_um', which is given too\n");
  EXPECT_EQ(read("cellar: {gap_um: 5}\n").mistakes,
            "house.yaml:1:10: unknown key 'gap_um', allowed: clearance_um\n");
}

TEST(FormerKeys, AMistakeInTheOtherPartStays) {
  EXPECT_EQ(read("body: {type: round, timeout_s: 4}\nsensing: 5\n").mistakes,
            "house.yaml:1:21: unknown key 'timeout_s', allowed: type, gap_um\n"
            "house.yaml:2:10: sensing must be a mapping of keys, not '5'\n");
}

TEST(FormerKeys, ARetiredKeyIsIgnored) {
  const Read r = read("body: {type: round, colour: 4}\n");
  EXPECT_EQ(r.mistakes, "");
  EXPECT_EQ(r.notes, Notes{"house.yaml:1:21: 'body.colour' has no meaning any more"});
  House house;
  Notes notes;
  EXPECT_EQ(present(house, "body.colour=4", notes), std::nullopt);
  EXPECT_EQ(present(house, "body={type: round, colour: 4}", notes), "body={type: round}");
  EXPECT_EQ(notes, (Notes{"--set body.colour: has no meaning any more",
                          "--set body: 'body.colour' has no meaning any more"}));
}

TEST(FormerKeys, ARetiredKeyOfAGroupIsIgnored) {
  const Read r = read("sensing:\n  clock: {hand: 4, rate_hz: 2}\n");
  EXPECT_EQ(r.mistakes, "");
  EXPECT_EQ(r.house.sensing.clock.rate, 2);
  EXPECT_EQ(r.notes, Notes{"house.yaml:2:11: 'sensing.clock.hand' has no meaning any more"});
  EXPECT_EQ(read("sensing: {clock: {face: 4}}\n").mistakes,
            "house.yaml:1:19: unknown key 'face', allowed: rate_hz\n");
  House house;
  Notes notes;
  EXPECT_EQ(present(house, "sensing.clock.hand=4", notes), std::nullopt);
  EXPECT_EQ(present(house, "sensing.clock={hand: 4}", notes), "sensing.clock={}");
  EXPECT_EQ(present(house, "sensing={clock: {hand: 4, rate_hz: 3}}", notes),
            "sensing={clock: {rate_hz: 3}}");
  EXPECT_EQ(house.sensing.clock.rate, 3);
  EXPECT_EQ(notes.size(), 3U);
}

TEST(FormerKeys, AssignmentsGetThePresentKeyOfTheAlternativeThatIsHeld) {
  House house;
  house.rooms.resize(2);
  Notes notes;
  const auto set = [&](std::string_view text) { return present(house, text, notes).value_or(""); };
  EXPECT_EQ(set("body.margin_um=5"), "body.gap_um=5");
  EXPECT_EQ(set("shape.type=square"), "body.type=square");
  EXPECT_EQ(set("shape.margin_um=6"), "body.clearance_um=6");
  EXPECT_EQ(set("rooms.1.margin_um=7"), "rooms.1.gap_um=7");
  EXPECT_EQ(set("body.timeout_s=4"), "sensing.timeout_s=4");
  EXPECT_EQ(set("sensing.timeout_s=5"), "sensing.timeout_s=5");
  EXPECT_EQ(std::get<Square>(house.body).clearance, 6);
  EXPECT_EQ(house.rooms[1].gap, 7);
  EXPECT_EQ(notes.size(), 5u);
  EXPECT_EQ(
      set_values(
          house,
          Settings(std::vector<std::string>{"shape.margin_um=9", "sensing.timeout_s=1"}, "--set")),
      Notes{"--set shape.margin_um: is now 'body.clearance_um'"});
  EXPECT_EQ(sample::message_of([&] { set_value(house, "rooms.9.margin_um=1", "--set"); }),
            "--set rooms.9.margin_um: rooms has 2 entries, counted from 0, and none is '9'");
}

TEST(FormerKeys, AreReadWithinAnAssignedValue) {
  House house;
  Notes notes;
  EXPECT_EQ(present(house, "shape={type: square, margin_um: 5}", notes),
            "body={type: square, clearance_um: 5}");
  EXPECT_EQ(std::get<Square>(house.body).clearance, 5);
  EXPECT_EQ(present(house, "rooms=[{margin_um: 1}, {gap_um: 2}]", notes),
            "rooms=[{gap_um: 1}, {gap_um: 2}]");
  EXPECT_EQ(house.rooms[0].gap, 1);
  EXPECT_EQ(notes,
            (Notes{"--set shape: 'margin_um' is now 'clearance_um'", "--set shape: is now 'body'",
                   "--set rooms: 'margin_um' is now 'gap_um'"}));
  EXPECT_EQ(
      sample::message_of([&] { set_value(house, "body={type: round, timeout_s: 4}", "--set"); }),
      "--set body: 'body.timeout_s' is now 'sensing.timeout_s': set that");
}

}  // namespace
}  // namespace microswarm

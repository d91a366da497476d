// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/errors/error.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/execution/status.hpp"
#include "microswarm/core/version.hpp"

namespace microswarm {
namespace {

TEST(Error, NamesThePlaceAsFarAsItIsKnown) {
  EXPECT_STREQ(InputError("no such coil").what(), "no such coil");
  EXPECT_STREQ(InputError("a.yaml", "bad").what(), "a.yaml: bad");
  EXPECT_STREQ(InputError("a.yaml", 12, 9, "bad").what(), "a.yaml:12:9: bad");
  EXPECT_STREQ(InputError("a.yaml", 12, 0, "bad").what(), "a.yaml:12: bad");
  EXPECT_STREQ(InputError("a.yaml", 0, 0, "bad").what(), "a.yaml: bad");
}

TEST(Error, CarriesItsIssues) {
  const InputError plain("no such coil"), placed("a.yaml", 12, 9, "bad");
  ASSERT_EQ(plain.issues().size(), 1u);
  EXPECT_EQ(plain.issues()[0].text, "no such coil");
  EXPECT_EQ(plain.issues()[0].location, "");
  EXPECT_EQ(placed.issues()[0].text, "bad");
  EXPECT_EQ(placed.issues()[0].location, "a.yaml:12:9");
  const InputError file("a.yaml", "bad");
  EXPECT_EQ(file.issues()[0].text, "bad");
  EXPECT_EQ(file.issues()[0].location, "a.yaml");
  const InputError copy = placed;  // shares them
  EXPECT_EQ(&copy.issues(), &placed.issues());
  EXPECT_EQ(to_issues(placed)[0].location, "a.yaml:12:9");
  EXPECT_EQ(to_issues(HardwareError("gone"))[0].text, "gone");
}

TEST(Error, ListsTwentyIssuesAndCountsTheRest) {
  Issues issues;
  std::string lines;
  for (int i = 1; i <= 20; ++i) {
    const std::string n = std::to_string(i);
    issues.add(Issue{.keys = {"k"}, .text = "bad " + n, .location = "a.yaml:" + n});
    lines += (i > 1 ? "\n" : "") + ("a.yaml:" + n + ": bad " + n);
  }
  EXPECT_EQ(InputError(issues).what(), lines);
  for (int i = 21; i <= 25; ++i) issues.add("k", "bad");
  const InputError error(issues);
  EXPECT_EQ(error.what(), lines + "\nand 5 more");
  EXPECT_EQ(error.issues().size(), 25u);
}

TEST(Issues, OfAPartOrAFileAreIssuesOfTheWhole) {
  Issues part;
  part.add("radius_um", "is 0");
  part.add(Issue{{""}, "is odd", "", "7", "even"});
  Issues whole;
  whole.add_within("shape", part, "obstacle 4");
  EXPECT_EQ(whole[0].keys[0], "shape.radius_um");
  EXPECT_EQ(whole[0].text, "obstacle 4: is 0");
  EXPECT_EQ(whole[1].keys[0], "shape");
  EXPECT_EQ(whole[1].value, "7");
  EXPECT_EQ(whole[1].limit, "even");
  // What a file says of itself is said of the key that names the file.
  Issues map;
  attempt(map, "map.file", [] {
    throw InputError(Issue{{"resolution"}, "is -1", "ros.yaml:2:13", "-1", "at least 0"});
  });
  ASSERT_EQ(map.size(), 1u);
  EXPECT_EQ(map[0].keys, std::vector<std::string>{"map.file"});
  EXPECT_EQ(map[0].text, "ros.yaml:2:13: is -1");
  EXPECT_EQ(map[0].location, "");
  EXPECT_EQ(map[0].value, "-1");
  EXPECT_EQ(map[0].limit, "at least 0");
  EXPECT_EQ(to_string(map.placed_in("s.yaml")), "s.yaml: ros.yaml:2:13: is -1");
  EXPECT_EQ(to_string(map.placed_in("a:1").placed_in("b")), "b: a:1: ros.yaml:2:13: is -1");
  EXPECT_EQ(map.placed_in("b").unplaced()[0].location, "");
  map.drop({"map"});
  EXPECT_TRUE(map.empty());
}

TEST(Status, EveryStatusHasItsOwnWord) {
  std::set<std::string_view> words;
  for (int i = 0; i <= static_cast<int>(Status::fault); ++i) {
    const std::string_view word = to_string(static_cast<Status>(i));
    EXPECT_EQ(word.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos);
    EXPECT_TRUE(words.insert(word).second) << word;
  }
  EXPECT_EQ(to_string(Status::start_blocked), "start_blocked");
}

TEST(Version, HasThreeParts) {
  EXPECT_EQ(version.find_first_not_of("0123456789."), std::string_view::npos);
  EXPECT_EQ(std::count(version.begin(), version.end(), '.'), 2);
}

TEST(InputName, IsTheKeyUnlessAProgramHasAnother) {
  EXPECT_EQ(input_name("um_per_px"), "um_per_px");
  name_inputs([](std::string_view key) { return std::string(key == "times" ? "--times" : ""); });
  EXPECT_EQ(input_name("times"), "--times");
  EXPECT_EQ(input_name("um_per_px"), "um_per_px");
  name_inputs({});
  EXPECT_EQ(input_name("times"), "times");
}

}  // namespace
}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "lab/stream/request.hpp"

#include <gtest/gtest.h>

#include "lab/net/http.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::lab {
namespace {

using test::error_of;
using test::is_one_line_naming;

void refused(const std::string& text, const std::vector<std::string>& parts = {}) {
  EXPECT_TRUE(is_one_line_naming(error_of([&] { read_request(text); }), "message", parts)) << text;
}

TEST(Request, EachKeyIsRead) {
  const Request set =
      read_request(R"({"id": 7, "do": "set", "key": "goal_um", "value": "[1, 2]"})");
  EXPECT_EQ(set.id, 7u);
  EXPECT_EQ(set.ask, Ask::set);
  EXPECT_EQ(set.key, "goal_um");
  EXPECT_EQ(set.value, "[1, 2]");
  EXPECT_EQ(read_request(R"({"do": "speed", "number": 0.5})").number, 0.5);
  EXPECT_TRUE(read_request(R"({"do": "hold", "on": true})").on);
  const Request steer = read_request(R"({"do": "steer", "heading": -1.5, "speed": 80})");
  EXPECT_EQ(steer.heading, -1.5);
  EXPECT_EQ(steer.speed, 80);
  const Request restart = read_request(R"({"do": "restart", "settings": ["seed=3", "tick_s=1"]})");
  EXPECT_EQ(restart.settings, (std::vector<std::string>{"seed=3", "tick_s=1"}));
}

TEST(Request, EveryWordIsKnown) {
  for (const auto& [ask, word] : enum_names(Ask{}))
    EXPECT_EQ(read_request("{\"do\":\"" + std::string(word) + "\"}").ask, ask);
}

TEST(Request, WhatItIsNotIsToldInOneLine) {
  for (const char* text : {"", "{", "nothing", "[]", "3", "\"play\"", "null", "{\"do\":\"play\"} x",
                           "\xff\xfe", "{\"do\":\"pl\xffy\"}", "{\"do\":NaN}"})
    refused(text);
  refused("{}", {"do"});
  refused(R"({"do": "fly"})", {"fly"});
  refused(R"({"do": "play", "extra": 1})", {"extra"});
  refused(R"({"do": 3})", {"do"});
  refused(R"({"do": "play", "id": -1})", {"id"});
  refused(R"({"do": "play", "id": 1.5})", {"id"});
  refused(R"({"do": "speed", "number": "1"})", {"number"});
  refused(R"({"do": "speed", "number": 1e999})");
  refused(R"({"do": "hold", "on": 1})", {"on"});
  refused(R"({"do": "set", "key": ["a"]})", {"key"});
  refused(R"({"do": "restart", "settings": "a"})", {"settings"});
  refused(R"({"do": "restart", "settings": [1]})", {"settings"});
  refused("{\"do\": \"play\", \"a\\nb\": 1}");
  refused("{\"do\": \"a\\nb\\u001b[31m\"}");
}

TEST(Request, SizeDepthAndCountAreLimited) {
  refused(R"({"do": "restart", "settings": [["a"]]})");
  refused(std::string(100'000, '['));
  refused(std::string(max_request_size + 1, ' '), {std::to_string(max_request_size)});
  std::string many = R"({"do": "restart", "settings": ["a")";
  for (std::size_t i = 0; i < max_settings; ++i) many += ",\"a\"";
  refused(many + "]}", {"settings"});
}

TEST(Request, WhatIsOpenedIsReadAsStrictly) {
  const OpenRequest open = read_open_request(R"({"file": "a.yaml", "settings": ["seed=3"]})");
  EXPECT_EQ(open.file, "a.yaml");
  EXPECT_EQ(open.settings, std::vector<std::string>{"seed=3"});
  EXPECT_FALSE(read_open_request("{}").file);
  for (const char* text : {"", "[]", R"({"files": "a"})", R"({"file": 3})", R"({"settings": [3]})"})
    EXPECT_TRUE(is_one_line_naming(error_of([&] { read_open_request(text); }), "message", {}));
}

TEST(Query, ValuesAreDecoded) {
  EXPECT_EQ(target_path("/a/b?c=d?e"), "/a/b");
  EXPECT_EQ(query_value("/a?file=x%20y%2Fz.yaml&token=3", "file"), "x y/z.yaml");
  EXPECT_EQ(query_value("/a?file=x+y%2B", "file"), "x y+");
  EXPECT_EQ(query_value("/a?profile=1&file=%C3%A9", "file"), "é");
  EXPECT_EQ(query_value("/a?file", "file"), "");
  EXPECT_EQ(query_value("/a?file=", "file"), "");
  for (const char* text : {"%", "%2", "%zz", "a%", "a%2", "%-1", "%+1"}) {
    std::string expected = text;
    for (char& c : expected) c = c == '+' ? ' ' : c;
    EXPECT_EQ(percent_decoded(text), expected);
  }
}

}  // namespace
}  // namespace microswarm::lab

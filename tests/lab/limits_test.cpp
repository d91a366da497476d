// SPDX-License-Identifier: Apache-2.0
// How many sessions and pages a lab bears, and who makes room.
#include <array>

#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

TEST(Limits, SessionsAndPagesAreLimited) {
  ServerOptions options;
  options.limits.sessions = 2;
  options.limits.pages = 3;
  const Lab lab(options);
  const std::array sessions{open(lab), open(lab)};
  TestPage first(lab, sessions[0]), second(lab, sessions[1]), third(lab, sessions[1]);
  for (TestPage* page : {&first, &second, &third}) EXPECT_FALSE(page->next().is_null());
  const Reply more = ask(lab, http::verb::post, "/api/sessions", Json{{"file", lab.file}}.dump());
  EXPECT_EQ(more.result(), http::status::bad_request);
  EXPECT_NE(more.body().find("2 sessions"), std::string::npos) << more.body();
  EXPECT_FALSE(TestPage(lab, sessions[1]).is_open());
  // Closing one makes room, and its page ends.
  EXPECT_EQ(ask(lab, http::verb::delete_, "/api/sessions/" + std::to_string(sessions[0])).result(),
            http::status::ok);
  while (!first.next().is_null()) {
  }
  TestPage fourth(lab, open(lab));
  EXPECT_TRUE(fourth.is_open());
  EXPECT_EQ(ask(lab, http::verb::delete_, "/api/sessions/" + std::to_string(sessions[0])).result(),
            http::status::not_found);
}

TEST(Limits, TheOldestSessionThatNobodyWatchesMakesRoom) {
  ServerOptions options;
  options.limits.sessions = 3;
  const Lab lab(options);
  const std::uint64_t watched = open(lab), older = open(lab), newer = open(lab);
  TestPage page(lab, watched);
  EXPECT_FALSE(page.next().is_null());
  open(lab);
  const auto is_there = [&](std::uint64_t session) {
    return get(lab, "/api/sessions/" + std::to_string(session) + "/events.csv").result() ==
           http::status::ok;
  };
  EXPECT_TRUE(is_there(watched));
  EXPECT_FALSE(is_there(older));
  EXPECT_TRUE(is_there(newer));
}

TEST(Limits, AFileThatDoesNotOpenTakesNoRoom) {
  ServerOptions options;
  options.limits.sessions = 2;
  const Lab lab(options);
  const std::string at = "/api/sessions/" + std::to_string(open(lab));
  open(lab);
  const Json wrong{{"file", lab.file}, {"settings", {"goal_tolerance_um=-1"}}};
  EXPECT_EQ(ask(lab, http::verb::post, "/api/sessions", wrong.dump()).result(),
            http::status::bad_request);
  EXPECT_EQ(get(lab, at).result(), http::status::ok);
  open(lab);
  EXPECT_EQ(get(lab, at).result(), http::status::not_found);
}

TEST(Limits, ASessionThatNobodyWatchesPausesAndIsKept) {
  ServerOptions options;
  options.limits.sweep_period = 100ms;
  const Lab lab(options);
  const std::uint64_t session = open(lab);
  {
    TestPage page(lab, session);
    page.does({{"do", "step"}});
    page.does({{"do", "set"}, {"key", "goal_tolerance_um"}, {"value", "31"}});
    page.does({{"do", "play"}});
  }
  const auto time = [&] {
    return Json::parse(get(lab, "/api/sessions/" + std::to_string(session)).body())["t_s"];
  };
  std::this_thread::sleep_for(1500ms);
  const Json paused = time();
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(time(), paused);
  EXPECT_EQ(Json::parse(get(lab, "/api/sessions").body())["sessions"][0]["watched"], false);
  TestPage again(lab, session);
  const Json standing = again.until("standing");
  EXPECT_EQ(standing["changes"], Json({"goal_tolerance_um=31"}));
  EXPECT_EQ(standing["plays"], false);
}

TEST(Limits, ASessionThatNobodyComesBackToIsClosed) {
  ServerOptions options;
  options.limits.sweep_period = 200ms;
  options.limits.keep = 1000ms;
  const Lab lab(options);
  const std::uint64_t watched = open(lab), left = open(lab);
  TestPage page(lab, watched);
  const std::string at = "/api/sessions/" + std::to_string(left);
  for (int i = 0; i < 600 && get(lab, at).result() != http::status::not_found; ++i)
    std::this_thread::sleep_for(100ms);
  EXPECT_EQ(get(lab, at).result(), http::status::not_found);
  page.does({{"do", "step"}});
}

TEST(Limits, SessionsThatNobodyWatchesTakeLimitedMemory) {
  ServerOptions options;
  options.limits.sweep_period = 100ms;
  options.limits.kept = 1;
  const Lab lab(options);
  const std::uint64_t first = open(lab), second = open(lab);
  for (const std::uint64_t session : {first, second}) {
    TestPage page(lab, session);
    page.does({{"do", "step"}});
  }
  const auto open_sessions = [&] {
    return Json::parse(get(lab, "/api/sessions").body())["sessions"].size();
  };
  for (int i = 0; i < 600 && open_sessions() > 1; ++i) std::this_thread::sleep_for(100ms);
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(open_sessions(), 1u);  // one is kept
}

}  // namespace
}  // namespace microswarm::lab

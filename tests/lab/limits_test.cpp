// SPDX-License-Identifier: Apache-2.0
// Limits of sessions and pages: which are refused or closed, and the lab that a session is of.
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

TEST(Limits, ARunThatWasChangedMakesRoomLast) {
  ServerOptions options;
  options.limits.sessions = 3;
  const Lab lab(options);
  const std::uint64_t changed = open(lab), older = open(lab), newer = open(lab);
  {
    TestPage page(lab, changed);
    page.does({{"do", "step"}});
    page.does({{"do", "set"}, {"key", "goal_tolerance_um"}, {"value", "31"}});
  }
  const auto is_there = [&](std::uint64_t session) {
    return get(lab, "/api/sessions/" + std::to_string(session)).result() == http::status::ok;
  };
  EXPECT_EQ(Json::parse(get(lab, "/api/sessions").body())["sessions"][0]["changed"], true);
  open(lab);
  EXPECT_TRUE(is_there(changed));
  EXPECT_FALSE(is_there(older));
  open(lab);
  EXPECT_TRUE(is_there(changed));
  EXPECT_FALSE(is_there(newer));
}

TEST(Limits, MemoryIsTakenFromRunsThatWereNotChanged) {
  ServerOptions options;
  options.limits.sweep_period = 100ms;
  options.limits.kept = 1;
  const Lab lab(options);
  const std::uint64_t changed = open(lab), other = open(lab);
  // Both are watched until the end, so that the changed one is not unwatched for less time.
  {
    TestPage first(lab, changed), second(lab, other);
    first.does({{"do", "step"}});
    first.does({{"do", "set"}, {"key", "goal_tolerance_um"}, {"value", "31"}});
    second.does({{"do", "step"}});
  }
  const auto open_sessions = [&] {
    return Json::parse(get(lab, "/api/sessions").body())["sessions"];
  };
  for (int i = 0; i < 600 && open_sessions().size() > 1; ++i) std::this_thread::sleep_for(100ms);
  EXPECT_EQ(open_sessions()[0]["session"], changed);
}

TEST(Limits, ARunPausesWhenItsLastPageLeaves) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  const auto time = [&] {
    return Json::parse(get(lab, "/api/sessions/" + std::to_string(session)).body())["t_s"];
  };
  const auto goes_on = [&] {
    std::this_thread::sleep_for(500ms);
    const Json before = time();
    std::this_thread::sleep_for(1000ms);
    return time() != before;
  };
  TestPage watcher(lab, session);
  {
    TestPage page(lab, session);
    page.does({{"do", "speed"}, {"number", 0.4}});
    page.does({{"do", "play"}});
    page.stream().close(beast::websocket::close_code::none);
  }
  EXPECT_TRUE(goes_on()) << "another page watches it";
  {
    TestPage page(lab, session);
    beast::get_lowest_layer(watcher.stream()).close();
    beast::get_lowest_layer(page.stream()).close();
  }
  EXPECT_TRUE(goes_on()) << "a broken connection is not left";
  {
    TestPage page(lab, session);
    page.stream().close(beast::websocket::close_code::going_away);
  }
  EXPECT_TRUE(goes_on()) << "a reload is not left";
  {
    TestPage page(lab, session);
    page.stream().close(beast::websocket::close_code::none);
  }
  EXPECT_FALSE(goes_on());
}

TEST(Limits, ASessionOfALabThatEndedIsNoneOfTheNextOne) {
  ServerOptions options;
  std::uint64_t before = 0;
  {
    const Lab lab(options);
    options.port = lab.port;
    before = open(lab);
  }
  const Lab lab(options);
  EXPECT_NE(open(lab), before);
  const std::string at = "/api/sessions/" + std::to_string(before);
  for (const char* name : {"", "/record.h5", "/run.gif?from=0&to=1"})
    EXPECT_EQ(get(lab, at + name).result(), http::status::gone) << name;
  EXPECT_EQ(ask(lab, http::verb::delete_, at).result(), http::status::gone);
  EXPECT_FALSE(TestPage(lab, before).is_open());
  EXPECT_EQ(get(lab, "/api/sessions/x").result(), http::status::not_found);
}

}  // namespace
}  // namespace microswarm::lab

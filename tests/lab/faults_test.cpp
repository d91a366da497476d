// SPDX-License-Identifier: Apache-2.0
// What a lab's clients do wrong, and what it does then.
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <functional>

#include "lab/net/outbox.hpp"
#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

const Json step{{"do", "step"}};

/// A plain connection.
class Line {
 public:
  explicit Line(const Lab& lab) : socket_(io_) { socket_.connect(lab.endpoint()); }
  void say(std::string_view bytes) {
    beast::error_code ignored;
    asio::write(socket_, asio::buffer(bytes.data(), bytes.size()), ignored);
  }
  /// All until the other side closes, or half a minute is over.
  std::string heard() {
    std::string text;
    closed = finished(io_, [&](auto done) {
               asio::async_read(socket_, asio::dynamic_buffer(text), std::move(done));
             }) != asio::error::timed_out;
    return text;
  }
  Tcp::socket& socket() { return socket_; }
  bool closed = false;

 private:
  asio::io_context io_;
  Tcp::socket socket_;
};

std::string head(const Lab& lab, const std::string& more = {}) {
  return "Host: " + lab.host + "\r\nCookie: microswarm_" + std::to_string(lab.port) + "=" +
         lab.token + "\r\n" + more + "\r\n";
}

MessagePtr message(Message::Kind kind, const std::string& bytes) {
  auto made = std::make_shared<Message>();
  made->bytes = bytes;
  made->kind = kind;
  return made;
}

TEST(LabFaults, ASlowPageLosesFramesAndNothingElse) {
  using enum Message::Kind;
  Outbox outbox;
  for (const auto& [kind, bytes] :
       std::vector<std::pair<Message::Kind, std::string>>{{other, "rows 1"},
                                                          {frame, "frame 1"},
                                                          {standing, "standing 1"},
                                                          {answer, "answer 1"},
                                                          {other, "rows 2"},
                                                          {frame, "frame 2!"},
                                                          {standing, "standing 2"},
                                                          {answer, "answer 2"}})
    outbox.add(message(kind, bytes));
  EXPECT_EQ(outbox.size(), 6u + 8 + 10 + 8 + 6 + 10 + 8);
  for (const char* bytes :
       {"rows 1", "frame 2!", "standing 1", "answer 1", "rows 2", "standing 2", "answer 2"})
    EXPECT_EQ(outbox.take()->bytes, bytes);
  EXPECT_EQ(outbox.take(), nullptr);
  EXPECT_EQ(outbox.size(), 0u);
  outbox.add(message(frame, "of before"));
  outbox.add(message(answer, "answer"));
  outbox.add(message(hello, "hello"));
  EXPECT_EQ(outbox.take()->bytes, "answer");
  EXPECT_EQ(outbox.take()->bytes, "hello");
  EXPECT_EQ(outbox.size(), 0u);
}

TEST(LabFaults, AStandingFollowsTheRowsThatItCounts) {
  using enum Message::Kind;
  Outbox outbox;
  std::size_t queued = 0;
  for (const char* number : {"1", "2", "3", "4"}) {
    outbox.add(message(other, std::string("rows ") + number));
    outbox.add(message(standing, std::string("standing ") + number));
    if (number[0] == '3') outbox.add(message(answer, "answer"));
    queued = outbox.size();
  }
  EXPECT_EQ(queued, 4u * 6 + 3 * 10 + 6);
  for (const char* bytes :
       {"rows 1", "standing 1", "rows 2", "rows 3", "standing 3", "answer", "rows 4", "standing 4"})
    EXPECT_EQ(outbox.take()->bytes, bytes);
  EXPECT_EQ(outbox.size(), 0u);
}

TEST(LabFaults, APageThatNeverReadsIsClosedAndTheOthersGoOn) {
  ServerOptions options;
  options.limits.unread = 100'000;
  options.limits.pages = 2;
  const Lab lab(options);
  experiment::Session run(experiment::open_experiment(experiment::small_flight(), {}));
  run.finish();
  run.record_to(lab.folder / "run.h5");
  const std::uint64_t session = open(lab, {{"file", (lab.folder / "run.h5").string()}});
  const TestPage sleeper(lab, session, {}, 4096);
  TestPage page(lab, session);
  EXPECT_FALSE(TestPage(lab, session).is_open());
  // A restart sends all rows again, which are never left out; the reader gets them too.
  bool is_closed = false;
  for (int i = 0; i < 2000 && !is_closed; ++i) {
    page.does({{"do", "restart"}, {"settings", Json::array()}});
    is_closed = i % 10 == 0 && TestPage(lab, session).is_open();
  }
  EXPECT_TRUE(is_closed);
  page.does(step);
}

TEST(LabFaults, GarbageIsAnsweredWithWhatIsWrong) {
  const Lab lab;
  TestPage page(lab, open(lab));
  for (const std::string& text :
       {std::string("garbage"), std::string(3, '\0'), std::string(), std::string("{}"),
        std::string(R"({"do": "fly"})"), std::string(100'000, '['), std::string(60'000, '{')}) {
    ASSERT_TRUE(page.say(text));
    const Json answer = page.until("answer");
    ASSERT_FALSE(answer.is_null());
    EXPECT_EQ(answer["id"], 0);
    EXPECT_EQ(answer["issues"].size(), 1u);
  }
  page.does(step);
}

TEST(LabFaults, AMessageThatIsRefusedIsAnsweredWithItsId) {
  const Lab lab;
  TestPage page(lab, open(lab));
  for (const Json& request : {Json{{"do", "fly"}}, Json{{"do", "seek"}, {"number", "one"}},
                              Json{{"speed", 2}}, Json{{"do", "step"}, {"path", "/"}}})
    EXPECT_EQ(page.issues(request).size(), 1u) << request;
  ASSERT_TRUE(page.say(R"({"id": -1, "do": "step"})"));
  EXPECT_EQ(page.until("answer")["id"], 0);
}

TEST(LabFaults, TextThatIsNoUtf8EndsTheStream) {
  const Lab lab;
  TestPage page(lab, open(lab));
  page.say("{\"do\": \"\xff\xfe\"}");
  while (!page.next().is_null()) {
  }
  EXPECT_EQ(page.stream().reason().code, beast::websocket::close_code::bad_payload);
}

TEST(LabFaults, AMessageThatIsTooLongEndsTheStream) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  page.say(std::string(max_request_size + 1, ' '));
  while (!page.next().is_null()) {
  }
  EXPECT_EQ(page.stream().reason().code, beast::websocket::close_code::too_big);
  TestPage(lab, session).does(step);
}

TEST(LabFaults, ManyMessagesAreAnsweredEachAndHoldNobodyUp) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage flood(lab, session), page(lab, session);
  flood.does({{"do", "manual"}, {"on", true}});
  constexpr std::uint64_t count = 5000;
  std::uint64_t sent = 0;
  std::string text;
  std::function<void()> write = [&] {
    if (sent == count) return;
    text = Json{{"id", 1000 + sent++}, {"do", "steer"}, {"heading", 1}, {"speed", 9}}.dump();
    flood.stream().async_write(asio::buffer(text), [&](beast::error_code error, std::size_t) {
      if (!error) write();
    });
  };
  write();
  std::set<std::uint64_t> answered;
  while (answered.size() < count) {
    const Json one = flood.next();
    ASSERT_FALSE(one.is_null());
    if (one["type"] == "answer") answered.insert(one["id"].get<std::uint64_t>());
    if (answered.size() == count / 2) page.does(step);
  }
  page.does(step);
}

TEST(LabFaults, AnUpgradeNeedsTheOriginTheTokenAndASession) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  EXPECT_TRUE(TestPage(lab, session).is_open());
  for (const char* origin : {"none", "http://evil.example", "null", "http://localhost:1"})
    EXPECT_FALSE(TestPage(lab, session, origin).is_open()) << origin;
  EXPECT_FALSE(TestPage(lab, session + 100).is_open());
  const std::string upgrade =
      "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: x3JJHMbDL1EzLkh9GBhXDw==\r\n"
      "Sec-WebSocket-Version: 13\r\nOrigin: http://" +
      lab.host + "\r\nConnection: close\r\n";
  Line line(lab);
  line.say("GET /api/stream/" + std::to_string(session) + " HTTP/1.1\r\nHost: " + lab.host +
           "\r\n" + upgrade + "\r\n");
  EXPECT_TRUE(line.heard().starts_with("HTTP/1.1 403 "));
}

TEST(LabFaults, WhatIsNoRequestIsRefusedByItsCode) {
  const Lab lab;
  const auto code = [&](const std::string& text) {
    Line line(lab);
    line.say(text);
    const std::string heard = line.heard();
    EXPECT_TRUE(line.closed);
    return heard.substr(0, std::min<std::size_t>(heard.size(), 12));
  };
  EXPECT_EQ(code("nonsense\r\n\r\n"), "HTTP/1.1 400");
  EXPECT_EQ(code(std::string("\x16\x03\x01\x02\x00\x01", 6) + "\r\n\r\n"), "HTTP/1.1 400");
  EXPECT_EQ(code("GET / HTTP/1.1\r\nX: " + std::string(20'000, 'x') + "\r\n\r\n"), "HTTP/1.1 431");
  EXPECT_EQ(code("POST /api/sessions HTTP/1.1\r\nContent-Length: 99999999\r\n" + head(lab)),
            "HTTP/1.1 413");
  const std::string close = "Connection: close\r\n";
  EXPECT_EQ(code("PUT / HTTP/1.1\r\n" + head(lab, close)), "HTTP/1.1 404");
  EXPECT_EQ(code("GET / HTTP/1.1\r\n" + close + "\r\n"), "HTTP/1.1 403");
  EXPECT_EQ(code("GET / HTTP/1.1\r\n" + close + "Host: evil.example\r\n\r\n"), "HTTP/1.1 403");
  EXPECT_EQ(code("GET / HTTP/1.1\r\n" + head(lab, close)), "HTTP/1.1 200");
}

TEST(LabFaults, ClientsThatVanishLeaveNothing) {
  ServerOptions options;
  options.limits.pages = 2;
  const Lab lab(options);
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  for (int i = 0; i < 20; ++i) {
    // In mid-message, after half a header, in a request, while a download is made.
    TestPage half(lab, session);
    if (i % 2 == 0 && half.is_open()) {
      beast::error_code ignored;
      half.stream().write_some(false, asio::buffer(std::string("{\"do\": ")), ignored);
      asio::write(beast::get_lowest_layer(half.stream()).socket(), asio::buffer("\x81\xfe\xff"),
                  ignored);
    }
    Line line(lab);
    line.say(i % 3 == 0 ? "GET /api"
                        : "GET /api/sessions/" + std::to_string(session) +
                              "/record.h5 HTTP/1.1\r\n" + head(lab));
    beast::error_code ignored;
    line.socket().set_option(asio::socket_base::linger(true, 0), ignored);
    page.does(step);
  }
  bool is_open = false;
  for (int i = 0; i < 500 && !is_open; ++i) {
    is_open = TestPage(lab, session).is_open();
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_TRUE(is_open);
}

TEST(LabFaults, TooManyConnectionsAreClosed) {
  ServerOptions options;
  options.limits.connections = 4;
  const Lab lab(options);
  std::list<Line> lines;
  for (int i = 0; i < 4; ++i) lines.emplace_back(lab);
  Line fifth(lab);
  fifth.say("GET / HTTP/1.1\r\n" + head(lab));
  EXPECT_EQ(fifth.heard(), "");
  EXPECT_TRUE(fifth.closed);
  lines.pop_front();
  Reply reply;
  lines.front().say("GET / HTTP/1.1\r\n" + head(lab, "Connection: close\r\n"));
  EXPECT_TRUE(lines.front().heard().starts_with("HTTP/1.1 200"));
}

// The connections of all clients are closed, also amid a request.
TEST(LabFaults, ItEndsAmidEverything) {
  for (int i = 0; i < 8; ++i) {
    Lab lab;
    const std::uint64_t session = open(lab);
    TestPage page(lab, session), second(lab, session);
    page.ask({{"do", "speed"}, {"number", 0}});
    page.ask({{"do", "play"}});
    std::list<Line> lines;
    for (const std::string target :
         {"GET /api/scenarios", "GET /api/thumbnail?file=", "GET /api/sessions/1/record.h5",
          "POST /api/sessions", "GET /app.js", "GET /a"}) {
      const std::string body = "{\"file\": \"" + lab.file + "\"}";
      Line& line = lines.emplace_back(lab);
      if (target.starts_with("POST"))
        line.say(target + " HTTP/1.1\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" +
                 head(lab) + body);
      else
        line.say(target + (target.ends_with('=') ? lab.file : "") + " HTTP/1.1\r\n" + head(lab));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * i));
    lab.end();
    for (TestPage* one : {&page, &second}) {
      while (!one->next().is_null()) {
      }
      EXPECT_FALSE(one->stream().is_open()) << i;
    }
    for (Line& line : lines) {
      line.heard();
      EXPECT_TRUE(line.closed) << i;
    }
  }
}

TEST(LabRealTime, ItEndsWithinASecondWithPagesOpen) {
  Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session), second(lab, session);
  page.does({{"do", "speed"}, {"number", 0}});
  page.does({{"do", "play"}});
  EXPECT_LT(lab.end(), 1);
  EXPECT_TRUE(lab.ended_in_time);
}

TEST(LabRealTime, SilentAndSlowClientsAreClosed) {
  ServerOptions options;
  options.limits.patience = 400ms;
  options.limits.pages = 1;
  const Lab lab(options);
  const auto began = Stop::Clock::now();
  Line silent(lab), half(lab), slow(lab);
  half.say("GET / HTTP/1.1\r\nHost: ");
  for (int i = 0; i < 20; ++i) {
    slow.say("G");
    std::this_thread::sleep_for(50ms);
  }
  for (Line* line : {&silent, &half, &slow}) {
    line->heard();
    EXPECT_TRUE(line->closed);
  }
  EXPECT_LT(seconds_since(began), 20);
  // A page that answers no ping.
  const std::uint64_t session = open(lab);
  const TestPage dead(lab, session);
  EXPECT_TRUE(dead.is_open());
  EXPECT_FALSE(TestPage(lab, session).is_open());
  bool is_open = false;
  for (int i = 0; i < 200 && !is_open; ++i) {
    std::this_thread::sleep_for(50ms);
    is_open = TestPage(lab, session).is_open();
  }
  EXPECT_TRUE(is_open);
}

}  // namespace
}  // namespace microswarm::lab

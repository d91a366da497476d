// SPDX-License-Identifier: Apache-2.0
#include "lab/net/server.hpp"

#include <cstring>
#include <thread>

#include "microswarm/experiment/session/replay.hpp"
#include "tests/lab/client.hpp"
#include "tests/messages.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;

experiment::Record record_of(const Lab& lab, std::uint64_t session) {
  const Reply reply = get(lab, "/api/sessions/" + std::to_string(session) + "/record.h5");
  EXPECT_EQ(reply.result(), http::status::ok);
  EXPECT_EQ(reply[http::field::content_disposition], "attachment; filename=\"record.h5\"");
  return experiment::read_record(lab.folder.with("downloaded.h5", reply.body()));
}

/// Of the command line.
std::string hash_of(const std::string& file, const std::vector<std::string>& settings = {}) {
  const auto session = experiment::open_session(file, {settings, ""});
  session->finish();
  return session->record().hash();
}

const Json fastest{{"do", "speed"}, {"number", 0}};
const Json plays{{"do", "play"}};

TEST(Server, TheHelloComesFirstThenAllThatAPageNeeds) {
  const Lab lab;
  TestPage page(lab, open(lab));
  EXPECT_EQ(page.next()["type"], "hello");
  for (const char* type : {"rows", "frame", "standing"}) EXPECT_EQ(page.next()["type"], type);
  EXPECT_EQ(page.latest["hello"]["name"], lab.file);
  EXPECT_EQ(page.latest["standing"]["status"], "running");
  EXPECT_EQ(page.latest["standing"]["plays"], false);
}

TEST(Server, ARunThatIsPlayedIsTheCommandLines) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  page.does(fastest);
  page.does(plays);
  const Json standing = page.ends();
  EXPECT_EQ(standing["status"], "solved");
  const experiment::Record record = record_of(lab, session);
  EXPECT_EQ(record.hash(), hash_of(lab.file));
  EXPECT_TRUE(experiment::replay(record).identical);
}

TEST(Server, EveryTickIsARowForEveryPage) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  const auto rows_of = [&](TestPage& of) {
    std::size_t rows = 0;
    double last = -1;
    for (;;) {
      const Json message = of.next();
      if (message.is_null()) return std::size_t{0};
      if (message["type"] == "rows") {
        if (message["anew"] == true) rows = 0, last = -1;
        const auto& bytes = message["rows"].get_binary();
        for (std::size_t i = 0; i < bytes.size(); i += 80, ++rows) {
          double t = 0;
          std::memcpy(&t, bytes.data() + i, sizeof t);
          EXPECT_GT(t, last);
          last = t;
        }
      }
      if (message["type"] == "standing" && message["ended"] == true && message["frames"] == rows)
        return rows;
    }
  };
  page.does(fastest);
  page.ask(plays);
  page.until("frame", [](const Json& frame) { return frame["number"] > 5; });
  TestPage second(lab, session);
  const std::size_t rows = rows_of(second);
  EXPECT_EQ(rows, record_of(lab, session).frames.size());
  EXPECT_GT(rows, 20u);
  TestPage third(lab, session);
  EXPECT_EQ(rows_of(third), rows);
}

TEST(Server, TwoPagesSeeAndOperateOneSession) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage first(lab, session), second(lab, session);
  first.does({{"do", "step"}});
  EXPECT_FALSE(second.until("frame", [](const Json& frame) { return frame["frame"]["t_s"] == 0; })
                   .is_null());
  second.does({{"do", "speed"}, {"number", 3}});
  EXPECT_FALSE(
      first.until("standing", [](const Json& one) { return one["speed"] == 3; }).is_null());
}

TEST(Server, OneLooksBackWhileTheRunIsAsItWas) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  for (int i = 0; i < 12; ++i) page.does({{"do", "step"}});
  page.does({{"do", "seek"}, {"number", 4}});
  EXPECT_FALSE(
      page.until("frame", [](const Json& frame) { return frame["number"] == 4; }).is_null());
  page.until("standing");
  EXPECT_EQ(page.latest["standing"]["looks_back"], true);
  EXPECT_EQ(page.latest["standing"]["frames"], 12);
  page.does({{"do", "live"}});
  EXPECT_FALSE(
      page.until("frame", [](const Json& frame) { return frame["number"] == 11; }).is_null());
  EXPECT_EQ(page.issues({{"do", "seek"}, {"number", -1}}).size(), 1u);
  page.does(fastest);
  page.does(plays);
  page.ends();
  EXPECT_EQ(record_of(lab, session).hash(), hash_of(lab.file));
}

TEST(Server, ItPlaysUntilATime) {
  const Lab lab;
  TestPage page(lab, open(lab));
  page.does({{"do", "speed"}, {"number", 50}});
  page.does({{"do", "play"}, {"number", 3}});
  const auto stands = [](const Json& one) { return one["plays"] == false && one["frames"] > 0; };
  page.until("standing", stands);
  const double tick = 0.1;
  EXPECT_NEAR(page.latest["standing"]["frames"].get<double>() * tick, 3 + tick, 1e-9);
  page.does({{"do", "play"}, {"number", 2}});  // it is there already
  EXPECT_EQ(page.latest["standing"]["plays"], false);
  page.does(fastest);
  page.does(plays);
  page.ends();
}

TEST(Server, WhoPausesKnowsWithTheAnswerWhereItStands) {
  const Lab lab;
  TestPage page(lab, open(lab));
  page.does({{"do", "speed"}, {"number", 20}});
  for (std::size_t i = 0; i < 12; ++i) {
    page.does(plays);
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + 3 * i));
    page.does({{"do", "pause"}});
    const Json at_the_answer = page.latest["standing"];
    EXPECT_EQ(at_the_answer["plays"], false);
    const auto& rows = page.latest["rows"]["rows"].get_binary();
    double newest = -1;
    std::memcpy(&newest, rows.data() + rows.size() - 80, sizeof newest);
    EXPECT_NEAR(newest, 0.1 * (at_the_answer["frames"].get<double>() - 1), 1e-9);
    page.does({{"do", "speed"}, {"number", 20}});
    page.until("standing", [&](const Json& one) { return one["plays"] == false; });
    EXPECT_EQ(page.latest["standing"]["frames"], at_the_answer["frames"]);
  }
}

TEST(Server, WhatIsSetIsInTheRecordAndWhatIsWrongIsTold) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  for (int i = 0; i < 5; ++i) page.does({{"do", "step"}});
  const Json wrong = page.issues({{"do", "set"},
                                  {"key", "navigator"},
                                  {"value", "{type: radar, typo: 1, speed_um_per_s: bad}"}});
  EXPECT_EQ(wrong.size(), 2u);
  EXPECT_EQ(wrong[0]["keys"][0], "navigator.typo");
  EXPECT_EQ(wrong[1]["keys"][0], "navigator.speed_um_per_s");
  EXPECT_EQ(wrong[1]["value"], "bad");
  EXPECT_EQ(wrong[1]["limit"], "a number");
  for (const char* radius : {"30", "20"})
    page.does({{"do", "set"}, {"key", "obstacles.0.shape.radius_um"}, {"value", radius}});
  page.does({{"do", "step"}});
  page.until("standing");
  EXPECT_EQ(page.latest["standing"]["changes"], Json({"obstacles.0.shape.radius_um=20"}));
  page.does(fastest);
  page.does(plays);
  page.ends();
  const experiment::Record record = record_of(lab, session);
  EXPECT_EQ(record.changes.size(), 2u);
  EXPECT_TRUE(experiment::replay(record).identical);
  EXPECT_EQ(page.issues({{"do", "set"}, {"key", "time_limit_s"}, {"value", "9"}}).size(), 1u);
}

TEST(Server, ARestartWithABadSettingKeepsTheSession) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  for (int i = 0; i < 3; ++i) page.does({{"do", "step"}});
  const Json issues =
      page.issues({{"do", "restart"}, {"settings", {"swarm.radius_um=-1", "seed=x"}}});
  ASSERT_EQ(issues.size(), 2u);
  EXPECT_EQ(issues[0]["keys"][0], "swarm.radius_um");
  EXPECT_EQ(issues[0]["place"], "swarm.radius_um");
  EXPECT_EQ(issues[0]["value"], "-1");
  EXPECT_EQ(issues[1]["keys"][0], "seed");
  page.does({{"do", "step"}});
  EXPECT_FALSE(
      page.until("frame", [](const Json& frame) { return frame["number"] == 3; }).is_null());
  page.ask({{"do", "restart"}, {"settings", {"seed=7"}}});
  const Json hello = page.until("hello", [](const Json& one) { return !one["settings"].empty(); });
  EXPECT_EQ(hello["scenario"]["seed"], 7);
  EXPECT_EQ(hello["settings"], Json({"seed=7"}));
  page.until("rows", [](const Json& rows) { return rows["anew"] == true; });
  page.does(fastest);
  page.does(plays);
  page.ends();
  EXPECT_EQ(record_of(lab, session).hash(), hash_of(lab.file, {"seed=7"}));
}

TEST(Server, ARecordIsPlayedAndSoughtIn) {
  const Lab lab;
  experiment::Session run(experiment::open_experiment(experiment::small_flight(), {}));
  run.finish();
  run.record_to(lab.folder / "run.h5");
  const std::uint64_t session = open(lab, {{"file", (lab.folder / "run.h5").string()}});
  TestPage page(lab, session);
  page.next();
  EXPECT_EQ(page.latest["hello"]["playback"], true);
  const std::size_t frames = run.record().frames.size();
  EXPECT_EQ(page.next()["rows"].get_binary().size(), 80 * frames);
  page.does(fastest);
  page.does(plays);
  EXPECT_EQ(page.ends()["frames"], frames);
  page.does({{"do", "seek"}, {"number", 5}});
  EXPECT_FALSE(
      page.until("frame", [](const Json& frame) { return frame["number"] == 5; }).is_null());
  page.does({{"do", "seek"}, {"number", 1e9}});
  page.does({{"do", "step"}});
  page.ends();
  // From the end it begins again.
  page.does({{"do", "speed"}, {"number", 0.001}});
  page.does(plays);
  EXPECT_FALSE(
      page.until("frame", [](const Json& frame) { return frame["number"] < 3; }).is_null());
  EXPECT_EQ(page.issues({{"do", "steer"}}).size(), 1u);
  EXPECT_EQ(page.issues({{"do", "set"}, {"key", "goal_um"}, {"value", "[1, 2]"}}).size(), 1u);
  EXPECT_EQ(page.issues({{"do", "restart"}, {"settings", {"seed=3"}}}).size(), 1u);
  EXPECT_EQ(record_of(lab, session).hash(), run.record().hash());
}

TEST(Server, APersonOperatesIt) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  page.does({{"do", "manual"}, {"on", true}});
  for (int i = 0; i < 5; ++i) {
    page.does({{"do", "steer"}, {"heading", 1}, {"speed", 50}});
    page.does({{"do", "step"}});
  }
  page.until("standing", [](const Json& one) { return one["mode"] == "manual"; });
  page.does({{"do", "manual"}, {"on", false}});
  page.does({{"do", "hold"}, {"on", true}});
  page.does({{"do", "step"}});
  page.until("standing", [](const Json& one) { return one["mode"] == "hold"; });
  page.does({{"do", "end"}});
  page.does(plays);
  EXPECT_EQ(page.ends()["status"], "stopped");
  EXPECT_TRUE(experiment::replay(record_of(lab, session)).identical);
}

TEST(Server, DownloadsAreWhatTheirNamesSay) {
  const Lab lab;
  const std::uint64_t session = open(lab, {{"file", lab.file}, {"settings", {"seed=5"}}});
  TestPage page(lab, session);
  for (int i = 0; i < 3; ++i) page.does({{"do", "step"}});
  page.does({{"do", "set"}, {"key", "goal_tolerance_um"}, {"value", "60"}});
  const std::string at = "/api/sessions/" + std::to_string(session) + "/";
  const Reply yaml = get(lab, at + "scenario.yaml");
  EXPECT_EQ(yaml[http::field::content_type], "application/yaml");
  EXPECT_EQ(yaml.body(),
            experiment::scenario_text(experiment::read_scenario(lab.file, {"seed=5"})));
  const std::string csv = get(lab, at + "frames.csv").body();
  EXPECT_EQ(std::ranges::count(csv, '\n'), 4);
  EXPECT_EQ(get(lab, at + "events.csv").result(), http::status::ok);
  for (const char* name : {"", "x", "record.h5/", "../record.h5", "frames.csv/x"})
    EXPECT_EQ(get(lab, at + name).result(), http::status::not_found) << name;
  EXPECT_EQ(get(lab, "/api/sessions/" + std::to_string(session + 99) + "/record.h5").result(),
            http::status::not_found);
}

TEST(Server, ADownloadedScenarioFindsItsFiles) {
  Lab lab;
  std::filesystem::create_directories(lab.folder / "maps");
  lab.folder.with("maps/walls.csv", "5,5,9,9\n");
  experiment::Scenario scenario = experiment::small_flight();
  const Box bounds =
      experiment::build_world(experiment::load_scene(scenario, lab.folder / "")).map->bounds();
  scenario.map = formats::RectanglesMap{
      .lo = bounds.lo, .hi = bounds.hi, .rectangles = {}, .file = "maps/walls.csv"};
  const auto file = lab.folder.with("near.yaml", experiment::scenario_text(scenario));
  const std::uint64_t session = open(lab, {{"file", file.string()}});
  const Reply yaml = get(lab, "/api/sessions/" + std::to_string(session) + "/scenario.yaml");
  std::filesystem::create_directories(lab.folder / "far");
  const auto far = lab.folder.with("far/scenario.yaml", yaml.body());
  EXPECT_EQ(hash_of(far), hash_of(file));
}

TEST(Server, ScriptsAreSentCompressedToThoseWhoTakeIt) {
  const Lab lab;
  asio::io_context io;
  beast::tcp_stream stream(io);
  stream.connect(lab.endpoint());
  http::request<http::empty_body> request{http::verb::get, "/app.js?token=" + lab.token, 11};
  request.set(http::field::host, lab.host);
  request.set(http::field::accept_encoding, "br, gzip");
  http::write(stream, request);
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(1 << 30);
  http::read(stream, buffer, parser);
  const Reply packed = parser.release();
  EXPECT_EQ(packed[http::field::content_encoding], "gzip");
  EXPECT_EQ(packed.body().substr(0, 2), "\x1f\x8b");
  const Reply plain = get(lab, "/app.js");
  EXPECT_EQ(plain[http::field::content_encoding], "");
  EXPECT_LT(2 * packed.body().size(), plain.body().size());
}

TEST(Server, ListsAndDrawsWhatCanBeOpened) {
  const Lab lab;
  const Json listing = Json::parse(get(lab, "/api/scenarios").body());
  ASSERT_EQ(listing["scenarios"].size(), 1u);
  EXPECT_EQ(listing["scenarios"][0]["file"], lab.file);
  EXPECT_FALSE(listing.contains("open"));
  std::string encoded;
  for (const char c : lab.file) encoded += c == '/' ? "%2F" : std::string(1, c);
  const Reply picture = get(lab, "/api/thumbnail?file=" + encoded);
  EXPECT_EQ(picture.result(), http::status::ok) << picture.body();
  EXPECT_EQ(picture[http::field::content_type], "image/svg+xml");
  EXPECT_EQ(get(lab, "/api/thumbnail?file=/etc/passwd").result(), http::status::bad_request);
  EXPECT_EQ(get(lab, "/api/thumbnail").result(), http::status::bad_request);
  EXPECT_TRUE(Json::parse(get(lab, "/api/schema").body()).contains("properties"));
}

TEST(Server, ServesItsPageWithAStrictPolicy) {
  const Lab lab;
  const Reply page = get(lab, "/?token=" + lab.token);
  EXPECT_EQ(page.result(), http::status::ok);
  EXPECT_NE(page.body().find("<html"), std::string::npos);
  EXPECT_NE(page[http::field::set_cookie].find("SameSite=Strict"), beast::string_view::npos);
  EXPECT_TRUE(page["Content-Security-Policy"].starts_with("default-src 'none'"));
  EXPECT_EQ(page["X-Content-Type-Options"], "nosniff");
  EXPECT_NE(get(lab, "/licences.txt").body().find("pixi"), std::string::npos);
  EXPECT_EQ(get(lab, "/app.js").result(), http::status::ok);
  EXPECT_EQ(get(lab, "/../app.js").result(), http::status::not_found);
}

TEST(Server, WhatItWasStartedWithIsOpenedWithoutAName) {
  const fs::path file = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios/first_flight.yaml";
  const Lab lab({.opening = Opening{.file = file, .options = {.settings = {"seed=4"}}}});
  EXPECT_TRUE(Json::parse(get(lab, "/api/scenarios").body())["open"]);
  TestPage page(lab, open(lab, {{"settings", {"tick_s=0.2"}}}));
  page.next();
  EXPECT_EQ(page.latest["hello"]["scenario"]["seed"], 4);
  EXPECT_EQ(page.latest["hello"]["scenario"]["tick_s"], 0.2);
  EXPECT_EQ(page.latest["hello"]["settings"], Json({"seed=4", "tick_s=0.2"}));
}

TEST(Server, ASimulatedRigIsOpenedToo) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the thread sanitizer does not see into OpenCV's threads";
#endif
  const fs::path scenarios = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios";
  const Lab lab({.opening = Opening{.file = scenarios / "papers/drrt/s_channel.yaml",
                                    .options = {.settings = {"time_limit_s=1"},
                                                .rig = scenarios / "rigs/ribbon.yaml"}}});
  const std::uint64_t session = open(lab, Json::object());
  TestPage page(lab, session);
  page.next();
  EXPECT_TRUE(page.latest["hello"]["rig"].get<std::string>().ends_with("ribbon.yaml"));
  page.does(fastest);
  page.does(plays);
  page.ends();
  EXPECT_FALSE(record_of(lab, session).rig.empty());
}

TEST(Server, ARunIsExportedAsPictureAndVideo) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  const std::string path = "/api/sessions/" + std::to_string(session);
  Reply reply = get(lab, path + "/picture.svg");
  EXPECT_EQ(reply.result(), http::status::bad_request);
  EXPECT_NE(reply.body().find("no frames"), std::string::npos) << reply.body();
  TestPage page(lab, session);
  page.does(fastest);
  page.does(plays);
  page.ends();
  reply = get(lab, path + "/picture.svg?t=3");
  EXPECT_EQ(reply.result(), http::status::ok);
  EXPECT_EQ(reply[http::field::content_type], "image/svg+xml");
  EXPECT_NE(reply.body().find("</svg>"), std::string::npos);
  for (const char* wrong : {"/picture.svg?t=-1", "/picture.svg?t=x", "/run.mp4?speed=0",
                            "/run.mp4?speed=nan", "/run.mp4?width=9000", "/run.mp4?width=3x",
                            "/run.gif?from=5&to=2", "/run.gif?from=-1", "/run.mp4?from=1e8"}) {
    reply = get(lab, path + wrong);
    EXPECT_EQ(reply.result(), http::status::bad_request) << wrong;
    EXPECT_EQ(reply.body().find("tmp"), std::string::npos) << reply.body();
  }
  reply = get(lab, path + "/run.mp4?speed=20&width=320");
  EXPECT_EQ(reply.result(), http::status::ok) << reply.body();
  EXPECT_EQ(reply.body().substr(4, 4), "ftyp");
  reply = get(lab, path + "/run.gif?from=1&to=2&width=320");
  EXPECT_EQ(reply.result(), http::status::ok) << reply.body();
  EXPECT_EQ(reply[http::field::content_type], "image/gif");
  EXPECT_EQ(reply.body().substr(0, 6), "GIF89a");
  EXPECT_GT(std::ranges::count(reply.body(), '\x21'), 12);  // an extension a picture
}

TEST(Server, WhatCannotBeOpenedIsToldInLines) {
  const Lab lab;
  const auto refused = [&](const Json& body) {
    const Reply reply = ask(lab, http::verb::post, "/api/sessions", body.dump());
    EXPECT_EQ(reply.result(), http::status::bad_request);
    return Json::parse(reply.body())["error"].get<std::string>();
  };
  EXPECT_NE(refused({{"file", "/etc/passwd"}}).find("/etc/passwd"), std::string::npos);
  EXPECT_NE(refused({{"file", lab.file}, {"settings", {"tick_s=0"}}}).find("tick_s"),
            std::string::npos);
  const std::string outside = "map={type: geojson, file: ../outside.geojson}";
  EXPECT_NE(refused({{"file", lab.file}, {"settings", {outside}}}).find("no such file"),
            std::string::npos);
  refused(Json::array());
  refused({{"fil", lab.file}});
  refused(Json::object());
  TestPage page(lab, open(lab));
  EXPECT_EQ(page.issues({{"do", "restart"}, {"settings", {outside}}}).size(), 1u);
}

TEST(Server, APortInUseIsTold) {
  const Lab lab;
  const std::string told = test::error_of([&] { Server({.port = lab.port}); });
  EXPECT_TRUE(test::is_one_line_naming(told, "127.0.0.1", {std::to_string(lab.port)}));
  EXPECT_TRUE(test::is_one_line_naming(test::error_of([] { Server({.listen = "nowhere"}); }),
                                       "--listen", {"nowhere"}));
}

}  // namespace
}  // namespace microswarm::lab

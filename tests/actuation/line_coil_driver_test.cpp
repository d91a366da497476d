// SPDX-License-Identifier: Apache-2.0
// The line driver with servers, which are threads of this process.
#include "microswarm/actuation/drivers/line_coil_driver.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <random>
#include <thread>

#include "microswarm/actuation/coils/coil_controller.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/text/file.hpp"
#include "tests/actuation/line_drivers.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::actuation {
namespace {

using std::chrono::milliseconds;

TEST(LineProtocol, TheLinesArePinned) {
  EXPECT_EQ(line_hello(1, "currents", 8, 200), "hello 1 1 currents 8 200\n");
  EXPECT_EQ(line_message("set", 7, std::vector<double>{1.5, -2, -1e-7}),
            "set 7 1.500000 -2.000000 0.000000\n");
  EXPECT_EQ(line_message("stop", 8), "stop 8\n");
}

TEST(LineProtocol, RepliesAreReadAndEverythingElseIsNone) {
  const auto good = parse_line_reply("  ok\t12  1.5 -2 +3e-1 ");
  ASSERT_TRUE(good);
  EXPECT_EQ(good->verdict, LineVerdict::ok);
  EXPECT_EQ(good->sequence, 12u);
  EXPECT_EQ(good->values, (std::vector<double>{1.5, -2, 0.3}));
  const auto off = parse_line_reply("off 4294967295 no set \xe2\x80\xae for\x9b 0.2 s");
  ASSERT_TRUE(off);
  EXPECT_EQ(off->sequence, 4294967295u);
  EXPECT_EQ(off->text, "no set ? for? 0.2 s");
  std::string many = "ok 1";
  for (std::size_t k = 0; k <= line_protocol_values; ++k) many += " 1";
  for (const std::string& odd :
       {std::string("ok 1 nan"), std::string("ok 1 1 inf"), std::string("ok 1 1e999"),
        std::string("ok 1 0x10"), std::string("ok 1 1,5"), many}) {
    const auto reply = parse_line_reply(odd);
    ASSERT_TRUE(reply) << odd;
    EXPECT_TRUE(reply->values.empty()) << odd;
  }
  for (const char* none : {"", "ok", "ok x 1", "ok -1 1", "ok 4294967296 1", "ok 1.5", "okay 1",
                           "OK 1", "1 ok", "ok 1 \x1b[2J", "ok\a 1"})
    EXPECT_FALSE(parse_line_reply(none)) << none;
  EXPECT_FALSE(parse_line_reply("off 1 " + std::string(line_protocol_length, 'x')));
}

TEST(LineProtocol, TemperaturesFollowTheValues) {
  const auto reply = parse_line_reply("limited 7 1 -2 t 45.5 - 22");
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->values, (std::vector<double>{1, -2}));
  ASSERT_EQ(reply->temperatures.size(), 3u);
  EXPECT_EQ(reply->temperatures[0], 45.5);
  EXPECT_TRUE(std::isnan(reply->temperatures[1]));
  EXPECT_EQ(reply->temperatures[2], 22);
  EXPECT_TRUE(parse_line_reply("ok 7 1 t")->temperatures.empty());
  EXPECT_TRUE(parse_line_reply("ok 7 1 2")->temperatures.empty());
  for (const char* const odd :
       {"ok 7 1 t hot", "ok 7 1 t nan", "ok 7 1 t -300", "ok 7 1 t 2e4", "ok 7 1 t 20 t 20"}) {
    EXPECT_TRUE(parse_line_reply(odd)->temperatures.empty()) << odd;
    EXPECT_EQ(parse_line_reply(odd)->values, std::vector<double>{1}) << odd;
  }
}

TEST(LineProtocol, LinesOfAnyLengthCostOnlyThemselves) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::string bytes;
    std::vector<std::string> lines;
    for (int k = 0; k < 8; ++k) {
      const std::string line(random() % (2 * line_protocol_length), static_cast<char>('a' + k));
      bytes += line + (random() % 2 ? "\r\n" : "\n");
      if (line.size() + 1 < line_protocol_length) lines.push_back(line);
    }
    std::vector<std::string> found;
    LineReader reader;
    for (const char byte : bytes)
      if (auto line = reader.take(static_cast<std::uint8_t>(byte)))
        if (line->size() + 1 < line_protocol_length) found.push_back(*std::move(line));
    EXPECT_EQ(found, lines);
  }
}

std::unique_ptr<LineCoilDriver> open(const Server& server, const LineDriverParams& p = quick()) {
  return std::make_unique<LineCoilDriver>(
      [&](double) { return connect_socket(server.path(), 0, 2); }, p, 3);
}

std::function<std::string(const Words&)> other(const std::string& word,
                                               std::function<std::string(const Words&)> change) {
  return [=](const Words& words) { return words[0] == word ? change(words) : Server::good(words); };
}

TEST(LineCoilDriver, DrivesThroughASocketAndStops) {
  for (const bool tcp : {false, true}) {
    Server server({}, tcp);
    {
      LineCoilDriver driver(
          [&](double) {
            return tcp ? connect_socket("localhost", server.port(), 2)
                       : connect_socket(server.path(), 0, 2);
          },
          quick(), 3);
      EXPECT_EQ(server.last(), (Words{"hello", "1", "1", "currents", "3", "200"}));
      EXPECT_EQ(driver.capabilities().channels, 3);
      EXPECT_EQ(driver.drive(amperes), DriveStatus::driven);
      EXPECT_EQ(server.last(), (Words{"set", "3", "1.000000", "-2.500000", "0.000000"}));
      EXPECT_EQ(driver.report().currents[1], -2.5);
      EXPECT_EQ(driver.drive(amperes), DriveStatus::driven);
      EXPECT_EQ(server.count("arm"), 1);
      EXPECT_TRUE(driver.stop().confirmed);
      EXPECT_EQ(driver.report().currents[1], 0);
      EXPECT_EQ(driver.drive(amperes), DriveStatus::driven);
      EXPECT_EQ(server.count("arm"), 2);
    }
    EXPECT_EQ(server.last()[0], "stop");
  }
}

TEST(LineCoilDriver, WhatIsTooMuchIsRefusedByTheHost) {
  Server server;
  LineDriverParams p = quick();
  p.full_scale = 2;
  EXPECT_EQ(open(server, p)->drive(amperes), DriveStatus::refused);
  EXPECT_EQ(server.count("set"), 0);
}

TEST(LineCoilDriver, AFieldIsSentInPlaceOfTheCurrents) {
  Server server;
  LineDriverParams p = quick();
  p.send = DriverInput::field;
  LineCoilDriver driver([&](double) { return connect_socket(server.path(), 0, 2); }, p, 8);
  EXPECT_EQ(server.last(), (Words{"hello", "1", "1", "field", "3", "200"}));
  std::vector<double> currents(8, 1.0);
  EXPECT_EQ(driver.capabilities().channels, 8);
  const std::array<double, 3> field{0.5, 0, -7};
  EXPECT_EQ(driver.drive(FieldRequest{field, currents}), DriveStatus::driven);
  EXPECT_EQ(server.last(), (Words{"set", "3", "0.500000", "0.000000", "-7.000000"}));
  EXPECT_EQ(driver.report().currents[7], 1);
  currents.assign(8, 30);  // beyond the full scale of its coils
  EXPECT_EQ(driver.drive(FieldRequest{field, currents}), DriveStatus::refused);
  currents.assign(8, 0);  // no currents are taken
  EXPECT_EQ(driver.drive(currents), DriveStatus::refused);
  EXPECT_EQ(driver.drive(FieldRequest{field, currents}), DriveStatus::driven);
}

TEST(LineCoilDriver, ScaledValuesAreToldAndOtherValuesAreAFault) {
  const auto answered = [](const std::string& values, DriveStatus expected, double second) {
    Server server(other("set", [=](const Words&) { return values + "\n"; }));
    const auto driver = open(server);
    EXPECT_EQ(driver->drive(amperes), expected) << values << driver->report().reason;
    EXPECT_DOUBLE_EQ(driver->report().currents[1], second);
    EXPECT_DOUBLE_EQ(driver->report().scale, expected == DriveStatus::scaled ? 0.4 : 1);
    EXPECT_EQ(driver->report().reason.empty(), expected != DriveStatus::mismatched);
  };
  answered("ok 3 1.004 -2.495 0", DriveStatus::driven, -2.5);
  answered("limited 3 0.4 -1 0", DriveStatus::scaled, -1);
  answered("ok 3 0.4 -1 0", DriveStatus::mismatched, 0);
  answered("limited 3 0.4 -2.5 0", DriveStatus::mismatched, 0);  // another direction
  answered("limited 3 -0.4 1 0", DriveStatus::mismatched, 0);    // reversed
  answered("limited 3 1.2 -3 0", DriveStatus::mismatched, 0);    // more
  answered("ok 3 1 -2.5", DriveStatus::mismatched, 0);
  answered("ok 3 1 -2.5 0 0", DriveStatus::mismatched, 0);
  answered("ok 3 1 nan 0", DriveStatus::mismatched, 0);
}

// A probe that shows more than the thermal model warms it, one that shows less does not cool it.
TEST(LineCoilDriver, ProbesWarmTheThermalModel) {
  std::atomic<bool> hot = false;
  Server server(other("set", [&](const Words& words) {
    std::string reply = Server::good(words);
    reply.pop_back();
    return reply + (hot ? " t 95 10 -\n" : " t 40 10 -\n");
  }));
  const auto driver = open(server);
  CoilSystemParams params{.coils = HelmholtzCoils{}};
  params.amplifiers = {AmplifierParams{.max_current = 5, .max_temperature = 90}};
  const CoilSystem system(params);
  CoilController controller(system, {}, *driver, 0);
  controller.command(Eigen::VectorXd(Eigen::Vector3d(1, 1, 1)));
  for (int i = 0; i < 10; ++i) controller.advance(0.1);
  EXPECT_EQ(controller.output().scale, 1);
  EXPECT_EQ(controller.temperatures()[0], 40);
  EXPECT_NEAR(controller.temperatures()[1], 22, 0.1);
  EXPECT_NEAR(controller.temperatures()[2], 22, 0.1);
  hot = true;
  for (int i = 0; i < 10; ++i) controller.advance(0.1);
  EXPECT_EQ(controller.temperatures()[0], 95);
  EXPECT_LT(controller.output().scale, 1e-6);
}

TEST(LineCoilDriver, AnAnswerToAnotherMessageIsNone) {
  Server server(other("set", [](const Words& w) {
    return "ok 2 1 -2.5 0\nhello world\n\xff\x1b[2J\n" + std::string(9000, 'x') + "\n" +
           Server::good(w);
  }));
  EXPECT_EQ(open(server)->drive(amperes), DriveStatus::driven);
}

TEST(LineCoilDriver, SilenceAndGarbageAreNoAnswer) {
  const auto answered = [](const std::string& text, const std::string& said) {
    Server server(other("set", [=](const Words&) { return text; }));
    const auto driver = open(server);
    const double began = steady_seconds();
    EXPECT_EQ(driver->drive(amperes), DriveStatus::no_answer);
    EXPECT_LT(steady_seconds() - began, 1.5);
    EXPECT_EQ(driver->report().reason, said);
    // What comes after half a line belongs to it.
    EXPECT_EQ(driver->stop().confirmed, text.empty() || text.ends_with('\n'));
  };
  answered("", "nothing came back, messages sent: 1");
  answered("ok 2 1 -2.5 0\n", "it answered another message");
  answered("\x1b[2Jhi\n", "it said '?[2Jhi', which is no answer");
  answered("ok 3 1 -2.5 0", "it said 'ok 3 1 -2.5 0', which is no answer");  // without its end
  answered(std::string(9000, 'x'),
           "it floods the line, 9000 bytes without an answer: '" + std::string(60, 'x') + "…'");
}

TEST(LineCoilDriver, LateAnswersAreSaidWithTheirDelayAndTheTimeAllowed) {
  Server server(other("set", [](const Words& w) {
    std::this_thread::sleep_for(milliseconds(70));
    return Server::good(w);
  }));
  LineDriverParams p = quick();
  p.reply_timeout = 0.05;
  const auto driver = open(server, p);
  for (int k = 0; k < max_missed_answers; ++k)
    EXPECT_EQ(driver->drive(amperes), DriveStatus::no_answer);
  const std::string& why = driver->report().reason;
  EXPECT_TRUE(test::names(why, "its answer came after ")) << why;
  EXPECT_TRUE(test::names(why, " ms, reply_timeout_s is 0.05")) << why;
  EXPECT_TRUE(driver->stop().good()) << "it is alive";
}

TEST(LineCoilDriver, AConnectionThatIsResetIsSaidWithItsCause) {
  Server server(other("set", [](const Words&) { return "reset"; }), true);
  LineCoilDriver driver([&](double) { return connect_socket("localhost", server.port(), 2); },
                        quick(), 3);
  EXPECT_EQ(driver.drive(amperes), DriveStatus::gone);
  EXPECT_TRUE(test::names(driver.report().reason, "Connection reset by peer"))
      << driver.report().reason;
}

TEST(LineCoilDriver, ADriverThatWasOffIsArmedAgain) {
  Server server(other("set", [sets = 0](const Words& w) mutable {
    return ++sets == 2 ? "off " + w[1] + " silence\n" : Server::good(w);
  }));
  const auto driver = open(server);
  EXPECT_EQ(driver->drive(amperes), DriveStatus::driven);
  EXPECT_EQ(driver->drive(amperes), DriveStatus::resumed);
  EXPECT_EQ(server.count("arm"), 2);
}

TEST(LineCoilDriver, RefusalsAreToldInTheDriversWords) {
  const auto answered = [](const std::string& word, const std::string& verdict,
                           DriveStatus status) {
    Server server(
        other(word, [=](const Words& w) { return verdict + " " + w[1] + " interlock\n"; }));
    const auto driver = open(server);
    EXPECT_EQ(driver->drive(amperes), status) << word << verdict;
    EXPECT_EQ(driver->report().reason, "interlock");
    EXPECT_EQ(trouble_text(*driver, status), std::string(trouble_text(status)) + ": interlock");
  };
  answered("arm", "refused", DriveStatus::not_armed);
  answered("arm", "off", DriveStatus::not_armed);
  answered("arm", "emergency", DriveStatus::emergency);
  answered("set", "emergency", DriveStatus::emergency);
  answered("set", "refused", DriveStatus::refused);
  answered("set", "off", DriveStatus::not_armed);
}

TEST(LineCoilDriver, ItMustArmAndStopAtZero) {
  Server armed(other("arm", [](const Words& w) { return "ok " + w[1] + " 0 3 0\n"; }));
  EXPECT_EQ(open(armed)->drive(amperes), DriveStatus::mismatched);
  Server stopped(other("stop", [](const Words& w) { return "ok " + w[1] + " 0 3 0\n"; }));
  const auto driver = open(stopped);
  EXPECT_EQ(driver->drive(amperes), DriveStatus::driven);
  EXPECT_FALSE(driver->stop().confirmed);
}

TEST(LineCoilDriver, AClosedConnectionIsNoticedAtOnce) {
  Server server(other("set", [](const Words&) { return "close"; }));
  const auto driver = open(server);
  const double began = steady_seconds();
  EXPECT_EQ(driver->drive(amperes), DriveStatus::gone);
  EXPECT_LT(steady_seconds() - began, 0.25);
  EXPECT_TRUE(test::names(driver->report().reason, "has closed the connection"));
  EXPECT_FALSE(driver->stop().confirmed);
}

TEST(LineCoilDriver, AnInterruptionDoesNotWaitForTheAnswer) {
  Server server(other("set", [](const Words&) { return ""; }));
  LineDriverParams p = quick();
  p.reply_timeout = 1;
  const auto driver = open(server, p);
  double ended = 0;
  std::thread coils([&] {
    EXPECT_EQ(driver->drive(amperes), DriveStatus::no_answer);
    ended = steady_seconds();
  });
  std::this_thread::sleep_for(milliseconds(50));
  const double asked = steady_seconds();
  driver->interrupt();
  coils.join();
  EXPECT_LT(ended - asked, 0.2);
  EXPECT_TRUE(driver->stop().confirmed);
}

TEST(LineCoilDriver, WhoDoesNotConsentIsNamed) {
  Server old(other("hello", [](const Words& w) { return "refused " + w[1] + " version 1\n"; }));
  refuses([&] { open(old); }, old.path(), {"version 1"});
  Server small(other("hello", [](const Words& w) { return "ok " + w[1] + " 0 0\n"; }));
  refuses([&] { open(small); }, small.path(), {"3 zeros"});
  Server mute([](const Words&) { return ""; });
  LineDriverParams p = quick();
  p.connect_timeout = 0.2;
  refuses([&] { open(mute, p); }, mute.path(), {"0.2 s"});
  refuses([&] { connect_socket("/none/such.sock", 0, 1); }, "/none/such.sock", {"cannot connect"});
  refuses([&] { connect_socket("localhost", 1, 1); }, "localhost:1", {"refused"});
}

TEST(LineCoilDriver, AServerHasOneHost) {
  for (const bool tcp : {false, true}) {
    const test::Folder folder;
    for (const char* coils : {"one", "two"}) write_file_atomically(folder / coils, "x");
    Server server({}, tcp);
    SocketDriverParams p;
    p.host = tcp ? "localhost" : server.path();
    p.port = server.port() > 0 ? server.port() : 1;
    p.connect_timeout = 0.5;
    const auto first = p.open({folder / ".", folder / "one", 3});
    if (tcp) p.host = "127.0.0.1";
    refuses(
        [&] {
          p.open({folder / ".", folder / "two", 3});
        },
        tcp ? "127.0.0.1:" + std::to_string(server.port()) : server.path(), {"another program"});
  }
}

}  // namespace
}  // namespace microswarm::actuation

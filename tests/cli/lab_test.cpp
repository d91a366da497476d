// SPDX-License-Identifier: Apache-2.0
// `microswarm lab` as a program: what it refuses before it listens, and that it serves until
// Ctrl-C.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <optional>

#include "inputs.hpp"
#include "notices.hpp"
#include "program.hpp"

namespace microswarm::test {
namespace {

const fs::path shipped = fs::path(MICROSWARM_SOURCE_DIR) / "scenarios";

/// A socket at a port of the loopback; listening at any if `port` is 0, else connected.
class Loopback {
 public:
  explicit Loopback(std::uint16_t port = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(port);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const auto* address = reinterpret_cast<const sockaddr*>(&at);
    if (port == 0) {
      ::bind(socket_, address, sizeof at);
      ::listen(socket_, 1);
    } else {
      EXPECT_EQ(::connect(socket_, address, sizeof at), 0);
    }
  }
  ~Loopback() { ::close(socket_); }
  Loopback(const Loopback&) = delete;
  Loopback& operator=(const Loopback&) = delete;

  std::uint16_t port() const {
    sockaddr_in at{};
    socklen_t size = sizeof at;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&at), &size);
    return ntohs(at.sin_port);
  }
  void say(const std::string& request) const {
    EXPECT_EQ(::send(socket_, request.data(), request.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(request.size()));
  }
  /// The reply to a request, until the other side closes.
  std::string ask(const std::string& request) const {
    say(request);
    std::string reply;
    char some[4096];
    for (ssize_t n = 0; (n = ::recv(socket_, some, sizeof some, 0)) > 0;)
      reply.append(some, static_cast<std::size_t>(n));
    return reply;
  }

  /// Forgets what has come.
  void drain() const {
    char some[65536];
    while (::recv(socket_, some, sizeof some, MSG_DONTWAIT) > 0) {
    }
  }

 private:
  int socket_;
};

/// The lab as a program, once it has said where it listens.
class RunningLab {
 public:
  RunningLab(Arguments arguments, Surroundings at) {
    at.out = at.folder / "said.txt";
    write_file_atomically(at.out, "");
    arguments.insert(arguments.begin(), {"lab", "--no-open"});
    program_.emplace(arguments, at);
    for (int i = 0; i < 6000 && !said_.ends_with('\n') && program_->running(); ++i) {
      sleep_ms(10);
      said_ = read_file(at.out);
    }
    const std::string start = "http://127.0.0.1:";
    EXPECT_TRUE(said_.starts_with(start)) << said_ << (program_->running() ? "" : end().err);
    if (said_.starts_with(start))
      port_ = said_.substr(start.size(), said_.find('/', start.size()) - start.size());
  }
  /// A request to open a session.
  std::string opening(const std::string& body) const {
    return "POST /api/sessions?token=" + said_.substr(said_.find("token=") + 6, 32) +
           " HTTP/1.1\r\nHost: 127.0.0.1:" + port_ +
           "\r\nConnection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
           body;
  }
  /// A request to close a session.
  std::string closing(const std::string& session) const {
    return "DELETE /api/sessions/" + session +
           "?token=" + said_.substr(said_.find("token=") + 6, 32) +
           " HTTP/1.1\r\nHost: 127.0.0.1:" + port_ + "\r\nConnection: close\r\n\r\n";
  }
  /// A request for the stream of a session.
  std::string stream(const std::string& session) const {
    return "GET /api/stream/" + session + "?token=" + said_.substr(said_.find("token=") + 6, 32) +
           " HTTP/1.1\r\nHost: 127.0.0.1:" + port_ + "\r\nOrigin: http://127.0.0.1:" + port_ +
           "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  }
  std::uint16_t port() const { return static_cast<std::uint16_t>(std::stoi("0" + port_)); }
  void send(int signal) const { program_->send(signal); }
  /// Ends it by Ctrl-C.
  Outcome end() {
    program_->send(SIGINT);
    return program_->wait();
  }

 private:
  std::optional<Program> program_;
  std::string said_;
  std::string port_;
};

/// A page with the controls of a rig's lab, which writes its runs into a folder.
class RigPage {
 public:
  RigPage(const RunningLab& lab, fs::path runs) : stream_(lab.port()), runs_(std::move(runs)) {
    const std::string opened = Loopback(lab.port()).ask(lab.opening("{}"));
    const std::size_t at = opened.find("\"session\":");
    EXPECT_NE(at, std::string::npos) << opened;
    number = std::to_string(std::strtoull(opened.c_str() + at + 10, nullptr, 10));
    stream_.say(lab.stream(number));
  }
  std::string number;  ///< of the session
  /// Sends a request as a frame of WebSocket whose mask is 0.
  void ask(const std::string& request) {
    ASSERT_LT(request.size(), 126u);
    stream_.say(std::string("\x81") + static_cast<char>(0x80 | request.size()) +
                std::string(4, '\0') + request);
  }
  /// Drives the coils for a second, after `before` runs.
  void drive(std::ptrdiff_t before) {
    for (int i = 0; i < 3000 && count("") <= before; ++i) beat(i % 50 == 0);
    stay(1000);
  }
  /// Stays there for `ms`.
  void stay(int ms) {
    for (int i = 0; i < ms / 10; ++i) beat(false);
  }
  /// Until so many runs have a record.
  void await_records(std::ptrdiff_t count_then) {
    for (int i = 0; i < 3000 && count("run.h5") < count_then; ++i) sleep_ms(10);
    EXPECT_EQ(count("run.h5"), count_then);
  }

 private:
  void beat(bool arms) {
    ask(R"({"do": "beat"})");
    if (arms) ask(R"({"do": "arm", "id": 1})");
    stream_.drain();
    sleep_ms(10);
  }
  std::ptrdiff_t count(const std::string& file) const {
    std::error_code none;
    return std::ranges::count_if(fs::directory_iterator(runs_, none),
                                 [&](const auto& run) { return fs::exists(run.path() / file); });
  }

  Loopback stream_;
  fs::path runs_;
};

class LabCommand : public CommandLine {};

TEST_F(LabCommand, WhatCannotBeOpenedEndsItBeforeItListens) {
  refused({"lab", "none.yaml", "--no-open"}, naming("none.yaml", {}));
  write("flight.yaml", two_rooms());
  write("bad.yaml", with(two_rooms(), "tolerance", "goal_tolerance_um: -1"));
  write("run.h5", "no record");
  refused({"lab", "bad.yaml", "--no-open"}, naming("bad.yaml:13:20", {"goal_tolerance_um", "-1"}));
  refused({"lab", "run.h5", "--no-open"}, naming("run.h5", {}));
  refused({"lab", "flight.yaml", "--set", "tick_s=0", "--no-open"}, naming("--set tick_s", {"0"}));
  refused({"lab", "flight.yaml", "--rig", "none.yaml", "--no-open"}, naming("none.yaml", {}));
  refused({"lab", "--set", "tick_s=1", "--no-open"}, naming("--set", {}));
  refused({"lab", "--rig", "rig.yaml", "--no-open"}, naming("--rig", {}));
  refused({"lab", "--folder", "none", "--no-open"}, naming("none", {}));
  refused({"lab", "--listen", "nowhere", "--no-open"}, naming("--listen", {"nowhere"}));
  good({"run", "flight.yaml", "--out", "out", "--no-report"});
  refused({"lab", "out/run.h5", "--set", "tick_s=1", "--no-open"}, naming("out/run.h5", {}));
}

TEST_F(LabCommand, APortInUseEndsIt) {
  const Loopback taken;
  const std::string port = std::to_string(taken.port());
  refused({"lab", "--port", port, "--no-open"}, naming("127.0.0.1", {port}));
}

TEST_F(LabCommand, ServesScenariosRecordsAndSimulatedRigsUntilCtrlC) {
  write("flight.yaml", two_rooms());
  good({"run", "flight.yaml", "--out", "out", "--no-report"});
  const std::string scenario = shipped / "papers/drrt/s_channel.yaml";
  const std::string rig = shipped / "rigs/ribbon.yaml";
  for (const Arguments& arguments :
       {Arguments{"flight.yaml", "--set", "seed=3"}, Arguments{"out/run.h5"},
        Arguments{scenario, "--rig", rig, "--set-rig", "drive_rate_hz=250"}}) {
    RunningLab lab(arguments, at);
    const std::string reply = Loopback(lab.port()).ask(lab.opening("{}"));
    EXPECT_TRUE(reply.starts_with("HTTP/1.1 200 ")) << reply;
    EXPECT_NE(reply.find("\"session\""), std::string::npos) << reply;
    const Outcome outcome = lab.end();
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
  }
}

class LabRigCommand : public LabCommand {
 protected:
  Arguments arguments() const {
    Arguments all{(shipped / "first_rig.yaml").string(), "--rig",
                  (shipped / "rigs/vortex.yaml").string(), "--out", "runs"};
    // A busy computer is no fault here.
    for (const char* setting : {"lost_swarm_s=20", "max_frame_age_s=20", "deadman_s=20",
                                "max_pause_s=20", "missed_deadlines=1000"})
      all.insert(all.end(), {"--set-rig", std::string("safety.") + setting});
    const std::string told = (at.folder / "told").string();
    all.insert(all.end(), {"--set-rig",
                           "safety.on_fault=[sh, -c, 'echo \"$MICROSWARM_FAULT\" "
                           "\"$MICROSWARM_RECORD\" >" +
                               told + "; exit 7']"});
    return all;
  }
};

TEST_F(LabRigCommand, AFaultIsToldToTheCommandOfTheFileAndByTheExitCode) {
  RunningLab lab(arguments(), at);
  RigPage page(lab, at.folder / "runs");
  page.drive(0);
  page.await_records(1);  // a page that is silent is a fault
  for (int i = 0; i < 1000 && (!exists("told") || read("told").empty()); ++i) sleep_ms(10);
  ASSERT_TRUE(exists("told"));
  EXPECT_TRUE(names(read("told"), "no word from the page")) << read("told");
  EXPECT_TRUE(names(read("told"), fs::canonical(at.folder / "runs").string())) << read("told");
  const Outcome outcome = lab.end();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_TRUE(names(outcome.err, "note: safety.on_fault: sh ended with exit code 7"))
      << outcome.err;
}

TEST_F(LabRigCommand, ItsLastRunThatDroveCounts) {
  RunningLab lab(arguments(), at);
  RigPage page(lab, at.folder / "runs");
  page.drive(0);
  page.await_records(1);
  fs::remove(at.folder / "told");
  page.drive(1);
  page.ask(R"({"do": "end", "id": 2})");
  page.await_records(2);
  EXPECT_EQ(lab.end().code, 0);
  EXPECT_FALSE(exists("told"));
}

TEST_F(LabRigCommand, CtrlCWhileItDrivesIsNoFault) {
  RunningLab lab(arguments(), at);
  RigPage page(lab, at.folder / "runs");
  page.drive(0);
  EXPECT_EQ(lab.end().code, 0);
  EXPECT_FALSE(exists("told"));
}

TEST_F(LabRigCommand, ACommandThatHangsHoldsUpNoPage) {
  Arguments hangs = arguments();
  hangs.back() = "safety.on_fault=[sleep, '100']";
  const Notices manager("@microswarm_lab_test_" + std::to_string(::getpid()));
  manager.ask(at, 200);
  RunningLab lab(hangs, at);
  RigPage page(lab, at.folder / "runs");
  page.drive(0);
  page.await_records(1);
  const std::string reply = Loopback(lab.port()).ask(lab.closing(page.number));
  EXPECT_TRUE(reply.starts_with("HTTP/1.1 200 ")) << reply;
  sleep_ms(500);  // until the session has ended
  manager.within(0);
  EXPECT_GE(Notices::signs(manager.within(1000)), 3);
  EXPECT_EQ(lab.end().code, 4);
}

TEST_F(LabRigCommand, WithoutCurrentsItsMainLoopGivesSignsOfLife) {
  const Notices manager("@microswarm_lab_test_" + std::to_string(::getpid()));
  manager.ask(at, 200);
  RunningLab lab(arguments(), at);
  EXPECT_TRUE(manager.hears("READY=1"));
  manager.expect_signs_of(lab);
  EXPECT_EQ(lab.end().code, 0);
  EXPECT_TRUE(manager.hears("STOPPING=1"));
}

TEST_F(LabRigCommand, ALoopOfTheCoilsThatHangsGivesNoSignThoughThePageIsServed) {
  const Notices manager("@microswarm_lab_test_" + std::to_string(::getpid()));
  manager.ask(at, 200);
  Arguments driven = arguments();
  const std::string pid = (at.folder / "driver").string();
  driven.insert(
      driven.end(),
      {"--drawn-swarm", "--without-limits", "--coils-cold", "--set-rig",
       "driver={type: program, full_scale_a: 20, reply_timeout_s: 1, command: [sh, -c, "
       "'echo $$ >" +
           pid + "; exec python3 " MICROSWARM_SOURCE_DIR "/examples/drivers/line_driver.py']}"});
  RunningLab lab(driven, at);
  RigPage page(lab, at.folder / "runs");
  page.drive(0);
  EXPECT_GE(Notices::signs(manager.within(0)), 3);
  ASSERT_TRUE(exists("driver"));
  ::kill(std::stoi(read("driver")), SIGSTOP);
  page.stay(100);
  manager.within(0);
  page.stay(700);
  EXPECT_EQ(Notices::signs(manager.within(0)), 0);
  ::kill(std::stoi(read("driver")), SIGCONT);
  lab.end();
}

TEST_F(LabRigCommand, SignsOfLifeGoOnFromRunToRun) {
  const Notices manager("@microswarm_lab_test_" + std::to_string(::getpid()));
  manager.ask(at, 200);
  RunningLab lab(arguments(), at);
  RigPage page(lab, at.folder / "runs");
  page.drive(0);
  const std::vector<std::string> driven = manager.within(0);
  EXPECT_GE(Notices::signs(driven), 8);
  EXPECT_TRUE(std::ranges::any_of(driven, [](const std::string& message) {
    return message.starts_with("STATUS=") && names(message, "driven");
  }));
  EXPECT_TRUE(manager.hears("no word from the page"));
  EXPECT_GE(Notices::signs(manager.within(1000)), 3);
  EXPECT_EQ(lab.end().code, 4);
}

/// Command lines are seen by all users.
TEST_F(LabCommand, TheBrowsersCommandLineHasNoToken) {
  const fs::path folder = at.folder / "user's own";
  fs::create_directories(folder);
  fs::create_directories(at.folder / "bin");
  write("bin/xdg-open",
        "#!/bin/sh\nstat -c %a \"$1\" >rights\ncat \"$1\" >page\necho \"$*\" >words.part\n"
        "mv words.part words\n");
  fs::permissions(at.folder / "bin/xdg-open", fs::perms::owner_all);
  at.path = (at.folder / "bin").string() + ":" + std::getenv("PATH");
  at.environment = {{"DISPLAY", ":0"}, {"XDG_RUNTIME_DIR", folder.string()}};
  Program lab({"lab"}, at);
  for (int i = 0; i < 6000 && !exists("words") && lab.running(); ++i) sleep_ms(10);
  ASSERT_TRUE(exists("words"));
  const std::string file = read("words").substr(0, read("words").find('\n'));
  EXPECT_EQ(fs::path(file).parent_path(), folder) << file;
  EXPECT_EQ(read("rights"), "600\n");
  lab.send(SIGINT);
  const Outcome outcome = lab.wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string url = outcome.out.substr(0, outcome.out.find('\n'));
  EXPECT_NE(url.find("token="), std::string::npos);
  EXPECT_NE(read("page").find("content=\"0; url=" + url + "\""), std::string::npos) << read("page");
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(LabCommand, CtrlCEndsItWhileALargeMapIsRead) {
  std::string map;
  for (int i = 0; i < 200'000; ++i)
    map += std::to_string(20 * (i % 1000)) + "," + std::to_string(20 * (i / 1000)) + ",9,9\n";
  write("map.csv", map);
  write("large.yaml",
        "name: large\nmap: {type: rectangles, file: map.csv}\nswarm: {type: ribbon}\n"
        "start: {x_um: 15, y_um: 15, heading_deg: 0}\ngoal_um: [99, 99]\n");
  RunningLab lab({"--folder", at.folder}, at);
  const Loopback page(lab.port());
  page.say(lab.opening("{\"file\": \"" + (at.folder / "large.yaml").string() + "\"}"));
  sleep_ms(200);
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(lab.end().code, 0);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(), 5);
}

class ReportPage : public CommandLine {};

TEST_F(ReportPage, ARunIsOneFile) {
  write("flight.yaml", two_rooms());
  good({"run", "flight.yaml", "--out", "out", "--no-report"});
  const std::string said = good({"report", "out/run.h5", "--page", "run.html"});
  EXPECT_TRUE(said.starts_with("wrote run.html: ")) << said;
  EXPECT_TRUE(said.ends_with(" MB\n")) << said;
  EXPECT_FALSE(exists("report"));
  EXPECT_TRUE(read("run.html").starts_with("<!doctype html>"));
  good({"report", "out/run.h5", "--page", "both.html", "--out", "page"});
  EXPECT_TRUE(exists("page/index.html") && exists("both.html"));
}

TEST_F(ReportPage, ADamagedRecordOrAnotherNameIsRefusedInALine) {
  write("flight.yaml", two_rooms());
  good({"run", "flight.yaml", "--out", "out", "--no-report"});
  write("cut.h5", read("out/run.h5").substr(0, 5000));
  const Outcome cut = run({"report", "cut.h5", "--page", "run.html"});
  EXPECT_EQ(cut.code, 2);
  EXPECT_TRUE(is_one_line_naming(cut.err, "microswarm: cut.h5", {})) << cut.err;
  const Outcome named = run({"report", "out/run.h5", "--page", "run.pdf"});
  EXPECT_EQ(named.code, 2);
  const Outcome nowhere = run({"report", "out/run.h5", "--page", "no/where.html"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_TRUE(is_one_line_naming(nowhere.err, "microswarm: no/where.html", {})) << nowhere.err;
  EXPECT_FALSE(exists("run.html") || exists("run.pdf"));
}

}  // namespace
}  // namespace microswarm::test

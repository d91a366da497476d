// SPDX-License-Identifier: Apache-2.0
// `microswarm lab` as a program: what it refuses before it listens, and that it serves until
// Ctrl-C.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <optional>

#include "inputs.hpp"
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
  std::uint16_t port() const { return static_cast<std::uint16_t>(std::stoi("0" + port_)); }
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

}  // namespace
}  // namespace microswarm::test

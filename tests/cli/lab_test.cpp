// SPDX-License-Identifier: Apache-2.0
// `microswarm lab` as a program: what it refuses before it listens, and that it serves until
// Ctrl-C.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstring>

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
  /// The reply to a request, until the other side closes.
  std::string ask(const std::string& request) const {
    EXPECT_EQ(::send(socket_, request.data(), request.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(request.size()));
    std::string reply;
    char some[4096];
    for (ssize_t n = 0; (n = ::recv(socket_, some, sizeof some, 0)) > 0;)
      reply.append(some, static_cast<std::size_t>(n));
    return reply;
  }

 private:
  int socket_;
};

class LabCommand : public CommandLine {
 protected:
  /// Starts the lab, opens what it was started with, ends it by Ctrl-C; the reply to the opening.
  std::string opened(Arguments arguments) {
    write("said.txt", "");
    Surroundings there = at;
    there.out = at.folder / "said.txt";
    arguments.insert(arguments.begin(), {"lab", "--no-open"});
    Program lab(arguments, there);
    std::string said;
    for (int i = 0; i < 6000 && !said.ends_with('\n') && lab.running(); ++i) {
      sleep_ms(10);
      said = read("said.txt");
    }
    const std::string start = "http://127.0.0.1:";
    EXPECT_TRUE(said.starts_with(start)) << said;
    if (!said.starts_with(start)) return lab.wait().err;
    const std::string port = said.substr(start.size(), said.find('/', start.size()) - start.size());
    const std::string token = said.substr(said.find("token=") + 6, 32);
    const std::string reply =
        Loopback(static_cast<std::uint16_t>(std::stoi(port)))
            .ask("POST /api/sessions?token=" + token + " HTTP/1.1\r\nHost: 127.0.0.1:" + port +
                 "\r\nConnection: close\r\nContent-Length: 2\r\n\r\n{}");
    lab.send(SIGINT);
    const Outcome outcome = lab.wait();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return reply;
  }
};

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
    const std::string reply = opened(arguments);
    EXPECT_TRUE(reply.starts_with("HTTP/1.1 200 ")) << reply;
    EXPECT_NE(reply.find("\"session\""), std::string::npos) << reply;
  }
}

}  // namespace
}  // namespace microswarm::test

// SPDX-License-Identifier: Apache-2.0
// A lab in this process, and clients that talk to it. Nothing waits longer than `patience`.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstring>
#include <list>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "lab/net/server.hpp"
#include "tests/experiment/scenes.hpp"
#include "tests/files.hpp"

namespace microswarm::lab {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Tcp = asio::ip::tcp;
using Json = nlohmann::json;
using Reply = http::response<http::string_body>;
using namespace std::chrono_literals;

inline constexpr auto patience = 60s;

/// Starts an operation and waits until it is done; its error.
template <class Start>
beast::error_code finished(asio::io_context& io, Start&& start) {
  const auto done = std::make_shared<std::optional<beast::error_code>>();
  start([done](beast::error_code error, auto&&...) { *done = error; });
  io.restart();
  const auto latest = std::chrono::steady_clock::now() + patience;
  while (!*done && io.run_one_until(latest) > 0) {
  }
  return done->value_or(asio::error::timed_out);
}

/// A lab with a folder of scenarios: flight.yaml, which takes a second or two to compute.
class Lab {
 public:
  explicit Lab(ServerOptions options = {}) : Lab(std::move(options), experiment::small_flight()) {}
  Lab(ServerOptions options, const experiment::Scenario& scenario) {
    file = folder.with("flight.yaml", experiment::scenario_text(scenario)).string();
    options.folders.push_back(std::filesystem::path(file).parent_path());
    server.emplace(std::move(options));
    const std::string url = server->url();
    const std::size_t slash = url.find('/', 7);
    host = url.substr(7, slash - 7);
    token = url.substr(url.find("token=") + 6);
    port = static_cast<std::uint16_t>(std::stoi(host.substr(host.rfind(':') + 1)));
    thread_ = std::thread([this] { ended_in_time = server->run(Stop(&stop_)); });
  }
  ~Lab() { end(); }
  /// Stops it; the seconds that took.
  double end() {
    const auto began = Stop::Clock::now();
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    server.reset();
    return seconds_since(began);
  }
  Tcp::endpoint endpoint() const { return {asio::ip::make_address("127.0.0.1"), port}; }

  test::Folder folder;
  std::string file;
  std::optional<Server> server;
  std::string host;
  std::string token;
  std::uint16_t port = 0;
  std::atomic<bool> ended_in_time = false;

 private:
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// One HTTP request with the lab's token.
inline Reply ask(const Lab& lab, http::verb verb, const std::string& target,
                 const std::string& body = {}) {
  asio::io_context io;
  beast::tcp_stream stream(io);
  stream.connect(lab.endpoint());
  http::request<http::string_body> request{verb, target, 11};
  request.set(http::field::host, lab.host);
  request.set(http::field::cookie, "microswarm_" + std::to_string(lab.port) + "=" + lab.token);
  request.body() = body;
  request.prepare_payload();
  http::write(stream, request);
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.body_limit(1 << 30);
  const auto error =
      finished(io, [&](auto done) { http::async_read(stream, buffer, parser, std::move(done)); });
  EXPECT_FALSE(error) << target << ": " << error.message();
  return parser.release();
}
inline Reply get(const Lab& lab, const std::string& target) {
  return ask(lab, http::verb::get, target);
}

/// Opens a session; its number. 0 and a failure if it is refused.
inline std::uint64_t open(const Lab& lab, const Json& body) {
  const Reply reply = ask(lab, http::verb::post, "/api/sessions", body.dump());
  EXPECT_EQ(reply.result(), http::status::ok) << reply.body();
  return reply.result() == http::status::ok
             ? Json::parse(reply.body())["session"].get<std::uint64_t>()
             : 0;
}
inline std::uint64_t open(const Lab& lab) { return open(lab, {{"file", lab.file}}); }

/// A page of a session.
class TestPage {
 public:
  TestPage(const Lab& lab, std::uint64_t session, const std::string& origin = {},
           int receive_buffer = 0)
      : stream_(io_) {
    Tcp::socket& socket = beast::get_lowest_layer(stream_).socket();
    socket.open(Tcp::v4());
    if (receive_buffer > 0)
      socket.set_option(asio::socket_base::receive_buffer_size(receive_buffer));
    socket.connect(lab.endpoint());
    socket.set_option(Tcp::no_delay(true));  // as browsers
    const std::string from = origin.empty() ? "http://" + lab.host : origin;
    stream_.set_option(beast::websocket::stream_base::decorator([from](auto& request) {
      if (from != "none") request.set(http::field::origin, from);
    }));
    refused_ = finished(io_, [&](auto done) {
      stream_.async_handshake(lab.host,
                              "/api/stream/" + std::to_string(session) + "?token=" + lab.token,
                              std::move(done));
    });
    stream_.read_message_max(1 << 30);
  }

  bool is_open() const { return !refused_; }
  /// Sends bytes as a message; whether they went.
  bool say(const std::string& text) {
    return !finished(io_,
                     [&](auto done) { stream_.async_write(asio::buffer(text), std::move(done)); });
  }
  /// Sends a request; its number.
  std::uint64_t ask(Json request) {
    request["id"] = ++asked_;
    EXPECT_TRUE(say(request.dump()));
    return asked_;
  }
  /// The next message; null when the stream has ended.
  Json next() {
    beast::flat_buffer buffer;
    const auto error =
        finished(io_, [&](auto done) { stream_.async_read(buffer, std::move(done)); });
    if (error == asio::error::timed_out) give_up();
    if (error) return nullptr;
    Json message = Json::from_cbor(beast::buffers_to_string(buffer.data()));
    latest[message["type"].get<std::string>()] = message;
    return message;
  }
  /// Reads until a message of that type for which `is`; null when the stream ends before.
  template <class Is>
  Json until(const std::string& type, Is&& is) {
    for (;;) {
      Json message = next();
      if (message.is_null() || (message["type"] == type && is(message))) return message;
    }
  }
  Json until(const std::string& type) {
    return until(type, [](const Json&) { return true; });
  }
  /// Sends a request and waits for its answer: the issues.
  Json issues(const Json& request) {
    const std::uint64_t id = ask(request);
    const Json answer = until("answer", [&](const Json& one) { return one["id"] == id; });
    return answer.is_null() ? answer : answer["issues"];
  }
  void does(const Json& request) { EXPECT_EQ(issues(request), Json::array()) << request; }
  Json ends() {
    return until("standing", [](const Json& standing) { return standing["ended"] == true; });
  }
  beast::websocket::stream<beast::tcp_stream>& stream() { return stream_; }
  asio::io_context& io() { return io_; }

  std::map<std::string, Json> latest;  ///< by type

 private:
  /// Closes the stream and lets the pending read end, so that each further call fails at once.
  void give_up() {
    beast::get_lowest_layer(stream_).close();
    io_.restart();
    io_.run_for(1s);
  }

  asio::io_context io_;
  beast::websocket::stream<beast::tcp_stream> stream_;
  beast::error_code refused_;
  std::uint64_t asked_ = 0;
};

}  // namespace microswarm::lab

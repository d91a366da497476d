// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/resource.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace microswarm::bench {

/// CPU time of this process (RUSAGE_SELF) or thread (RUSAGE_THREAD) so far [s].
double cpu_time(int who);

/// Opens a session of a lab at its URL with a token; its number.
std::uint64_t open_lab_session(const std::string& url, const nlohmann::json& what);

/// A client of a session's stream. Its messages are not decoded.
class LabClient {
 public:
  LabClient(const std::string& url, std::uint64_t session);
  void ask(const nlohmann::json& request);
  /// The bytes of the next message.
  std::string next();
  /// The next message of a type.
  std::string next(std::string_view type);
  /// Whether a message's `type` is this one: CBOR writes both as texts of less than 24 bytes.
  static bool is(const std::string& message, std::string_view type);

 private:
  boost::asio::io_context io_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
};

}  // namespace microswarm::bench

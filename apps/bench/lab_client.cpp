// SPDX-License-Identifier: Apache-2.0
#include "bench/lab_client.hpp"

#include <boost/beast/http.hpp>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::bench {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

/// Parts of http://127.0.0.1:PORT/?token=TOKEN.
struct LabAddress {
  explicit LabAddress(const std::string& url)
      : host(url.substr(7, url.find('/', 7) - 7)), token(url.substr(url.find("token=") + 6)) {}
  asio::ip::tcp::endpoint endpoint() const {
    const auto port = std::stoi(host.substr(host.rfind(':') + 1));
    return {asio::ip::make_address("127.0.0.1"), static_cast<std::uint16_t>(port)};
  }

  std::string host;
  std::string token;
};

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

double cpu_time(int who) {
  rusage used{};
  ::getrusage(who, &used);
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

std::uint64_t open_lab_session(const std::string& url, const nlohmann::json& what) {
  const LabAddress at(url);
  asio::io_context io;
  beast::tcp_stream stream(io);
  stream.connect(at.endpoint());
  http::request<http::string_body> request{http::verb::post, "/api/sessions?token=" + at.token, 11};
  request.set(http::field::host, at.host);
  request.body() = what.dump();
  request.prepare_payload();
  http::write(stream, request);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(stream, buffer, response);
  if (response.result() != http::status::ok) throw InputError(response.body());
  return nlohmann::json::parse(response.body())["session"].get<std::uint64_t>();
}

LabClient::LabClient(const std::string& url, std::uint64_t session) : stream_(io_) {
  const LabAddress at(url);
  beast::get_lowest_layer(stream_).connect(at.endpoint());
  beast::get_lowest_layer(stream_).socket().set_option(
      asio::ip::tcp::no_delay(true));  // as browsers
  stream_.set_option(beast::websocket::stream_base::decorator(
      [origin = "http://" + at.host](auto& request) { request.set(http::field::origin, origin); }));
  stream_.handshake(at.host, "/api/stream/" + std::to_string(session) + "?token=" + at.token);
  stream_.read_message_max(1 << 30);
}

void LabClient::ask(const nlohmann::json& request) { stream_.write(asio::buffer(request.dump())); }

std::string LabClient::next() {
  beast::flat_buffer buffer;
  stream_.read(buffer);
  return beast::buffers_to_string(buffer.data());
}

std::string LabClient::next(std::string_view type) {
  for (;;)
    if (std::string message = next(); is(message, type)) return message;
}

bool LabClient::is(const std::string& message, std::string_view type) {
  std::string key = "dtype";
  key += static_cast<char>(0x60 + type.size());
  key += type;
  return message.find(key) != std::string::npos;
}

}  // namespace microswarm::bench

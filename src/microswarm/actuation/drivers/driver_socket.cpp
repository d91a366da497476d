// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "microswarm/actuation/drivers/line_connection.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;
using Endpoint = asio::generic::stream_protocol::endpoint;

class DriverSocket final : public LineConnection {
 public:
  explicit DriverSocket(std::string name) : name_(std::move(name)) {}

  /// Connects to the first endpoint that accepts.
  error_code connect(const std::vector<Endpoint>& endpoints, double timeout) {
    std::optional<error_code> result;
    asio::async_connect(socket_, endpoints,
                        [&](const error_code& error, const auto&) { result = error; });
    io_.run_for(std::chrono::duration_cast<std::chrono::nanoseconds>(
        std::chrono::duration<double>(timeout)));
    if (!result) return asio::error::timed_out;
    if (*result) return *result;
    const int file = socket_.native_handle();
    ::fcntl(file, F_SETFD, FD_CLOEXEC);
    error_code error;
    socket_.set_option(asio::ip::tcp::no_delay(true), error);  // a Unix socket has no such option
    socket_.native_non_blocking(true, error);
    stream_.emplace(file, file);
    return error;
  }
  const std::string& name() const override { return name_; }
  ByteStream& stream() override { return *stream_; }
  std::string ended() override {
    return stream_->ended() ? "has closed the connection" + stream_->failure() : "";
  }

 private:
  std::string name_;
  asio::io_context io_;
  asio::generic::stream_protocol::socket socket_{io_};
  std::optional<ByteStream> stream_;
};

bool is_path(const std::string& host) { return host.find('/') != std::string::npos; }

/// Addresses of the host; a path with a '/' is a Unix socket. Throws boost::system::system_error.
std::vector<Endpoint> resolve(const std::string& host, int port) {
  if (is_path(host)) return {asio::local::stream_protocol::endpoint(host)};
  asio::io_context io;
  // No name means this computer, also where /etc/hosts is missing and no lookup works.
  const auto found =
      asio::ip::tcp::resolver(io).resolve(host == "localhost" ? "" : host, std::to_string(port));
  std::vector<Endpoint> endpoints;
  for (const auto& entry : found) endpoints.emplace_back(entry.endpoint());
  return endpoints;
}

/// Takes a name of this computer until the descriptor is closed, also a copy of it in a program.
/// Nothing if it is taken; nobody can connect to it. Its number is above those of the descriptors
/// that a program inherits.
Descriptor take_name(const std::string& key) {
  constexpr int least = 10;
  Hash hash;
  hash.text(key);
  const std::string name = "microswarm driver " + hash.hex();
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  name.copy(address.sun_path + 1, sizeof address.sun_path - 1);  // the first 0: no file
  const Descriptor taken(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  if (::bind(taken.get(), reinterpret_cast<const sockaddr*>(&address), size) != 0) return {};
  return Descriptor(::fcntl(taken.get(), F_DUPFD_CLOEXEC, least));
}

}  // namespace

LineDevice to_device(const std::string& host, int port) {
  std::error_code none;
  if (is_path(host))
    return {one_line(host), std::filesystem::weakly_canonical(host, none).string()};
  const bool is_here = host == "localhost" || host == "127.0.0.1" || host == "::1";
  return {fmt::format("{}:{}", one_line(host), port),
          fmt::format("{}:{}", is_here ? "localhost" : host, port)};
}

std::unique_ptr<LineConnection> connect_socket(const std::string& host, int port, double timeout) {
  const std::string name = to_device(host, port).name;
  try {
    auto connection = std::make_unique<DriverSocket>(name);
    if (const error_code error = connection->connect(resolve(host, port), timeout))
      throw boost::system::system_error(error);
    return connection;
  } catch (const boost::system::system_error& error) {
    throw HardwareError(fmt::format("{}: cannot connect: {}", name, error.code().message()));
  }
}

DeviceLock::DeviceLock(const std::filesystem::path& coils, const LineDevice& device)
    : file_(open_descriptor(coils, O_RDONLY)) {
  if (file_ && ::flock(file_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw HardwareError(one_line(coils.string()) + ": another program drives these coils");
  device_ = take_name(device.key);
  if (!device_ && errno == EADDRINUSE)
    throw HardwareError(device.name + ": another program drives coils by it");
}

std::vector<int> DeviceLock::descriptors() const {
  std::vector<int> open;
  for (const Descriptor* const one : {&file_, &device_})
    if (*one) open.push_back(one->get());
  return open;
}

}  // namespace microswarm::actuation

// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>

#include "microswarm/actuation/drivers/line_connection.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

/// A non-blocking socket.
class Socket {
 public:
  explicit Socket(int family)
      : file_(::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {}
  int get() const { return file_.get(); }

  /// Connects; returns errno, 0 on success.
  int connect(const sockaddr* address, socklen_t size, double timeout) const {
    if (!file_) return errno;
    if (::connect(get(), address, size) == 0) return 0;
    if (errno != EINPROGRESS) return errno;
    pollfd line{get(), POLLOUT, 0};
    if (::poll(&line, 1, static_cast<int>(std::ceil(1e3 * timeout))) <= 0) return ETIMEDOUT;
    int error = 0;
    socklen_t length = sizeof error;
    ::getsockopt(get(), SOL_SOCKET, SO_ERROR, &error, &length);
    return error;
  }

 private:
  Descriptor file_;
};

class DriverSocket final : public LineConnection {
 public:
  DriverSocket(std::string name, Socket socket)
      : name_(std::move(name)), socket_(std::move(socket)), stream_(socket_.get(), socket_.get()) {}
  const std::string& name() const override { return name_; }
  ByteStream& stream() override { return stream_; }
  std::string ended() override { return stream_.ended() ? "has closed the connection" : ""; }

 private:
  std::string name_;
  Socket socket_;
  ByteStream stream_;
};

[[noreturn]] void fail(const std::string& name, const char* why) {
  throw HardwareError(fmt::format("{}: cannot connect: {}", name, why));
}

std::unique_ptr<LineConnection> connect_path(const std::string& path, double timeout) {
  const std::string name = one_line(path);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) fail(name, "the path is too long");
  std::ranges::copy(path, address.sun_path);
  Socket socket(AF_UNIX);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  const auto* const at = reinterpret_cast<const sockaddr*>(&address);
  if (const int error = socket.connect(at, sizeof address, timeout))
    fail(name, std::strerror(error));
  return std::make_unique<DriverSocket>(name, std::move(socket));
}

}  // namespace

std::unique_ptr<LineConnection> connect_socket(const std::string& host, int port, double timeout) {
  if (host.find('/') != std::string::npos) return connect_path(host, timeout);
  const std::string name = fmt::format("{}:{}", one_line(host), port);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  // A null node means this computer, also where /etc/hosts is missing and no lookup works.
  const char* const node = host == "localhost" ? nullptr : host.c_str();
  if (const int error = ::getaddrinfo(node, std::to_string(port).c_str(), &hints, &found))
    fail(name, ::gai_strerror(error));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, ::freeaddrinfo);
  const Stop::Clock::time_point began = Stop::Clock::now();
  int error = ETIMEDOUT;
  for (const addrinfo* at = found; at != nullptr; at = at->ai_next) {
    const double left = timeout - seconds_since(began);
    if (left <= 0) break;
    Socket socket(at->ai_family);
    error = socket.connect(at->ai_addr, at->ai_addrlen, left);
    if (error != 0) continue;
    const int at_once = 1;
    ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
    return std::make_unique<DriverSocket>(name, std::move(socket));
  }
  fail(name, std::strerror(error));
}

DeviceLock::DeviceLock(const std::filesystem::path& file) : file_(open_descriptor(file, O_RDONLY)) {
  if (file_ && ::flock(file_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw HardwareError(one_line(file.string()) + ": another program drives these coils");
}

}  // namespace microswarm

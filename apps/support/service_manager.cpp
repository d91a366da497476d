// SPDX-License-Identifier: Apache-2.0
#include "support/service_manager.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::cli {
namespace {

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

/// A socket whose datagrams go to a path, or to an abstract address after '@'; nothing otherwise.
Descriptor datagrams_to(std::string_view address) {
  sockaddr_un to{};
  to.sun_family = AF_UNIX;
  const bool is_address = address.starts_with('/') || address.starts_with('@');
  if (!is_address || address.size() >= sizeof to.sun_path) return {};
  std::memcpy(to.sun_path, address.data(), address.size());
  if (address.starts_with('@')) to.sun_path[0] = '\0';
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address.size());
  Descriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket || ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&to), size) != 0)
    return {};
  return socket;
}

}  // namespace

ServiceManager::ServiceManager() : socket_(datagrams_to(variable("NOTIFY_SOCKET"))) {
  const std::string pid = variable("WATCHDOG_PID");
  const double timeout = parse_number(variable("WATCHDOG_USEC")).value_or(0);
  if (pid.empty() || pid == std::to_string(::getpid())) period_ = 1e-6 * timeout / 2;
}

void ServiceManager::ready() {
  const std::lock_guard lock(mutex_);
  if (!is_ready_) send("READY=1");
  is_ready_ = true;
}

void ServiceManager::status(std::string_view what) {
  const std::lock_guard lock(mutex_);
  send("STATUS=" + one_line(what));
}

void ServiceManager::stopping(std::string_view why) {
  const std::lock_guard lock(mutex_);
  send("STOPPING=1\nSTATUS=" + one_line(why));
}

void ServiceManager::live() {
  const std::lock_guard lock(mutex_);
  if (!drives_) give_sign();
}

void ServiceManager::drive() {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(drives_, true)) send("STATUS=the coils are driven");
  give_sign();
}

void ServiceManager::rest(std::string_view why) {
  const std::lock_guard lock(mutex_);
  drives_ = false;
  send("STATUS=the coils are not driven" + (why.empty() ? "" : ": " + one_line(why)));
}

/// Sends a sign of life if one is due.
void ServiceManager::give_sign() {
  const double now = steady_seconds();
  if (!is_ready_ || period_ <= 0 || now < last_ + period_) return;
  last_ = now;
  send("WATCHDOG=1");
}

void ServiceManager::send(const std::string& message) {
  if (socket_) ::send(socket_.get(), message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

}  // namespace microswarm::cli

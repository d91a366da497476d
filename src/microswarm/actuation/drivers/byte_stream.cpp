// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/byte_stream.hpp"

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <system_error>

namespace microswarm::actuation {
namespace {

bool ready(int descriptor, short what, double timeout) {
  pollfd line{descriptor, what, 0};
  const int ms = static_cast<int>(std::ceil(1e3 * std::max(timeout, 0.0)));
  return ::poll(&line, 1, ms) > 0;
}

/// Like ::write, but a closed reader is an error instead of SIGPIPE.
ssize_t write_without_signal(int descriptor, std::span<const std::uint8_t> bytes) {
  sigset_t broken, before, pending;
  sigemptyset(&broken);
  sigaddset(&broken, SIGPIPE);
  sigpending(&pending);
  const bool was_pending = sigismember(&pending, SIGPIPE) == 1;
  pthread_sigmask(SIG_BLOCK, &broken, &before);
  const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
  const int error = errno;
  if (written < 0 && error == EPIPE && !was_pending) {
    const timespec at_once{};
    while (sigtimedwait(&broken, nullptr, &at_once) < 0 && errno == EINTR) {
    }
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return written;
}

}  // namespace

bool ByteStream::put(std::span<const std::uint8_t> bytes, double timeout, const Stop& gives_up) {
  const auto began = Stop::Clock::now();
  while (!bytes.empty()) {
    const double left = timeout - seconds_since(began);
    if (left <= 0 || gives_up()) return false;
    if (!ready(out_, POLLOUT, std::min(left, stream_slice))) continue;
    const ssize_t n = write_without_signal(out_, bytes);
    if (n < 0) end(n);
    if (ended_) return false;
    if (n > 0) bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

std::optional<std::uint8_t> ByteStream::get(double timeout) {
  if (next_ == filled_) {
    if (!ready(in_, POLLIN, timeout)) return std::nullopt;
    const ssize_t n = ::read(in_, bytes_.data(), bytes_.size());
    if (n <= 0) end(n);
    if (n <= 0) return std::nullopt;
    next_ = 0;
    filled_ = static_cast<std::size_t>(n);
  }
  return bytes_[next_++];
}

/// After a read or write that gave `n`: the stream ends unless it is only to be tried again.
void ByteStream::end(ssize_t n) {
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (error_ == 0 && n < 0) error_ = errno;
  ended_ = true;
}

std::string ByteStream::failure() const {
  return error_ == 0 ? std::string() : ": " + std::generic_category().message(error_);
}

void ByteStream::discard(double timeout) {
  const auto began = Stop::Clock::now();
  for (double left = timeout; left > 0; left = timeout - seconds_since(began)) get(left);
  next_ = filled_;
}

}  // namespace microswarm::actuation

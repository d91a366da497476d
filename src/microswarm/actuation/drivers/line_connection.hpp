// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "microswarm/actuation/drivers/byte_stream.hpp"
#include "microswarm/core/execution/descriptor.hpp"

namespace microswarm::actuation {

/// Connection to a user-supplied driver: a child process or a socket. The destructor closes it.
class LineConnection {
 public:
  LineConnection() = default;
  LineConnection(const LineConnection&) = delete;
  LineConnection& operator=(const LineConnection&) = delete;
  virtual ~LineConnection() = default;

  /// Name for messages.
  virtual const std::string& name() const = 0;
  virtual ByteStream& stream() = 0;
  /// Why the connection ended, in one line; empty while it is open. To be polled.
  virtual std::string ended() = 0;
  /// Last line that the other side wrote outside the protocol, printable; empty without one.
  virtual std::string last_words() { return {}; }
  /// From now on the destructor gives a program 0.1 s to end after SIGTERM, then kills it.
  virtual void give_up() noexcept {}
};

/// Opens a connection within `timeout` seconds; throws HardwareError.
using OpenConnection = std::function<std::unique_ptr<LineConnection>(double timeout)>;

/// Starts a program without a shell, in `folder`, with its stdin and stdout as the stream. Only the
/// last line of its stderr is kept. It has its own process group, so that Ctrl-C reaches the host
/// first. It inherits the open files `locks` as file descriptors 3, 4, … The destructor
/// closes its stdin; processes of its group that remain after 0.5 s get SIGTERM, after 0.5 s more
/// SIGKILL. Throws HardwareError if it cannot be started.
std::unique_ptr<LineConnection> start_program(const std::vector<std::string>& command,
                                              const std::filesystem::path& folder,
                                              const std::vector<int>& locks = {});

/// Connects to a TCP port, or to a Unix socket if `host` is a path with a '/'. Throws HardwareError
/// if no connection is made within `timeout` seconds.
std::unique_ptr<LineConnection> connect_socket(const std::string& host, int port, double timeout);

/// Program or server that drives coils, for its lock.
struct LineDevice {
  std::string name{};  ///< for messages
  std::string key{};   ///< the same for all names of this device
};
/// A program by its command; words that name files in `folder` may name them in any way.
LineDevice to_device(const std::vector<std::string>& command, const std::filesystem::path& folder);
/// A server at a TCP port, or at a Unix socket if `host` is a path with a '/'.
LineDevice to_device(const std::string& host, int port);

/// Lock of the file of a coil system, and of its driver for all users of this computer: a copy
/// of the file is no second amplifier. Held until this object and all programs that inherit its
/// descriptors have ended. Throws HardwareError if another program holds either.
class DeviceLock {
 public:
  DeviceLock(const std::filesystem::path& coils, const LineDevice& device);
  /// Those that are open, to be inherited.
  std::vector<int> descriptors() const;

 private:
  Descriptor file_, device_;
};

}  // namespace microswarm::actuation

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "microswarm/actuation/drivers/byte_stream.hpp"
#include "microswarm/core/execution/descriptor.hpp"

namespace microswarm {

/// What leads to a driver of one's own: a program that was started, or a socket. The destructor
/// closes it.
class LineConnection {
 public:
  LineConnection() = default;
  LineConnection(const LineConnection&) = delete;
  LineConnection& operator=(const LineConnection&) = delete;
  virtual ~LineConnection() = default;

  /// For messages.
  virtual const std::string& name() const = 0;
  virtual ByteStream& stream() = 0;
  /// What has ended it, in one line; empty as long as the other side is there. To be called from
  /// time to time.
  virtual std::string ended() = 0;
  /// The last line that the other side wrote beside the protocol, printable; empty if there is
  /// none.
  virtual std::string last_words() { return {}; }
};

/// Opens a connection within so many seconds; throws HardwareError.
using OpenConnection = std::function<std::unique_ptr<LineConnection>(double timeout)>;

/// Starts a program without a shell, in `folder`, with its stdin and stdout as the stream. Its
/// stderr is read, but for the last line not kept. It has a process group of its own, so that no
/// key of a terminal ends it before its host does. It inherits the open file `lock` as its file 3,
/// if that is not negative. On destruction its stdin is closed; what is left of its group after
/// 0.5 s gets SIGTERM, after 0.5 s more SIGKILL. Throws HardwareError if it cannot be started.
std::unique_ptr<LineConnection> start_program(const std::vector<std::string>& command,
                                              const std::filesystem::path& folder, int lock = -1);

/// Connects to a TCP port, or to a Unix socket if `host` is a path with a '/'. Throws HardwareError
/// if there is none within `timeout` seconds.
std::unique_ptr<LineConnection> connect_socket(const std::string& host, int port, double timeout);

/// Locks a file for as long as it or a program that inherits its descriptor lives. Throws
/// HardwareError if it is locked.
class DeviceLock {
 public:
  explicit DeviceLock(const std::filesystem::path& file);
  int descriptor() const { return file_.get(); }

 private:
  Descriptor file_;
};

}  // namespace microswarm

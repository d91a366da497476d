// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lab/sessions/host.hpp"
#include "lab/sessions/limits.hpp"
#include "microswarm/core/execution/stop.hpp"

namespace microswarm::lab {

/// Options of a Server.
struct ServerOptions {
  std::vector<std::filesystem::path> folders;  ///< folders whose files may be listed and opened
  std::optional<Opening> opening{};            ///< experiment shown first
  std::filesystem::path queue{};               ///< folder of a rig's queue that is shown
  std::string listen{};                        ///< address; empty for this computer alone
  std::uint16_t port = 0;                      ///< 0 for any free port
  Limits limits{};
  int priority = 0;  ///< real-time one of the thread of input and output, which hears a stop
  std::function<void()> lives = [] {};  ///< called by the loop of input and output, every 50 ms
};

/// Serves the lab's page and its sessions by HTTP and WebSocket; docs/reference/lab-protocol.md
/// describes both. Input and output use one thread, each session another one.
class Server {
 public:
  /// Starts listening. Throws InputError if the address or the port is not available.
  explicit Server(ServerOptions options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Address of the page with its token.
  std::string url() const;
  /// Serves until the stop is requested. Returns whether all sessions and other work ended at once;
  /// the destructor waits for one that still reads a large file.
  bool run(const Stop& stop);
  /// Sets the coils of every rig to zero; callable from any thread while it runs.
  void stop_rigs(const std::string& why);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace microswarm::lab

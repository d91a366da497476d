// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <optional>

#include "lab/access.hpp"
#include "lab/hub.hpp"
#include "lab/library.hpp"
#include "lab/thumbnail.hpp"
#include "lab/uploads.hpp"

namespace microswarm::lab {

/// Data shared by connections; it outlives them.
struct Shared {
  const Access& access;
  Hub& hub;
  const Library& library;
  Thumbnails& thumbnails;  ///< used by the worker
  Uploads& uploads;        ///< used by the worker
  const std::optional<Opening>& opening;
  std::size_t& connections;  ///< number of open connections, without streams
  /// Runs long work in another thread, which returns its result by post().
  std::function<void(std::function<void()>)> work;
  std::function<void(std::function<void()>)> post;
  /// Runs exports one by one in a separate thread, which is stopped at the end.
  std::function<void(std::function<void(const Stop&)>)> export_;
};

/// Serves one connection until it ends: HTTP requests, or a page's WebSocket.
void serve_connection(boost::asio::ip::tcp::socket socket, const Shared& shared);

}  // namespace microswarm::lab

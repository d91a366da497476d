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

/// What connections share; it outlives them.
struct Shared {
  const Access& access;
  Hub& hub;
  const Library& library;
  Thumbnails& thumbnails;  ///< of the worker
  Uploads& uploads;        ///< of the worker
  const std::optional<Opening>& opening;
  std::size_t& connections;  ///< that are open, beside streams
  /// Runs work that may take a while in another thread; post() brings what it made back.
  std::function<void(std::function<void()>)> work;
  std::function<void(std::function<void()>)> post;
  /// Runs an export, one after the other in a thread of their own, which is told to stop at the
  /// end.
  std::function<void(std::function<void(const Stop&)>)> export_;
};

/// Serves one connection until it ends: HTTP requests, or a page's WebSocket.
void serve_connection(boost::asio::ip::tcp::socket socket, const Shared& shared);

}  // namespace microswarm::lab

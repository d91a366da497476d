// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <optional>

#include "lab/access.hpp"
#include "lab/hub.hpp"
#include "lab/library.hpp"

namespace microswarm::lab {

/// What connections share; it outlives them.
struct Shared {
  const Access& access;
  Hub& hub;
  const Library& library;
  const std::optional<Opening>& opening;
};

/// Serves one connection until it ends: HTTP requests, or a page's WebSocket.
void serve_connection(boost::asio::ip::tcp::socket socket, const Shared& shared);

}  // namespace microswarm::lab

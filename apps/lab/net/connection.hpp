// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/ip/tcp.hpp>

#include "lab/net/exchange.hpp"

namespace microswarm::lab {

/// Serves one connection until it ends: HTTP requests, or a page's WebSocket.
void serve_connection(boost::asio::ip::tcp::socket socket, const Shared& shared);

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <cstdint>

#include "lab/net/http.hpp"
#include "lab/sessions/hub.hpp"

namespace microswarm::lab {

/// Accepts a page's request to upgrade and connects it to the session's stream. The hub keeps the
/// stream until it ends.
void serve_stream(boost::asio::ip::tcp::socket socket, const HttpRequest& request, Hub& hub,
                  std::uint64_t session);

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/ip/address.hpp>
#include <boost/beast/http.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace microswarm::lab {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// Converts Boost's string view.
inline std::string_view view(boost::beast::string_view text) { return {text.data(), text.size()}; }

/// Path of a target such as "/api/thumbnail?file=a.yaml".
std::string_view target_path(std::string_view target);
/// Decoded value of a key in a target's query; empty without it.
std::string query_value(std::string_view target, std::string_view key);
/// Decodes "%20" and "+". Invalid sequences are kept.
std::string percent_decoded(std::string_view text);

/// Whether an Accept-Encoding header takes a coding, which is in lower case.
bool accepts(std::string_view header, std::string_view coding);

/// An address as the host of a URL: "192.168.1.4", "[::1]".
std::string url_host(const boost::asio::ip::address& address);

/// Sets the headers of every response: nothing from other sites may be loaded, nothing is cached.
void set_headers(boost::beast::http::fields& headers, std::string_view media_type);

/// Response with a body, or with JSON.
HttpResponse respond(const HttpRequest& request, boost::beast::http::status status,
                     std::string_view media_type, std::string body);
HttpResponse respond(const HttpRequest& request, const nlohmann::json& json,
                     boost::beast::http::status status = boost::beast::http::status::ok);
/// Response {"error": why}.
HttpResponse refuse(const HttpRequest& request, boost::beast::http::status status,
                    const std::string& why);

}  // namespace microswarm::lab

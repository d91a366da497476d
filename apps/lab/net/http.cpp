// SPDX-License-Identifier: Apache-2.0
#include "lab/net/http.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace microswarm::lab {
namespace http = boost::beast::http;

std::string_view target_path(std::string_view target) { return target.substr(0, target.find('?')); }

std::string query_value(std::string_view target, std::string_view key) {
  std::size_t at = target.find('?');
  while (at != std::string_view::npos) {
    target.remove_prefix(at + 1);
    at = target.find('&');
    const std::string_view pair = target.substr(0, at);
    if (pair.size() > key.size() && pair.starts_with(key) && pair[key.size()] == '=')
      return percent_decoded(pair.substr(key.size() + 1));
  }
  return {};
}

std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    const char* begin = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(begin, begin + 2, value, 16).ptr == begin + 2) {
      decoded += static_cast<char>(value);
      i += 2;
    } else {
      decoded += text[i] == '+' ? ' ' : text[i];
    }
  }
  return decoded;
}

bool accepts(std::string_view header, std::string_view coding) {
  bool by_star = false;
  for (std::size_t end = 0; !header.empty();
       header.remove_prefix(std::min(end + 1, header.size()))) {
    end = std::min(header.find(','), header.size());
    std::string one;  // in lower case, without spaces
    for (const char c : header.substr(0, end))
      if (c != ' ' && c != '\t')
        one += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const std::string_view name = std::string_view(one).substr(0, one.find(';'));
    const std::size_t weight = one.find(";q=");
    const bool takes =
        weight == std::string::npos || one.find_first_of("123456789", weight) != std::string::npos;
    if (name == coding) return takes;
    if (name == "*") by_star = takes;
  }
  return by_star;
}

std::string url_host(const boost::asio::ip::address& address) {
  return address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
}

void set_headers(http::fields& headers, std::string_view media_type) {
  headers.set(http::field::content_type,
              boost::beast::string_view(media_type.data(), media_type.size()));
  headers.set(http::field::cache_control, "no-store");
  headers.set(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
      "connect-src 'self'; worker-src 'self' blob:; base-uri 'none'; form-action 'none'; "
      "frame-ancestors 'none'");
  headers.set("X-Content-Type-Options", "nosniff");
  headers.set("Referrer-Policy", "no-referrer");
  headers.set("Cross-Origin-Opener-Policy", "same-origin");
  headers.set("Cross-Origin-Resource-Policy", "same-origin");
}

HttpResponse respond(const HttpRequest& request, http::status status, std::string_view media_type,
                     std::string body) {
  HttpResponse response{status, request.version()};
  set_headers(response, media_type);
  response.keep_alive(request.keep_alive());
  response.body() = std::move(body);
  response.prepare_payload();
  return response;
}

HttpResponse respond(const HttpRequest& request, const nlohmann::json& json, http::status status) {
  return respond(request, status, "application/json",
                 json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

HttpResponse refuse(const HttpRequest& request, http::status status, const std::string& why) {
  return respond(request, {{"error", why}}, status);
}

}  // namespace microswarm::lab

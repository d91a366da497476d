// SPDX-License-Identifier: Apache-2.0
#include "lab/net/access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <random>

namespace microswarm::lab {
namespace {

/// Compares two secrets in constant time.
bool is_same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned char>(a[i] ^ b[i]);
  return difference == 0;
}

/// The value of a cookie in a Cookie header, or nothing.
std::string_view cookie_value(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const std::string_view one = header.substr(0, header.find(';'));
    header.remove_prefix(std::min(header.size(), one.size() + 1));
    const std::size_t begin = std::min(one.find_first_not_of(' '), one.size());
    const std::string_view pair = one.substr(begin);
    if (pair.size() > name.size() && pair.starts_with(name) && pair[name.size()] == '=')
      return pair.substr(name.size() + 1);
  }
  return {};
}

/// The host of "HOST:PORT" or "HOST"; empty if it is neither.
std::string_view host_name(std::string_view host) {
  const std::size_t end = host.starts_with('[') ? host.find(']') + 1 : host.find(':');
  const std::string_view name = host.substr(0, end);
  std::string_view port = host.substr(name.size());
  if (port.empty()) return name;
  port.remove_prefix(1);
  const bool is_port = host[name.size()] == ':' && !port.empty() && port.size() <= 5 &&
                       port.find_first_not_of("0123456789") == std::string_view::npos;
  return is_port ? name : std::string_view();
}

}  // namespace

Access::Access(std::string token, std::uint16_t port)
    : token_(std::move(token)), cookie_name_(fmt::format("microswarm_{}", port)) {}

std::string Access::cookie() const {
  return fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/", cookie_name_, token_);
}

std::string Access::refusal(const Origins& from) const {
  std::string name(host_name(from.host));
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const bool is_here = !name.empty() && (name == "localhost" || name == "127.0.0.1" ||
                                         name == "[::1]" || name == from.local);
  if (!is_here) return "the host is not this lab's: open it by its address";
  if (!from.origin.empty() && from.origin != "http://" + std::string(from.host))
    return "the origin is not this lab's";
  if (is_same_secret(cookie_value(from.cookie, cookie_name_), token_)) return {};
  if (is_same_secret(from.token, token_)) return {};
  return "the token is missing or wrong: open the address that the program printed";
}

std::string new_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

std::uint64_t new_lab_number(std::uint64_t most) {
  std::random_device random;
  return 1 + random() % most;
}

}  // namespace microswarm::lab

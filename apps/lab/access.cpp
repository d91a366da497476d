// SPDX-License-Identifier: Apache-2.0
#include "lab/access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace microswarm::lab {
namespace {

/// Takes as long for a wrong text as for the right one.
bool is_same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i] ^ b[i]);
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

}  // namespace

Access::Access(std::string token, std::vector<std::string> hosts, std::uint16_t port)
    : token_(std::move(token)),
      hosts_(std::move(hosts)),
      cookie_name_(fmt::format("microswarm_{}", port)) {}

std::string Access::cookie() const {
  return fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/", cookie_name_, token_);
}

std::string Access::refusal(const Origins& from) const {
  const auto is_host = [&](std::string_view host) {
    return std::ranges::find(hosts_, host) != hosts_.end();
  };
  if (!is_host(from.host)) return "the host is not this lab's";
  constexpr std::string_view scheme = "http://";
  if (!from.origin.empty() &&
      !(from.origin.starts_with(scheme) && is_host(from.origin.substr(scheme.size()))))
    return "the origin is not this lab's";
  if (is_same_secret(cookie_value(from.cookie, cookie_name_), token_)) return {};
  if (is_same_secret(from.token, token_)) return {};
  return "the token is missing or wrong: open the address that the program printed";
}

std::string new_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace microswarm::lab {

/// Headers of a request about its origin; a missing header is empty.
struct Origins {
  std::string_view host;
  std::string_view origin;
  std::string_view cookie;
  std::string_view token;  ///< token in the query
  std::string_view local;  ///< address of arrival, as in a URL: "192.168.1.4", "[::1]"
};

/// Access control of a lab: only its own pages in browsers that have its token. Host must be an
/// address of this computer, never a name bound to it, and Origin must be the same host, so that no
/// page of another site can use the lab.
class Access {
 public:
  /// `port`: port of the lab; another one may be forwarded to it.
  Access(std::string token, std::uint16_t port);

  const std::string& token() const { return token_; }
  /// Cookie with the token, set by the first page.
  std::string cookie() const;
  /// Why a request is refused; empty if it is allowed.
  std::string refusal(const Origins& from) const;

 private:
  std::string token_;
  std::string cookie_name_;
};

/// 128 random bits from the system, as hexadecimal digits.
std::string new_token();
/// A random number from 1 to `most` that distinguishes labs of one port.
std::uint64_t new_lab_number(std::uint64_t most);

}  // namespace microswarm::lab

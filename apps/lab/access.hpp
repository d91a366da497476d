// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace microswarm::lab {

/// What a request says about its origin. Empty where the header is missing.
struct Origins {
  std::string_view host;
  std::string_view origin;
  std::string_view cookie;
  std::string_view token;  ///< of the query
  std::string_view local;  ///< address at which it arrived, as in a URL: "192.168.1.4", "[::1]"
};

/// Who may talk to a lab: pages of this lab, in browsers that were given its token. Host must be
/// an address of this computer, never a name that was bound to it, and Origin must be the same
/// host, so that no page of another site reaches the lab.
class Access {
 public:
  /// `port` is that of the lab; another one may be forwarded to it.
  Access(std::string token, std::uint16_t port);

  const std::string& token() const { return token_; }
  /// Cookie that carries the token from the first page on.
  std::string cookie() const;
  /// Why a request is refused; empty if it is allowed.
  std::string refusal(const Origins& from) const;

 private:
  std::string token_;
  std::string cookie_name_;
};

/// 128 random bits as hexadecimal digits, from the system.
std::string new_token();

}  // namespace microswarm::lab

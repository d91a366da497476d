// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace microswarm::lab {

/// What a request says about its origin. Empty where the header is missing.
struct Origins {
  std::string_view host;
  std::string_view origin;
  std::string_view cookie;
  std::string_view token;  ///< of the query
};

/// Who may talk to a lab: pages of this lab, in browsers that were given its token. Host and
/// Origin are compared, so that neither another site's page nor a name that was bound to this
/// address reaches it.
class Access {
 public:
  /// `hosts` are the allowed values of Host, such as "127.0.0.1:8080".
  Access(std::string token, std::vector<std::string> hosts, std::uint16_t port);

  const std::string& token() const { return token_; }
  /// Cookie that carries the token from the first page on.
  std::string cookie() const;
  /// Why a request is refused; empty if it is allowed.
  std::string refusal(const Origins& from) const;

 private:
  std::string token_;
  std::vector<std::string> hosts_;
  std::string cookie_name_;
};

/// 128 random bits as hexadecimal digits, from the system.
std::string new_token();

}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
#include "lab/net/access.hpp"
#include "lab/net/http.hpp"

#include <gtest/gtest.h>

#include <set>

namespace microswarm::lab {
namespace {

const Access access("0123456789abcdef", 8080);
constexpr std::string_view cookie = "microswarm_8080=0123456789abcdef";

bool may(const Origins& from) { return access.refusal(from).empty(); }

TEST(Access, TokenOrCookieOpensIt) {
  const std::string_view host = "127.0.0.1:8080";
  EXPECT_TRUE(may({.host = host, .token = "0123456789abcdef"}));
  EXPECT_TRUE(may({.host = host, .cookie = cookie}));
  EXPECT_TRUE(may({.host = host, .cookie = "a=b; microswarm_8080=0123456789abcdef; c=d"}));
  EXPECT_FALSE(may({.host = host}));
  EXPECT_FALSE(may({.host = host, .token = "0123456789abcde"}));
  EXPECT_FALSE(may({.host = host, .token = "0123456789abcdeF"}));
  EXPECT_FALSE(may({.host = host, .cookie = "microswarm_8081=0123456789abcdef"}));
  EXPECT_FALSE(may({.host = host, .cookie = "xmicroswarm_8080=0123456789abcdef"}));
  EXPECT_FALSE(may({.host = host, .cookie = "microswarm_8080="}));
  EXPECT_FALSE(may({.host = host, .cookie = ";;=;microswarm_8080"}));
}

TEST(Access, TheCookieIsForThisLabAlone) {
  EXPECT_TRUE(access.cookie().starts_with(cookie));
  for (const char* attribute : {"HttpOnly", "SameSite=Strict", "Path=/"})
    EXPECT_NE(access.cookie().find(attribute), std::string::npos);
}

TEST(Access, HostMustBeAnAddressOfThisComputer) {
  const auto at = [](std::string_view host, std::string_view local) {
    return may({.host = host, .cookie = cookie, .local = local});
  };
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080", "localhost",
                           "localhost:9000", "LocalHost:8080"})
    EXPECT_TRUE(at(host, "127.0.0.1")) << host;
  EXPECT_TRUE(at("192.168.1.4:8080", "192.168.1.4"));
  EXPECT_TRUE(at("[fd00::4]:8080", "[fd00::4]"));
  EXPECT_FALSE(at("192.168.1.5:8080", "192.168.1.4"));
  // A name that was bound to this address, and what is no host.
  for (const char* host :
       {"evil.example:8080", "evil.example", "localhost.evil.example:8080", "localhost@evil:8080",
        "127.0.0.1.evil.example", "localhost:", "localhost:80a", "localhost:123456", "[::1",
        "[::1]x", "[::1]8080", "::1", "", ":8080", "[]:8080", "127.0.0.1:8080:8080"})
    EXPECT_FALSE(at(host, "127.0.0.1")) << host;
  EXPECT_FALSE(at("", ""));
}

TEST(Access, OriginMustBeTheHost) {
  const auto from = [](std::string_view host, std::string_view origin) {
    return may({.host = host, .origin = origin, .cookie = cookie});
  };
  EXPECT_TRUE(from("localhost:8080", "http://localhost:8080"));
  EXPECT_TRUE(from("[::1]:8080", "http://[::1]:8080"));
  for (const char* origin :
       {"http://evil.example", "http://localhost:3000", "http://127.0.0.1:8080",
        "https://localhost:8080", "null", "http://localhost:8080.evil.example", "localhost:8080"})
    EXPECT_FALSE(from("localhost:8080", origin)) << origin;
}

TEST(Access, EveryTokenIsAnother) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(new_token());
  EXPECT_EQ(tokens.size(), 100u);
  for (const std::string& token : tokens) EXPECT_EQ(token.size(), 32u);
}

TEST(Http, ACodingIsTakenUnlessItsWeightIsZero) {
  for (const char* header : {"gzip", "br, gzip", "GZIP;q=0.5", "identity;q=0, gzip ; q=0.001", "*",
                             "br;q=0, *;q=0.1", "*;q=0, gzip"})
    EXPECT_TRUE(accepts(header, "gzip")) << header;
  for (const char* header : {"", "br", "gzip;q=0", "br, gzip; q=0.000", "gzip;q=0, *", "*;q=0",
                             "x-gzip", "gzipped", ",,;q"})
    EXPECT_FALSE(accepts(header, "gzip")) << header;
}

}  // namespace
}  // namespace microswarm::lab

// SPDX-License-Identifier: Apache-2.0
// The bytes are what a browser sends: a message, what it opens, a query. They are read within their
// limits, or refused with an InputError of one line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "lab/net/access.hpp"
#include "lab/net/http.hpp"
#include "lab/stream/request.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm::lab {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

template <class F>
void read_or_refuse(F&& read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string what = error.what();
    require(!what.empty() && what.size() < 400 && what.find('\n') == std::string::npos);
  }
}

void run(std::string_view bytes) {
  read_or_refuse([&] {
    const Request request = read_request(bytes);
    require(std::isfinite(request.number) && std::isfinite(request.heading) &&
            std::isfinite(request.speed) && request.settings.size() <= max_settings);
  });
  read_or_refuse([&] { require(read_open_request(bytes).settings.size() <= max_settings); });
  read_or_refuse([&] {
    const PhotoRequest request = read_photo_request(bytes);
    require(std::isfinite(request.um_per_px) && request.robots <= 10'000);
  });
  require(percent_decoded(bytes).size() <= bytes.size());
  require(query_value(bytes, "file").size() <= bytes.size());
  // Without the token nobody is let in, whatever the headers say.
  const Access access("0123456789abcdef0123456789abcdef", 8080);
  const std::string_view rest = bytes.substr(bytes.size() / 2);
  require(
      bytes.find(access.token()) != std::string_view::npos ||
      !access.refusal({.host = "localhost", .origin = {}, .cookie = bytes, .token = rest}).empty());
  if (access.refusal({.host = bytes, .token = access.token()}).empty())
    require(bytes.starts_with("localhost") || bytes.starts_with("127.0.0.1") ||
            bytes.starts_with("[::1]"));
}

}  // namespace
}  // namespace microswarm::lab

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  microswarm::lab::run({reinterpret_cast<const char*>(data), size});
  return 0;
}

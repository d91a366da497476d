// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace microswarm::lab {

/// A file of the browser client, embedded in the program.
struct Asset {
  std::string_view bytes;
  std::string_view media_type;
  std::string_view gzip{};  ///< the bytes compressed; empty if they are not kept so
};

/// The asset at this path, such as "/app.js"; nothing if there is none.
std::optional<Asset> asset(std::string_view path);

}  // namespace microswarm::lab

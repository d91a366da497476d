// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace microswarm {

/// A character of UTF-8 text: its code point, nothing where the bytes are not UTF-8, and its length
/// in bytes, then 1.
struct Utf8Character {
  std::optional<std::uint32_t> code{};
  std::size_t bytes = 1;
};

/// First character of a text that is not empty. Independent of the locale.
Utf8Character first_character(std::string_view text);

}  // namespace microswarm

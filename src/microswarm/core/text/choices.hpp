// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace microswarm {

/// Answer to a value that is none of the words: "allowed: disc, fan", and before it the nearest
/// one, "did you mean 'disc'? Allowed: disc, fan". Near is also the beginning of a word up to a
/// '_': 'drtt' is near to 'drrt_star'.
std::string allowed_words(std::string_view word, std::span<const std::string_view> words);

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/text/choices.hpp"

#include <fmt/ranges.h>

#include "microswarm/core/text/text.hpp"

namespace microswarm {

std::string allowed_words(std::string_view word, std::span<const std::string_view> words) {
  std::string_view near = nearest_word(word, words);
  for (std::size_t i = 0; near.empty() && i < words.size(); ++i)
    for (std::size_t at = words[i].find('_'); near.empty() && at != std::string_view::npos;
         at = words[i].find('_', at + 1)) {
      const std::string_view beginning = words[i].substr(0, at);
      if (!nearest_word(word, {&beginning, 1}).empty()) near = words[i];
    }
  const std::string list = fmt::format("{}", fmt::join(words, ", "));
  return near.empty() ? "allowed: " + list
                      : fmt::format("did you mean '{}'? Allowed: {}", near, list);
}

}  // namespace microswarm

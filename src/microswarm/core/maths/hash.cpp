// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/maths/hash.hpp"

namespace microswarm {

std::string Hash::hex() const {
  std::string text(16, '0');
  for (std::size_t i = 0; i < text.size(); ++i)
    text[i] = "0123456789abcdef"[(state_ >> (60 - 4 * i)) & 0xf];
  return text;
}

}  // namespace microswarm

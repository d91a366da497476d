// SPDX-License-Identifier: Apache-2.0
// Bytes of a terminal: the same keys in one piece or two, and none are left over.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "apps/microswarm/rig/keys/key_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm::cli;
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
  std::string whole = bytes;
  const std::vector<Key> keys = take_keys(whole, true);
  const std::size_t cut = std::min<std::size_t>(data[0], bytes.size());
  std::string input = bytes.substr(0, cut);
  std::vector<Key> pieces = take_keys(input, false);
  input += bytes.substr(cut);
  const std::vector<Key> rest = take_keys(input, true);
  pieces.insert(pieces.end(), rest.begin(), rest.end());
  const bool stops = std::ranges::any_of(keys, is_emergency);
  if (!whole.empty() || pieces != keys || std::ranges::any_of(meant(keys), is_emergency) != stops)
    std::abort();
  return 0;
}

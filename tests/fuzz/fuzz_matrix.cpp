// SPDX-License-Identifier: Apache-2.0
// Matrices of 0 and 1, and rectangles: what is read as a matrix can be read from its digits.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/formats/matrix.hpp"
#include "microswarm/formats/rectangles.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    formats::is_matrix(text);
    formats::parse_rectangles(text, "fuzz.csv");
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  try {
    const formats::Mask ones = formats::parse_matrix(text, "fuzz.txt");
    std::string digits;
    for (int row = 0; row < ones.height; ++row, digits += '\n')
      for (int column = 0; column < ones.width; ++column)
        digits += ones.at(column, row) ? '1' : '0';
    if (formats::parse_matrix(digits, "again.txt") != ones) std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

namespace microswarm {

/// Reads all of a text as a decimal number, as std::from_chars does. False if it is none, or out of
/// range. libc++ has from_chars for integers only.
template <class Float>
bool read_float(std::string_view text, Float& value) {
#ifdef __cpp_lib_to_chars
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
#else
  std::istringstream in{std::string(text)};
  in.imbue(std::locale::classic());
  return text.find_first_of("xX") == text.npos && in >> value &&
         in.peek() == std::istringstream::traits_type::eof();
#endif
}

}  // namespace microswarm

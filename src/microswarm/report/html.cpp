// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/html.hpp"

#include "microswarm/core/text/text.hpp"

namespace microswarm::report {

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : printable(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

}  // namespace microswarm::report

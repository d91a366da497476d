// SPDX-License-Identifier: Apache-2.0
#include "support/help_text.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "support/status_line.hpp"

namespace microswarm::cli {
namespace {

/// Column at which the meaning of an option begins: behind the first two blanks after its name;
/// else where the line begins.
std::size_t hanging_indent(std::string_view line, std::size_t columns) {
  const std::size_t begin = line.find_first_not_of(' ');
  if (begin == std::string_view::npos || begin == 0) return 0;
  const std::size_t gap = line.find("  ", begin);
  const std::size_t behind =
      gap == std::string_view::npos ? begin : line.find_first_not_of(' ', gap);
  const std::size_t indent =
      behind == std::string_view::npos ? begin : to_columns(line.substr(0, behind));
  return indent <= columns / 2 ? indent : begin;
}

/// Appends the line in pieces; `end` is written behind each but the last.
void wrap(std::string_view line, std::size_t columns, std::size_t indent, std::string_view end,
          std::string& to) {
  const std::size_t room = columns - to_columns(end);
  std::size_t used = 0;
  std::size_t at = 0;
  while (at < line.size()) {
    // A word with the blanks before it.
    const std::size_t begin = std::min(line.find_first_not_of(' ', at), line.size());
    const std::size_t next = std::min(line.find(' ', begin), line.size());
    const std::string_view word = line.substr(begin, next - begin);
    const std::size_t wide = to_columns(word);
    const bool fits = used + (begin - at) + wide <= (next == line.size() ? columns : room);
    if (used <= indent || fits) {
      to += line.substr(at, next - at);
      used += (begin - at) + wide;
    } else {
      to += end;
      to += '\n';
      to.append(indent, ' ');
      to += word;
      used = indent + wide;
    }
    at = next;
  }
}

}  // namespace

std::size_t output_columns() {
  if (::isatty(STDOUT_FILENO) != 1) return 0;
  if (const char* text = std::getenv("COLUMNS")) {
    const std::string_view given = text;
    std::size_t columns = 0;
    const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), columns);
    if (error == std::errc{} && end == given.data() + given.size() && columns > 0) return columns;
  }
  winsize size{};
  const bool is_known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return is_known ? size.ws_col : 80;
}

std::string wrapped_help(std::string_view help, std::size_t columns) {
  if (columns == 0) return std::string(help);
  columns = std::max<std::size_t>(columns, 40);
  std::string wrapped;
  for (bool more = true; more;) {
    const std::size_t end = help.find('\n');
    const std::string_view line = help.substr(0, end);
    more = end != std::string_view::npos;
    if (more) help.remove_prefix(end + 1);
    const bool is_command = line.starts_with("  microswarm") || line.starts_with("      --");
    if (to_columns(line) <= columns)
      wrapped += line;
    else if (is_command)
      wrap(line, columns, 6, " \\", wrapped);
    else
      wrap(line, columns, hanging_indent(line, columns), "", wrapped);
    if (more) wrapped += '\n';
  }
  return wrapped;
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "support/status_line.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <new>
#include <optional>

#include "microswarm/core/text/text.hpp"
#include "microswarm/core/text/utf8.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

/// Line at the end of stderr. Thread-safe.
struct Screen {
  std::mutex mutex;
  const StatusLine* owner = nullptr;  ///< owner of the visible line
  std::string line;
};

Screen& screen() {
  static Screen* const one = new Screen;  // never destroyed, so that late errors can be written
  return *one;
}

constexpr std::string_view clear_line = "\r\033[K";

/// Writes to stderr unchanged, control characters included.
void write_raw(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

/// Begin of the next character, and the columns of the one at `i`. wcwidth would need a locale.
std::size_t next_character(std::string_view text, std::size_t& i) {
  const Utf8Character next = first_character(text.substr(i));
  const std::uint32_t code = next.code.value_or('?');
  i += next.bytes;
  if (code >= 0x300 && code < 0x370) return 0;  // combining
  const bool is_wide = (code >= 0x1100 && code < 0x1160) || (code >= 0x2E80 && code < 0xA4D0) ||
                       (code >= 0xAC00 && code < 0xD7A4) || (code >= 0xF900 && code < 0xFB00) ||
                       (code >= 0xFE30 && code < 0xFE70) || (code >= 0xFF00 && code < 0xFF61) ||
                       code >= 0x1F300;
  return is_wide ? 2 : 1;
}

std::string_view cut(std::string_view text, std::size_t columns) {
  std::size_t used = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = i;
    used += next_character(text, i);
    if (used > columns) return text.substr(0, begin);
  }
  return text;
}

}  // namespace

std::size_t to_columns(std::string_view text) {
  std::size_t columns = 0;
  for (std::size_t i = 0; i < text.size();) columns += next_character(text, i);
  return columns;
}

void say(std::string_view text) noexcept {
  try {
    const std::string safe = printable(text);
    Screen& at = screen();
    const std::lock_guard lock(at.mutex);
    if (at.line.empty()) return write_raw(safe);
    write_raw(std::string(clear_line) + safe + (safe.ends_with('\n') ? "" : "\n") + at.line);
  } catch (const std::bad_alloc&) {
    write_raw("out of memory\n");
  }
}

StatusLine::StatusLine() : is_there_(::isatty(STDERR_FILENO) == 1) {}

StatusLine::~StatusLine() {
  Screen& at = screen();
  const std::lock_guard lock(at.mutex);
  if (at.owner != this) return;
  write_raw(clear_line);
  at.owner = nullptr;
  at.line.clear();
}

std::size_t StatusLine::columns() const {
  constexpr std::size_t usual = 80;
  winsize size{};
  const bool is_known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return (is_known ? size.ws_col : usual) - 1;  // some terminals wrap after the last column
}

void StatusLine::show(std::string_view text) {
  if (!is_there_) return;
  const std::string whole = one_line(text, text.size());
  const std::string_view line = cut(whole, columns());
  Screen& at = screen();
  const std::lock_guard lock(at.mutex);
  if (at.owner == this && at.line == line) return;
  at.owner = this;
  at.line = line;
  write_raw(std::string(clear_line) + at.line);
}

ProgressBar::ProgressBar(const std::string& label) : label_(label), began_(Stop::Clock::now()) {}

std::string progress_text(const std::string& label, double share, double seconds,
                          const std::string& doing, std::size_t columns) {
  share = std::clamp(share, 0.0, 1.0);
  const int percent = static_cast<int>(100 * share);
  // Nothing can be said of the end before something is done.
  const std::string left =
      share > 0 ? fmt::format(" {:.0f} s left", seconds * (1 - share) / share) : "";
  const std::string behind = fmt::format("{:3} %{}", percent, left);
  // The label and what is behind the bar come first; the bar gets what is left, the note the rest.
  constexpr std::size_t most = 25, least = 5, frame = 4;  // blanks and brackets
  const std::string_view name = cut(label, std::max(columns / 2, least));
  const std::size_t taken = to_columns(name) + to_columns(behind) + frame;
  const std::size_t room = columns > taken ? columns - taken : 0;
  std::string text(name);
  if (room >= least) {
    const std::size_t wide = std::min(room, most);
    const auto done = static_cast<std::size_t>(share * static_cast<double>(wide));
    text += fmt::format(" [{}{}]", std::string(done, '#'), std::string(wide - done, '.'));
  }
  return fmt::format("{} {} {}", text, behind, doing);
}

void ProgressBar::update(double share, const std::string& doing) {
  const int percent = static_cast<int>(100 * std::clamp(share, 0.0, 1.0));
  if (!line_.is_there() || (percent == last_ && doing == note_)) return;
  last_ = percent;
  note_ = doing;
  line_.show(progress_text(label_, share, seconds_since(began_), doing, line_.columns()));
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "rig/keys/answer_line.hpp"

#include <unistd.h>

#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "rig/keys/key_input.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

constexpr char kill_line = '\x15';        // Ctrl-U
constexpr std::size_t max_answer = 1000;  // [bytes]

/// Echoes typed text; a terminal that is gone is detected elsewhere.
void echo(std::string_view text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;
}

}  // namespace

AnswerLine::AnswerLine(bool any_stop_key) : any_stop_key_(any_stop_key) {}

AnswerLine::~AnswerLine() { terminal_.restore(); }

/// Reads the available input.
void AnswerLine::read_more() {
  if (ended_ || (is_terminal() && !terminal_.prepare())) return;
  const std::optional<std::string> got = input_within(0);
  ended_ = !got;
  if (!got) return;
  if (!is_terminal()) typed_ += *got;
  if (is_terminal())
    for (const char key : *got) take_key(key);
}

void AnswerLine::take_key(char key) {
  if (key == '\x1b' || (any_stop_key_ && is_emergency({.character = key})))
    throw HardwareError("the emergency key was pressed");
  if (complete_) return;  // it answers a later question
  if (key == '\r' || key == '\n') {
    complete_ = true;
    echo("\n");
  } else if (key == '\b' || key == '\x7f') {
    if (!typed_.empty()) echo("\b \b");
    if (!typed_.empty()) typed_.pop_back();
  } else if (key == kill_line) {
    for (; !typed_.empty(); typed_.pop_back()) echo("\b \b");
  } else if (key >= ' ' && key < '\x7f' && typed_.size() < max_answer) {
    typed_ += key;
    echo(std::string_view(&key, 1));
  }
}

void AnswerLine::watch() {
  if (!is_terminal()) return;
  read_more();
  typed_.clear();
  complete_ = false;
}

void AnswerLine::ask(std::string_view question) {
  watch();
  say(question);
}

std::optional<std::string> AnswerLine::poll() {
  if (is_terminal() || typed_.find('\n') == std::string::npos) read_more();
  if (is_terminal()) {
    if (!std::exchange(complete_, false)) return std::nullopt;
    return std::exchange(typed_, {});
  }
  const std::size_t end = typed_.find('\n');
  if (end == std::string::npos && typed_.size() > max_answer)
    throw InputError(fmt::format("stdin: a line is longer than {} bytes", max_answer));
  if (end == std::string::npos) return std::nullopt;
  std::string line = typed_.substr(0, end);
  typed_.erase(0, end + 1);
  note("{}\n", line);
  return line;
}

}  // namespace microswarm::cli

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/actuation/drivers/line_protocol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "microswarm/core/text/lines.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::actuation {
namespace {

constexpr std::array<std::pair<std::string_view, LineVerdict>, 5> verdicts{
    {{"ok", LineVerdict::ok},
     {"limited", LineVerdict::limited},
     {"off", LineVerdict::off},
     {"refused", LineVerdict::refused},
     {"emergency", LineVerdict::emergency}}};

/// Removes the first word from `text` and returns it.
std::string_view take_word(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(" \t"));
  text.remove_prefix(word.size());
  return word;
}

std::vector<double> parse_values(std::span<const std::string_view> words) {
  std::vector<double> values;
  for (const std::string_view word : words) {
    const auto value = parse_number(word);
    if (!value || values.size() == line_protocol_values) return {};
    values.push_back(*value);
  }
  return values;
}

std::vector<double> parse_temperatures(std::span<const std::string_view> words) {
  constexpr double least = -273.15, most = 1e4;  // [°C]
  constexpr std::string_view none = "-";
  std::vector<double> temperatures;
  for (const std::string_view word : words) {
    const auto value = word == none ? std::numeric_limits<double>::quiet_NaN() : parse_number(word);
    if (!value || *value < least || *value > most || temperatures.size() == line_protocol_values)
      return {};
    temperatures.push_back(*value);
  }
  return temperatures;
}

/// Reads "V1 V2 …" and "V1 V2 … t T1 T2 …".
void read_numbers(std::string_view text, LineReply& reply) {
  const std::vector<std::string_view> all = words(text);
  const auto mark = std::ranges::find(all, "t");
  reply.values = parse_values({all.begin(), mark});
  if (mark != all.end()) reply.temperatures = parse_temperatures({mark + 1, all.end()});
}

}  // namespace

std::string line_hello(std::uint32_t sequence, std::string_view send, std::size_t channels,
                       int watchdog_ms) {
  return fmt::format("hello {} {} {} {} {}\n", sequence, line_protocol_version, send, channels,
                     watchdog_ms);
}

std::string line_message(std::string_view word, std::uint32_t sequence,
                         std::span<const double> values) {
  std::string line = fmt::format("{} {}", word, sequence);
  constexpr double least = 5e-7;  // the rest would be written as -0.000000
  for (const double value : values)
    line += fmt::format(" {:.6f}", std::abs(value) < least ? 0.0 : value);
  return line + '\n';
}

std::optional<LineReply> parse_line_reply(std::string_view line) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t'; };
  if (line.size() > line_protocol_length || std::ranges::any_of(line, is_control))
    return std::nullopt;
  const std::string_view word = take_word(line);
  const auto* const verdict =
      std::ranges::find(verdicts, word, &decltype(verdicts)::value_type::first);
  if (verdict == verdicts.end()) return std::nullopt;
  LineReply reply{.verdict = verdict->second};
  const std::string_view number = take_word(line);
  const auto [end, error] =
      std::from_chars(number.data(), number.data() + number.size(), reply.sequence);
  if (number.empty() || error != std::errc{} || end != number.data() + number.size())
    return std::nullopt;
  if (reply.verdict == LineVerdict::ok || reply.verdict == LineVerdict::limited)
    read_numbers(line, reply);
  else
    reply.text = one_line(trimmed(line));
  return reply;
}

std::optional<std::string> LineReader::take(std::uint8_t byte) {
  if (byte != '\n') {
    too_long_ = too_long_ || line_.size() == line_protocol_length;
    if (!too_long_) line_ += static_cast<char>(byte);
    return std::nullopt;
  }
  if (line_.ends_with('\r')) line_.pop_back();
  const bool whole = !std::exchange(too_long_, false);
  std::string line = std::exchange(line_, {});
  if (!whole) return std::nullopt;
  return line;
}

}  // namespace microswarm::actuation

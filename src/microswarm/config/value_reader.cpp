// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/value_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "microswarm/config/number.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/choices.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {
namespace {

using Kind = YamlNode::Kind;

std::string expected(const Type& type) {
  switch (type.kind) {
    case TypeKind::boolean:
      return "true or false";
    case TypeKind::integer:
    case TypeKind::count:
    case TypeKind::index:
      return "a whole number";
    case TypeKind::number:
      return "a number";
    case TypeKind::text:
      return "a text";
    case TypeKind::point:
      return "[x, y]";
    case TypeKind::choice:
      return fmt::format("one of {}", fmt::join(type.words, ", "));
    case TypeKind::record:
      return "a mapping of keys";
    case TypeKind::variant:
      return "a mapping with the key 'type'";
    case TypeKind::list:
      return "a list";
    case TypeKind::optional:
      return expected(*type.parts[0]);
  }
  return "";
}

std::string found(const YamlNode& node) {
  switch (node.kind) {
    case Kind::null:
      return "empty";
    case Kind::scalar:
      return (node.quoted ? "the text " : "") + quote(node.text);
    case Kind::list:
      return fmt::format("a list of {}", node.items.size());
    case Kind::map:
      return "a mapping";
  }
  return "";
}

/// true and false in the three spellings of YAML 1.2.
std::optional<bool> spelled_truth(std::string_view text) {
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  return std::nullopt;
}

bool spells_no_finite_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  std::string lower(text.substr(0, 9));
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

/// The key that was probably meant, or nothing.
std::string_view nearest_key(const Type& record, std::string_view key, bool has_type_key) {
  std::vector<std::string_view> keys;
  for (const Field& field : record.fields) keys.push_back(field.key);
  if (has_type_key) keys.push_back("type");
  if (const std::string_view near = nearest_word(key, keys); !near.empty()) return near;
  keys.clear();
  for (const Field& field : record.fields)
    if (!field.info.former_key.empty()) keys.push_back(field.info.former_key);
  if (const std::string_view near = nearest_word(key, keys); !near.empty())
    return record.former_field(near)->key;
  for (const Field& field : record.fields) {  // the right name without its unit or with another one
    const bool starts = key.starts_with(field.info.name);
    if (starts && (key.size() == field.info.name.size() || key[field.info.name.size()] == '_'))
      return field.key;
  }
  return {};
}

}  // namespace

void ValueReader::fail(const YamlNode& at, std::string what, std::string value,
                       std::string limit) const {
  Issue issue{{}, std::move(what), std::string(name_), std::move(value), std::move(limit)};
  if (!key_.empty()) issue.keys.push_back(key_);
  if (locations_) issue.location += fmt::format(":{}:{}", at.line, at.column);
  throw InputError(std::move(issue));
}

template <class Body>
void ValueReader::attempt(std::string_view part, Body&& body) {
  const std::size_t outer = key_.size();
  if (outer > 0) key_ += '.';
  key_ += part;
  try {
    body();
  } catch (const InputError& error) {
    if (issues_.size() >= max_issues) throw;
    issues_.add(error.issues());
    if (issues_.size() >= max_issues) throw InputError(issues_);
  }
  key_.resize(outer);
}

void ValueReader::fail_kind(const Type& type, std::string_view label, const YamlNode& node) {
  fail(node,
       fmt::format("{} must be {}, not {}", label.empty() ? "the document" : label, expected(type),
                   found(node)),
       shown_value(node), expected(type));
}

void ValueReader::fail_unknown_key(const Type& record, const YamlNode& key, std::string value,
                                   bool has_type_key) const {
  std::vector<std::string_view> keys;
  if (has_type_key) keys.push_back("type");
  for (const Field& field : record.fields) keys.push_back(field.key);
  const std::string allowed = fmt::format("{}", fmt::join(keys, ", "));
  std::string what = fmt::format("unknown key {}, allowed: {}", quote(key.text), allowed);
  if (const Field* former = record.former_field(key.text))
    what = fmt::format("{} is the former name of '{}', which is given too", quote(key.text),
                       former->key);
  else if (exact_number(key.text))
    what = fmt::format("unknown key {}: decimals are written with a point, like 0.5; allowed: {}",
                       quote(key.text), allowed);
  else if (const std::string_view near = nearest_key(record, key.text, has_type_key); !near.empty())
    what = fmt::format("unknown key {}, did you mean '{}'?", quote(key.text), near);
  fail(key, std::move(what), std::move(value), allowed);
}

long double ValueReader::checked_number(const Type& type, const FieldInfo& info, const Range& range,
                                        std::string_view label, const YamlNode& node) {
  if (!node.is_plain()) fail_kind(type, label, node);
  const std::optional<long double> number = exact_number(node.text);
  if (!number && spells_no_finite_number(node.text))
    fail(node, fmt::format("{} is {}, must be finite", label, one_line(node.text)),
         shown_value(node), "a finite number");
  if (!number) fail_kind(type, label, node);
  if (type.kind != TypeKind::number && *number != std::floor(*number)) fail_kind(type, label, node);
  // Rounded to double like the limits: 0.001 is not less than the double nearest to 0.001.
  const double shown = static_cast<double>(*number);
  if (shown < range.min || shown > range.max) {
    const std::string allowed = range_text(range, info.unit);
    fail(node,
         fmt::format("{} is {}{}, allowed {}", label, number_text(shown), spaced_symbol(info.unit),
                     allowed),
         shown_value(node), allowed);
  }
  return *number;
}

void ValueReader::read_number(const FieldInfo& info, std::string_view label, double& value,
                              const YamlNode& node) {
  checked_number(type_of<double>(), info, info.range, label, node);
  value = *stored_number(node.text, info.unit);
}

template <class Int>
void ValueReader::read_whole(const FieldInfo& info, std::string_view label, Int& value,
                             const YamlNode& node) {
  constexpr Int least = std::numeric_limits<Int>::min(), most = std::numeric_limits<Int>::max();
  const Range range{std::max(info.range.min, static_cast<double>(least)), info.range.max};
  const long double number = checked_number(type_of<Int>(), info, range, label, node);
  if (number > static_cast<long double>(most))
    fail(node, fmt::format("{} is {}, allowed at most {}", label, one_line(node.text, 40), most),
         shown_value(node), fmt::format("at most {}", most));
  value = static_cast<Int>(number);
}

void ValueReader::read_list(const Type& type, const FieldInfo& info, std::string_view label,
                            void* value, const YamlNode& node) {
  if (node.kind != Kind::list) fail_kind(type, label, node);
  type.set_count(value, 0);
  type.set_count(value, node.items.size());
  for (std::size_t i = 0; i < node.items.size(); ++i)
    attempt(std::to_string(i),
            [&] { read(*type.parts[0], info, label, type.part(value, i), node.items[i]); });
}

void ValueReader::read_record(const Type& type, std::string_view label, void* value,
                              const YamlNode& node, bool has_type_key) {
  const bool empty_document = node.kind == Kind::null && label.empty();
  if (node.kind != Kind::map && !empty_document) fail_kind(type, label, node);
  std::vector<const Field*> given;
  for (std::size_t i = 0; i < node.items.size(); i += 2) {
    const YamlNode& key = node.items[i];
    if (has_type_key && key.text == "type") continue;
    attempt(key.text, [&] {
      const Field* field = type.field(key.text);
      if (!field) fail_unknown_key(type, key, shown_value(node.items[i + 1]), has_type_key);
      given.push_back(field);
      read(*field->type, field->info, field->key, field->in(value), node.items[i + 1]);
    });
  }
  for (const Field& field : type.fields) {
    if (!field.info.required || std::find(given.begin(), given.end(), &field) != given.end())
      continue;
    attempt(field.key, [&] {
      fail(node,
           fmt::format("missing key '{}'{}{}", field.key, label.empty() ? "" : " in ", label));
    });
  }
}

void ValueReader::choose(const Type& type, std::string_view label, void* value,
                         const YamlNode& node) {
  const auto word = std::find(type.words.begin(), type.words.end(), node.text);
  if (node.kind != Kind::scalar || word == type.words.end()) {
    const std::string allowed = fmt::format("{}", fmt::join(type.words, ", "));
    const std::string words =
        node.kind == Kind::scalar ? allowed_words(node.text, type.words) : "allowed: " + allowed;
    fail(node, fmt::format("{} is {}, {}", label, found(node), words), shown_value(node), allowed);
  }
  type.set_count(value, static_cast<std::size_t>(word - type.words.begin()));
}

void ValueReader::read_variant(const Type& type, std::string_view label, void* value,
                               const YamlNode& node) {
  if (node.kind != Kind::map) fail_kind(type, label, node);
  const YamlNode* chosen = nullptr;
  for (std::size_t i = 0; i < node.items.size(); i += 2)
    if (node.items[i].text == "type") chosen = &node.items[i + 1];
  const std::size_t outer = key_.size();  // cut by `attempt` if this throws
  key_ += outer > 0 ? ".type" : "type";
  if (!chosen) {
    const std::string allowed = fmt::format("{}", fmt::join(type.words, ", "));
    fail(node, fmt::format("missing key 'type' in {}, allowed: {}", label, allowed), "", allowed);
  }
  choose(type, fmt::format("type of {}", label), value, *chosen);
  key_.resize(outer);
  read_record(*type.parts[type.count(value)], label, type.part(value, 0), node, true);
}

void ValueReader::read(const Type& type, const FieldInfo& info, std::string_view label, void* value,
                       const YamlNode& node) {
  switch (type.kind) {
    case TypeKind::boolean:
      if (const auto truth = node.is_plain() ? spelled_truth(node.text) : std::nullopt)
        *static_cast<bool*>(value) = *truth;
      else
        fail_kind(type, label, node);
      return;
    case TypeKind::integer:
      return read_whole(info, label, *static_cast<int*>(value), node);
    case TypeKind::count:
      return read_whole(info, label, *static_cast<std::uint64_t*>(value), node);
    case TypeKind::index:
      return read_whole(info, label, *static_cast<std::uint32_t*>(value), node);
    case TypeKind::number:
      return read_number(info, label, *static_cast<double*>(value), node);
    case TypeKind::text:
      if (node.kind != Kind::scalar || node.literal) fail_kind(type, label, node);
      *static_cast<std::string*>(value) = node.text;
      return;
    case TypeKind::point: {
      if (node.kind != Kind::list || node.items.size() != 2) fail_kind(type, label, node);
      Vec2& point = *static_cast<Vec2*>(value);
      read_number(info, label, point.x, node.items[0]);
      return read_number(info, label, point.y, node.items[1]);
    }
    case TypeKind::choice:
      return choose(type, label, value, node);
    case TypeKind::record:
      return read_record(type, label, value, node, false);
    case TypeKind::optional:
      type.set_count(value, node.kind == Kind::null ? 0 : 1);
      if (node.kind != Kind::null) read(*type.parts[0], info, label, type.part(value, 0), node);
      return;
    case TypeKind::list:
      return read_list(type, info, label, value, node);
    case TypeKind::variant:
      return read_variant(type, label, value, node);
  }
}

}  // namespace microswarm

// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/config/number.hpp"

namespace microswarm {
namespace {

enum class Syntax { yaml, json };

constexpr std::size_t line_width = 80;

/// Escapes common to JSON and double-quoted YAML.
std::string double_quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted.append({'\\', c});
    else if (c == '\n')
      quoted += "\\n";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      quoted += c;
  }
  quoted += '"';
  return quoted;
}

/// Whether every YAML reader takes the bare word for text.
bool is_bare_word(std::string_view text) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto may_follow = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '/' || c == '-';
  };
  if (text.empty() || !is_letter(text[0]) || !std::all_of(text.begin(), text.end(), may_follow))
    return false;
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  constexpr std::array<std::string_view, 9> taken = {"null", "true", "false", "yes", "no",
                                                     "on",   "off",  "y",     "n"};
  return std::find(taken.begin(), taken.end(), lower) == taken.end();
}

std::string text_value(std::string_view text, Syntax syntax) {
  return syntax == Syntax::yaml && is_bare_word(text) ? std::string(text) : double_quoted(text);
}

std::string number_value(double value, Unit unit, Syntax syntax) {
  if (!std::isfinite(value) && syntax == Syntax::json) return "null";
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  std::string text = shown_number(value, unit);
  const std::size_t e = text.find('e');
  if (syntax == Syntax::json || e == std::string::npos) return text;
  const std::string_view digits = std::string_view(text).substr(0, e);
  const std::string_view exponent = std::string_view(text).substr(e + 1);
  return fmt::format("{}{}e{}{}", digits, digits.find('.') == digits.npos ? ".0" : "",
                     exponent.starts_with('-') ? "" : "+", exponent);  // YAML 1.1 rejects 1e20
}

bool has_keys(const Type& type) {
  return type.kind == TypeKind::variant || (type.kind == TypeKind::record && !type.fields.empty());
}

bool is_list_of_blocks(const Type& type) {
  if (type.kind != TypeKind::list) return false;
  return has_keys(*type.parts[0]) || is_list_of_blocks(*type.parts[0]);
}

/// Calls visit(field, its value) for each key of a record. A variant is visited as the record it
/// holds, after visit_type(its name).
template <class VisitType, class Visit>
void each_key(const Type& type, const void* value, VisitType&& visit_type, Visit&& visit) {
  if (type.kind == TypeKind::variant) {
    const std::size_t held = type.count(value);
    visit_type(type.words[held]);
    return each_key(*type.parts[held], type.find_part(value), visit_type, visit);
  }
  for (const Field& field : type.fields) visit(field, field.in(value));
}

std::string line(const Type& type, Unit unit, const void* value, Syntax syntax);

std::string record_line(const Type& type, const void* value, Syntax syntax) {
  std::string text;
  const auto add = [&](std::string_view key, const std::string& content) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", text_value(key, syntax), content);
  };
  each_key(
      type, value, [&](std::string_view name) { add("type", text_value(name, syntax)); },
      [&](const Field& f, const void* v) { add(f.key, line(*f.type, f.info.unit, v, syntax)); });
  return fmt::format("{{{}}}", text);
}

std::string line(const Type& type, Unit unit, const void* value, Syntax syntax) {
  switch (type.kind) {
    case TypeKind::boolean:
      return *static_cast<const bool*>(value) ? "true" : "false";
    case TypeKind::integer:
      return fmt::format("{}", *static_cast<const int*>(value));
    case TypeKind::count:
      return fmt::format("{}", *static_cast<const std::uint64_t*>(value));
    case TypeKind::index:
      return fmt::format("{}", *static_cast<const std::uint32_t*>(value));
    case TypeKind::number:
      return number_value(*static_cast<const double*>(value), unit, syntax);
    case TypeKind::text:
      return text_value(*static_cast<const std::string*>(value), syntax);
    case TypeKind::point: {
      const Vec2& p = *static_cast<const Vec2*>(value);
      return fmt::format("[{}, {}]", number_value(p.x, unit, syntax),
                         number_value(p.y, unit, syntax));
    }
    case TypeKind::choice:
      return text_value(type.words[type.count(value)], syntax);
    case TypeKind::optional:
      return type.count(value) ? line(*type.parts[0], unit, type.find_part(value), syntax) : "null";
    case TypeKind::list: {
      std::string text;
      for (std::size_t i = 0; i < type.count(value); ++i)
        text.append(i ? ", " : "")
            .append(line(*type.parts[0], unit, type.find_part(value, i), syntax));
      return fmt::format("[{}]", text);
    }
    case TypeKind::record:
    case TypeKind::variant:
      return record_line(type, value, syntax);
  }
  return "";
}

/// Writes nested blocks. When a value begins, `out_` ends with a key's colon or a list's dash.
class YamlWriter {
 public:
  std::string take() { return std::move(out_); }

  /// Writes the keys of a record: the first at the current position, the others indented.
  void keys(const Type& type, const void* value, std::size_t indent) {
    bool first = true;
    const auto key = [&](std::string_view name) {
      if (!first) out_.append(indent, ' ');
      first = false;
      out_.append(name).append(":");
    };
    const auto visit_type = [&](std::string_view name) {
      key("type");
      out_ += fmt::format(" {}\n", text_value(name, Syntax::yaml));
    };
    each_key(type, value, visit_type, [&](const Field& field, const void* v) {
      key(field.key);
      after_key(*field.type, field.info.unit, v, indent + 2);
    });
  }

 private:
  void after_key(const Type& type, Unit unit, const void* value, std::size_t indent) {
    if (type.kind == TypeKind::optional && type.count(value))
      return after_key(*type.parts[0], unit, type.find_part(value), indent);
    if (has_keys(type)) {
      out_.append("\n").append(indent, ' ');
      return keys(type, value, indent);
    }
    const bool is_list = type.kind == TypeKind::list && type.count(value) > 0;
    if (is_list && is_list_of_blocks(type)) return entries(type, unit, value, indent);
    const std::string flow = yaml_line(type, unit, value);
    if (is_list && indent + flow.size() > line_width) return entries(type, unit, value, indent);
    out_ += fmt::format(" {}\n", flow);
  }

  void entries(const Type& list, Unit unit, const void* value, std::size_t indent) {
    out_ += "\n";
    const Type& type = *list.parts[0];
    for (std::size_t i = 0; i < list.count(value); ++i) {
      out_.append(indent, ' ').append("- ");
      if (has_keys(type))
        keys(type, list.find_part(value, i), indent + 2);
      else
        out_.append(yaml_line(type, unit, list.find_part(value, i))).append("\n");
    }
  }

  std::string out_;
};

void write_json(const Type& type, Unit unit, const void* value, std::size_t indent,
                std::string& out) {
  if (type.kind == TypeKind::optional && type.count(value))
    return write_json(*type.parts[0], unit, type.find_part(value), indent, out);
  if (!has_keys(type) && !(is_list_of_blocks(type) && type.count(value) > 0)) {
    out += json_line(type, unit, value);
    return;
  }
  const bool is_list = type.kind == TypeKind::list;
  bool first = true;
  const auto begin_line = [&] {
    out.append(first ? "\n" : ",\n").append(indent + 2, ' ');
    first = false;
  };
  out += is_list ? "[" : "{";
  if (is_list) {
    for (std::size_t i = 0; i < type.count(value); ++i) {
      begin_line();
      write_json(*type.parts[0], unit, type.find_part(value, i), indent + 2, out);
    }
  } else {
    const auto visit_type = [&](std::string_view name) {
      begin_line();
      out += fmt::format("\"type\": {}", double_quoted(name));
    };
    each_key(type, value, visit_type, [&](const Field& field, const void* v) {
      begin_line();
      out.append(double_quoted(field.key)).append(": ");
      write_json(*field.type, field.info.unit, v, indent + 2, out);
    });
  }
  out.append("\n").append(indent, ' ').append(is_list ? "]" : "}");
}

}  // namespace

std::string yaml_line(const Type& type, Unit unit, const void* value) {
  return line(type, unit, value, Syntax::yaml);
}

std::string json_line(const Type& type, Unit unit, const void* value) {
  return line(type, unit, value, Syntax::json);
}

std::string to_yaml(const Type& type, const void* value) {
  if (!has_keys(type)) return yaml_line(type, Unit::none, value) + "\n";
  YamlWriter writer;
  writer.keys(type, value, 0);
  return writer.take();
}

std::string to_json_text(const Type& type, const void* value) {
  std::string text;
  write_json(type, Unit::none, value, 0, text);
  return text + "\n";
}

}  // namespace microswarm
